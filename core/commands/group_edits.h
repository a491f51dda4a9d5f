// SPDX-License-Identifier: Apache-2.0
// Adding, renaming and removing groups and maps of a groom, with everything that refers to them.
#pragma once

#include "core/base/result.h"
#include "core/model/groom.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace whorl {

/// `wanted` with other characters than letters, digits, '_' and '-' replaced by '-', and with a number at the end when
/// a group has that name already. Never empty.
std::string freeGroupName(const Groom& groom, std::string_view wanted);
/// The same for maps.
std::string freeMapName(const Groom& groom, std::string_view wanted);

/// A group with the parameters of group `like` (or defaults when there is none of that number); gives its number. Fails
/// when there are Groom::maxGroups already.
Result<int> addGroup(Groom& groom, std::string_view name, int like);
/// Fails for a name that another group has or that has other characters.
Result<void> renameGroup(Groom& groom, int group, std::string_view name);
/// Its guides go to the group before it (the next one for the first), resampled to that group's segments. Fails for the
/// last group.
Result<void> removeGroup(Groom& groom, int group);

/// Gives every guide the group that the group map has at its root, resampled to that group's segments; without a group
/// map all belong to the first group. Gives the number of guides that changed.
std::size_t regroupGuides(Groom& groom);

/// Parameters that used the map use the new name. Fails like renameGroup.
Result<void> renameMap(Groom& groom, std::string_view from, std::string_view to);
/// Parameters that used the map use none.
Result<void> removeMap(Groom& groom, std::string_view name);

}  // namespace whorl
