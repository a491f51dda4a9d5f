// SPDX-License-Identifier: Apache-2.0
// What there is to know of a groom, for people and for programs.
#pragma once

#include "core/model/groom.h"

#include <string>

namespace whorl {

/// Lines of "name: value".
std::string groomFactsText(const Groom& groom);
/// The same as a JSON object, with the parameters and `problems`.
std::string groomFactsJson(const Groom& groom, const Problems& problems, const std::string& kind);

}  // namespace whorl
