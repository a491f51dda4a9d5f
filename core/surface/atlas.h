// SPDX-License-Identifier: Apache-2.0
// UVs for meshes that come without.
#pragma once

#include "core/model/surface_mesh.h"

namespace whorl {

/// Fills `cornerUvs` with charts that do not overlap, inside 0 to 1: neighbouring triangles of similar direction are
/// flattened together, then packed with a gap of at least `gapTexels` texels of a map of `mapSize`. Every triangle with
/// area gets UV area in proportion. Sets `madeAtlas`. Deterministic.
void makeAtlas(SurfaceMesh& mesh, int mapSize = 1024, int gapTexels = 4);

/// True when UVs are missing, all zero, or have no area for more than half of the triangles with area.
bool needsAtlas(const SurfaceMesh& mesh);

}  // namespace whorl
