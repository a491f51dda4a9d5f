// SPDX-License-Identifier: Apache-2.0
// Partings as lines in space, and lines in space as partings.
#pragma once

#include "core/base/result.h"
#include "core/model/parting.h"
#include "core/surface/surface.h"

#include <span>
#include <vector>

namespace whorl {

/// Metres between neighbouring points of a traced parting: a 128th of the mesh's largest side.
float partingStep(const Surface& surface);

/// The way over the skin through the places of the skin nearest to `points` (space of the mesh): a new point at least
/// every partingStep, none much closer than a third of it except at the ends. Fails for fewer than two places and for
/// ways of more than Parting::maxPoints.
Result<std::vector<SurfacePoint>> tracedParting(const Surface& surface, std::span<const glm::vec3> points);

/// Positions of its points.
std::vector<glm::vec3> partingPositions(const SurfaceMesh& mesh, const Parting& parting);
/// Metres along it.
float partingLength(const SurfaceMesh& mesh, const Parting& parting);

}  // namespace whorl
