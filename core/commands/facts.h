// SPDX-License-Identifier: Apache-2.0
// What there is to know of a groom, for people and for programs.
#pragma once

#include "core/field/direction_field.h"
#include "core/model/groom.h"

#include <string>

namespace whorl {

/// Lines of "name: value".
std::string groomFactsText(const Groom& groom);
/// The same as a JSON object, with the parameters and `problems`.
std::string groomFactsJson(const Groom& groom, const Problems& problems, const std::string& kind);

/// Where the field of a mesh turns, a line each: index, middle of the triangle in metres, triangle; and how many and
/// the sum of their indices in the last line.
std::string singularitiesText(const DirectionField& field, const SurfaceMesh& mesh);
/// The same as a JSON object.
std::string singularitiesJson(const DirectionField& field, const SurfaceMesh& mesh);

}  // namespace whorl
