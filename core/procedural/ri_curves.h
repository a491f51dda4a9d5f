// SPDX-License-Identifier: Apache-2.0
// Hair as Curves of the RenderMan interface.
#pragma once

#include "core/procedural/ri_request.h"

namespace whorl::procedural {

/// Makes the hair of a request and hands it to the host, block by block, each in a motion block where the hair moves:
/// Curves "cubic" "nonperiodic" in the Catmull-Rom basis, with P and width at every vertex (the first and the last one
/// twice), Cs, Os and (unless general/write_normals is off) N at every one along the curve, and s, t (the UV of the
/// root), hair_id, hair_member and hair_group once a curve. hair_id is the hair's number in its group (see numberOf),
/// never below zero: with hair_group, and hair_member where hairs are strands, no other hair has the same. `detail`:
/// pixels that the box of the primitive covers; infinite for all hair.
void drawHair(const RiHost& host, const RiRequest& request, SharedGroom& shared, RtFloat detail);

}  // namespace whorl::procedural
