// SPDX-License-Identifier: Apache-2.0
#include "core/hair/lod.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace whorl {

float diameterOnScreen(const SeenCoat& coat) {
    const float half = 0.5f * coat.fieldOfView;
    if (!(half > 0.0f) || !(half < 1.5707f) || !(coat.imageHeight > 0.0f) || !(coat.radius > 0.0f)) return 0.0f;
    const float away = coat.distance * coat.distance - coat.radius * coat.radius;
    if (!(coat.distance > coat.radius) || !(away > 0.0f)) return std::numeric_limits<float>::infinity();
    // tan(a) = radius / sqrt(distance^2 - radius^2)
    return coat.imageHeight * coat.radius / std::sqrt(away) / std::tan(half);
}

float lodForScreen(const SeenCoat& coat, std::uint32_t hairs, float hairsPerPixel, std::uint32_t fewest) {
    if (hairs == 0) return 1.0f;
    const double diameter = static_cast<double>(diameterOnScreen(coat)), all = static_cast<double>(hairs);
    const double wanted = 0.78539816 * diameter * diameter * static_cast<double>(std::max(hairsPerPixel, 0.0f)) / all;
    const double least = std::min(static_cast<double>(fewest) / all, 1.0);
    return static_cast<float>(std::clamp(std::isnan(wanted) ? 1.0 : wanted, least, 1.0));
}

float lodForCount(std::uint32_t hairs, std::uint32_t most) {
    return most >= hairs ? 1.0f : static_cast<float>(static_cast<double>(most) / static_cast<double>(hairs));
}

Groom atDetail(Groom groom, float share) {
    if (!(share > 0.0f) || share >= 1.0f) return groom;
    CountParams& counts = groom.counts.edit();
    counts.hairs = static_cast<int>(std::lround(static_cast<double>(counts.hairs) * static_cast<double>(share)));
    for (Group& group : groom.groups.edit()) {
        GeneralParams::each(group.params.general, [&](const ParamInfo& info, auto& value) {
            if constexpr (std::is_same_v<decltype(value), Driven&>) {
                if (&value == &group.params.general.rootThickness || &value == &group.params.general.tipThickness)
                    value.value = std::min(value.value / share, static_cast<float>(info.max));
            }
        });
    }
    return groom;
}

}  // namespace whorl
