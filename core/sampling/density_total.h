// SPDX-License-Identifier: Apache-2.0
// What the number of hairs stands for while the artist paints.
#pragma once

#include "core/model/groom.h"

#include <string_view>

namespace whorl {

/// True when texels of that map say where hair grows: it is the density map of a group, or the group map.
bool drivesDensity(const Groom& groom, std::string_view map);

/// What to pin counts.density_total at so that all hair of the groom stays as it is, whatever number of it is shown.
/// Zero where nothing grows: then the number stands for the first area that is painted.
float densityTotalOf(const Groom& groom);

}  // namespace whorl
