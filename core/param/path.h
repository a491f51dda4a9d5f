// SPDX-License-Identifier: Apache-2.0
// Parameters by path: "counts/hairs", "groups/crown/frizz/tip", "groups/crown/frizz/tip/map",
// "groups/crown/modifiers/locks/tightness".
#pragma once

#include "core/base/result.h"
#include "core/param/param.h"

#include <string>
#include <string_view>
#include <vector>

namespace whorl {

struct Groom;

/// The value at `path` as it stands. Errors name the nearest valid part ("groups/crown has no block friz; blocks are
/// general, colour, frizz, kink, strands").
Result<ParamValue> groomValue(const Groom& groom, std::string_view path);

/// Sets the value at `path`; with "/map" at the end, the name of the map ("" takes it off; the map must exist).
/// Setting `segments` of a group also resamples that group's guides, which keep their shape.
Result<void> setGroomValue(Groom& groom, std::string_view path, const ParamValue& value);

/// Every path that exists, in declared order, without the "/map" ones.
std::vector<std::string> groomPaths(const Groom& groom);

/// The generated parameter reference, Markdown: a table a block with id, label, default, range, unit, tip.
std::string parameterReference();

}  // namespace whorl
