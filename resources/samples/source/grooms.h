// SPDX-License-Identifier: Apache-2.0
// The grooms that ship with Whorl, made from nothing.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/groom.h"
#include "resources/samples/source/sculpt.h"

namespace whorl::samples {

/// A mannequin bust with swept-back hair and eyebrows.
Result<Groom> bustGroom(Progress& progress);
/// The bust with long hair that is a shell of triangles: strokes and a parting lead hair texture over it.
Result<Groom> bobGroom(Progress& progress);
/// A furry creature: pattern in a colour map, lengths in a length map.
Result<Groom> creatureGroom(Progress& progress);
/// A cushion with a lock of plain hair, to try parameters on.
Result<Groom> swatchGroom(Progress& progress);

/// Welds the sculpture's seam vertices and keeps UVs at corners.
SurfaceMesh meshFrom(const Sculpture& sculpture);
/// A new groom on the sculpture; parts grow hair as the sculptor said.
Groom groomFrom(const Sculpture& sculpture);
Map mapFrom(const ScalarImage& image);
Map mapFrom(const ColourImage& image);

}  // namespace whorl::samples
