// SPDX-License-Identifier: Apache-2.0
#include "core/lic/lic_plan.h"

#include "core/lic/lic_word.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whorl {
namespace {

// Only maps of floats go above 1.
float brightestTexel(const Map* map) {
    if (!map || map->format() != TexelFormat::F32) return 1.0f;
    float most = 1.0f;
    for (int y = 0; y < map->height(); ++y) {
        for (int x = 0; x < map->width(); ++x) {
            const float value = map->texel(x, y);
            if (value > most && value < 1e6f) most = value;
        }
    }
    return most;
}

// How often two places `way` (in cells) apart lie in the same cell of a cubic grid, over directions.
double sameCell(double way) {
    const auto along = [&](double x, double y, double z) {
        const auto one = [&](double part) { return std::max(1.0 - std::abs(part) * way, 0.0); };
        return one(x) * one(y) * one(z);
    };
    return (along(1, 0, 0) + 2.0 * along(0.707, 0.707, 0) + 2.0 * along(0.577, 0.577, 0.577) +
            2.0 * along(0.924, 0.383, 0)) /
           7.0;
}

// Variance of the convolution of noise of variance 1.
double varianceOf(const LicPlan& plan, double grain, double texel) {
    std::vector<double> weights;
    for (int k = -plan.steps; k <= plan.steps; ++k)
        weights.push_back(plan.weights[static_cast<std::size_t>(std::abs(k))]);
    double all = 0.0;
    for (const double w : weights) all += w;
    const double step = static_cast<double>(plan.stepMetres);
    const int n = plan.samples;
    double variance = 0.0;
    for (std::size_t lag = 0; lag < weights.size(); ++lag) {
        double pairs = 0.0;
        for (std::size_t i = 0; i + lag < weights.size(); ++i) pairs += weights[i] * weights[i + lag];
        if (lag > 0) pairs *= 2.0;
        // Noise of a texel is the mean over n x n samples.
        double same = 0.0;
        for (int y = 1 - n; y < n; ++y) {
            for (int x = 1 - n; x < n; ++x) {
                const double share = static_cast<double>((n - std::abs(x)) * (n - std::abs(y))) / (n * n * n * n);
                const double dx = static_cast<double>(lag) * step + x * texel / n, dy = y * texel / n;
                same += share * sameCell(std::sqrt(dx * dx + dy * dy) / grain);
            }
        }
        variance += pairs * same / (all * all);
    }
    return variance;
}

}  // namespace

LicPlan licPlan(const LicParams& params, const TexelAtlas& atlas, const Map* lengthMap) {
    LicPlan plan;
    const float texel = atlas.usualTexel(), grain = std::max(params.grain.value, 1e-6f);
    plan.longest = std::max(params.length.value, 0.0f) * brightestTexel(lengthMap);
    // A texel, less where the mesh has much finer ones than usual.
    const float step = std::min(texel, 3.8f * atlas.fineTexel());
    // The same for all usual lengths, so that another length changes no word.
    plan.stepMetres =
        std::max(std::min(step, plan.longest / 12.0f), plan.longest / static_cast<float>(LicPlan::mostSteps));
    const float steps = plan.stepMetres > 0.0f ? plan.longest / plan.stepMetres : 1.0f;
    plan.steps = std::clamp(static_cast<int>(steps + 0.01f), 1, LicPlan::mostSteps);
    plan.longestStep = std::clamp(1.5f * plan.stepMetres / atlas.fineTexel(), 2.0f, 3.99f);
    std::vector<double> weights;
    double all = 0.0;
    for (int k = 0; k <= plan.steps; ++k) {
        const double along = k == 0 ? 0.0 : static_cast<double>(static_cast<float>(k) / steps);
        const double soft = 0.5 + 0.5 * std::cos(std::numbers::pi * std::min(along, 1.0));
        weights.push_back(along > 1.01 ? 0.0 : params.kernel.index == 1 ? 1.0 : soft);
        all += k == 0 ? weights.back() : 2.0 * weights.back();
    }
    for (const double w : weights) {
        const auto number = static_cast<std::int32_t>(std::lround(w / all * (lic_word::weightSum - 2 * plan.steps)));
        plan.weights.push_back(plan.weights.empty() ? std::max(number, 1) : number);
        plan.totals.push_back(plan.totals.empty() ? 0 : plan.totals.back() + number);
    }
    plan.samples = texel > 1.5f * grain ? LicPlan::mostSamples : 2;
    plan.grains[0] = grain;
    for (std::size_t i = 1; i < plan.grains.size(); ++i) plan.grains[i] = plan.grains[i - 1] * 0.70710678f;
    plan.mean = std::clamp(params.white, 0.0f, 1.0f);
    const double variance = varianceOf(plan, static_cast<double>(grain), static_cast<double>(texel));
    plan.deviation =
        static_cast<float>(std::sqrt(variance * std::max(static_cast<double>(plan.mean * (1.0f - plan.mean)), 1e-6)));
    plan.hairDeviation = static_cast<float>(std::sqrt(variance * 0.25));
    return plan;
}

}  // namespace whorl
