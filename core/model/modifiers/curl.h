// SPDX-License-Identifier: Apache-2.0
// Parameters of the modifier that winds hairs.
#pragma once

#include "core/param/param.h"

namespace whorl {

/// Hairs wind about the curve that they had.
struct CurlParams {
    static constexpr BlockInfo info{"curl", "Curl", "Winds hairs into curls and ringlets."};

    Driven rootRadius{0.002f};
    Driven tipRadius{0.006f};
    Driven turns{3.0f};
    Driven variation{0.15f};
    Driven phase{0.25f};
    Driven flips{0.0f};
    bool shared = true;
    bool keepLength = true;
    int seed = 0;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "root_radius",
                        .label = "Root radius",
                        .max = 1,
                        .softMax = 0.02,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Radius of the curl near the root."},
              self.rootRadius);
        visit(ParamInfo{.id = "tip_radius",
                        .label = "Tip radius",
                        .max = 1,
                        .softMax = 0.03,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Radius of the curl at the tip."},
              self.tipRadius);
        visit(ParamInfo{.id = "turns",
                        .label = "Turns",
                        .max = 200,
                        .softMax = 12,
                        .tip = "Turns from root to tip. A turn needs about five segments to look round."},
              self.turns);
        visit(ParamInfo{.id = "variation",
                        .label = "Variation",
                        .tip = "Changes radius and turns of each hair at random by up to this share."},
              self.variation);
        visit(ParamInfo{.id = "phase",
                        .label = "Random start",
                        .tip = "Where on its turn each curl starts: 0 all alike, 1 anywhere."},
              self.phase);
        visit(ParamInfo{.id = "flips",
                        .label = "Other way",
                        .unit = "%",
                        .shownScale = 100,
                        .tip = "Share of curls that wind the other way."},
              self.flips);
        visit(ParamInfo{.id = "shared",
                        .label = "One for a lock",
                        .tip = "Hairs that a clump above gathered into one lock curl together."},
              self.shared);
        visit(ParamInfo{.id = "keep_length", .label = "Keep length", .tip = "Curls pull the tip up, as in life."},
              self.keepLength);
        visit(ParamInfo{.id = "seed", .label = "Seed", .max = 1e6, .softMax = 100, .tip = "Other random curls."},
              self.seed);
    }
    bool operator==(const CurlParams&) const = default;
};

}  // namespace whorl
