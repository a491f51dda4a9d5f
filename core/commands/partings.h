// SPDX-License-Identifier: Apache-2.0
// Adding and removing partings of a groom.
#pragma once

#include "core/base/result.h"
#include "core/model/groom.h"
#include "core/surface/surface.h"

#include <span>
#include <string>

namespace whorl {

/// Adds a parting over the skin through the places nearest to `points` (see tracedParting). Gives its id.
Result<std::uint32_t> addParting(Groom& groom, const Surface& surface, std::span<const glm::vec3> points,
                                 std::string name = {});
/// Fails when there is none of that id.
Result<void> removeParting(Groom& groom, std::uint32_t id);
/// The parting of that id, or null.
const Parting* findParting(const Groom& groom, std::uint32_t id);

}  // namespace whorl
