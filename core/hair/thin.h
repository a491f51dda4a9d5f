// SPDX-License-Identifier: Apache-2.0
// Hair without the vertices that it can do without.
#pragma once

#include "core/hair/strands.h"
#include "core/model/groom.h"

#include <span>
#include <vector>

namespace whorl {

/// True when a group has a skip threshold.
bool skipsVertices(const Groom& groom);

/// True when a group has general/write_normals on: files and RenderMan get the normals of all hair or of none.
bool wantsNormals(const Groom& groom);

/// `strands` without vertices on straight pieces. First and last vertices stay; each one left out is nearer to the
/// straight line between the two kept ones around it than its group's threshold times the length of that line.
/// Normals are turned to stay perpendicular to the curve.
Strands thinned(const Strands& strands, const Groom& groom);

/// The same hair at several times (motion samples), which keeps the same vertices at all of them: those that stay at
/// any. As many as `samples`, of the same number of hairs and vertices.
std::vector<Strands> thinnedTogether(std::span<const Strands* const> samples, const Groom& groom);

/// Which vertices of a curve stay at a threshold above zero: ascending, the first and the last among them.
std::vector<std::uint32_t> keptVertices(std::span<const glm::vec3> points, float threshold);

}  // namespace whorl
