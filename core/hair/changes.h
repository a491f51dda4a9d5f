// SPDX-License-Identifier: Apache-2.0
// What of a groom differs from the one before, as far as generation minds.
#pragma once

#include "core/model/groom.h"

namespace whorl {

/// True when both ask for the same density everywhere: same mesh, growing parts, group map, density numbers and maps.
bool sameDensity(const Groom& a, const Groom& b);

/// True when bindings made for one serve the other, given the same roots: same guide roots, samples, interpolation.
bool sameBindings(const Groom& a, const Groom& b);

/// True when every group has the same number of segments.
bool sameSegments(const Groom& a, const Groom& b);

/// True when traits made for one serve the other, given the same roots: same seed, group parameters and maps.
bool sameParameters(const Groom& a, const Groom& b);

}  // namespace whorl
