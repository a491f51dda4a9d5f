// SPDX-License-Identifier: Apache-2.0
// The numbers of one hair, plain floats so that kernels may read them.
#pragma once

namespace whorl {

/// What is known of a hair besides its root and its guides. Lengths in metres, colours linear with opacity.
struct HairTraits {
    float cut;
    float scale;  ///< random shortening included
    float displacement;
    float rootWidth, tipWidth;
    float thickness;  ///< the root's width as the artist has it, at every level of detail
    float frizz[3];   ///< the hair's noise vector, about unit length at most
    float frizzRoot, frizzTip;
    float kinkRoot, kinkTip;
    float kinkFrequency[3];
    float rootColour[4], tipColour[4];
    // Strands. Set when the group has hairs a strand.
    float splay[3];  ///< at the root, half way, at the tip
    float twistTurns;
    float memberOffset, memberAspect, memberRandomise;
};

}  // namespace whorl
