// SPDX-License-Identifier: Apache-2.0
// What is under the cursor.
#pragma once

#include "core/hair/strands.h"
#include "core/model/guide_set.h"
#include "core/surface/surface_query.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace whorl {

/// Nearest guide to `pixel` (from the top left) within `radius` pixels whose nearest place is not behind the mesh.
/// `query` may be null: then nothing hides. Ties go to the lowest index.
std::optional<std::size_t> pickGuide(const GuideSet& guides, const SurfaceQuery* query, const glm::mat4& clipFromGroom,
                                     const glm::vec3& eye, glm::vec2 pixel, float radius, glm::vec2 viewportPixels);

/// The hair that is in front among those within `radius` pixels of `pixel` and not behind the mesh; its number in
/// `strands`. `query` as above.
std::optional<std::size_t> pickHair(const Strands& strands, const SurfaceQuery* query, const glm::mat4& clipFromGroom,
                                    const glm::vec3& eye, glm::vec2 pixel, float radius, glm::vec2 viewportPixels);

}  // namespace whorl
