// SPDX-License-Identifier: Apache-2.0
// How the parameters of hair texture become steps and weights on an atlas.
#pragma once

#include "core/lic/texel_atlas.h"
#include "core/model/lic_params.h"
#include "core/model/map.h"

#include <array>
#include <cstdint>
#include <vector>

namespace whorl {

struct LicPlan {
    static constexpr int mostSteps = 96;
    static constexpr int grainLevels = 24;
    static constexpr int mostSamples = 4;

    int steps = 1;                      ///< each way
    float stepMetres = 0.0f;            ///< between them
    float longest = 0.0f;               ///< metres each way where the length's map is brightest
    float longestStep = 2.0f;           ///< texels: where the mesh has so fine ones that steps are longer, they are cut
    std::vector<std::int32_t> weights;  ///< steps + 1
    std::vector<std::int32_t> totals;   ///< steps + 1: sums of the weights from the second on
    int samples = 2;                    ///< of the noise in a texel, a side
    float mean = 0.5f;
    float deviation = 0.1f;      ///< of the light, see LicTexture
    float hairDeviation = 0.1f;  ///< of the noise that tells hairs apart, 0 to 1
    /// Sides of noise cells, each a square root of two finer than the one before; where a map makes the grain finer,
    /// cells of two of them mix.
    std::array<float, grainLevels> grains{};

    bool operator==(const LicPlan&) const = default;
};

/// `lengthMap`, `grainMap`: null without a map.
LicPlan licPlan(const LicParams& params, const TexelAtlas& atlas, const Map* lengthMap);

}  // namespace whorl
