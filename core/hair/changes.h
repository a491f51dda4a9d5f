// SPDX-License-Identifier: Apache-2.0
// What of a groom differs from the one before, as far as generation minds.
#pragma once

#include "core/model/groom.h"
#include "core/model/map_changes.h"

// Where a question takes TouchedMaps, maps that differ in texels only are collected there instead of making the answer
// no: then it holds away from those texels.

namespace whorl {

/// True when both ask for the same density everywhere: same mesh, growing parts, group map, density numbers and maps.
bool sameDensity(const Groom& a, const Groom& b, TouchedMaps* touched = nullptr);

/// True when both have the same mesh, of which the same parts grow hair.
bool sameGrowth(const Groom& a, const Groom& b);

/// True when bindings made for one serve the other, given the same roots: same guide roots, partings, samples,
/// interpolation and choice of guides.
bool sameBindings(const Groom& a, const Groom& b);

/// True when every group has the same number of segments.
bool sameSegments(const Groom& a, const Groom& b);

/// True when traits made for one give hairs of the other their shape and length, given the same roots: same seed and
/// whether to keep outside; the same cut, scales, displacement, frizz, kink, strands, modifiers that move vertices, and
/// their maps.
bool sameShapeParameters(const Groom& a, const Groom& b, TouchedMaps* touched = nullptr);

/// True when centres of locks made for one serve the other, given the same sampled density and bindings: the same
/// clumps, as far as their centres mind, and lengths of hair.
bool sameClumps(const Groom& a, const Groom& b);

/// True when frizz moves with time.
bool isAnimated(const Groom& groom);

/// True when traits made for one give hairs of the other their colours, opacities and widths, given the same roots.
bool sameLookParameters(const Groom& a, const Groom& b, TouchedMaps* touched = nullptr);

}  // namespace whorl
