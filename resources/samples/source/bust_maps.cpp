// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/bust.h"
#include "resources/samples/source/ear.h"
#include "resources/samples/source/paint.h"
#include "resources/samples/source/sdf.h"

namespace whorl::samples {

using glm::mix;
using glm::vec3;
using sdf::gauss;
using sdf::smoothstep;

namespace {

vec3 mirrored(const vec3& p) {
    return {std::abs(p.x), p.y, p.z};
}

/// Piecewise linear curve through (x, y) points.
template <size_t N>
float curve(const std::array<glm::vec2, N>& points, float x) {
    for (size_t i = 0; i + 1 < N; ++i) {
        if (x < points[i + 1].x) {
            const float t = std::clamp((x - points[i].x) / (points[i + 1].x - points[i].x), 0.0f, 1.0f);
            return mix(points[i].y, points[i + 1].y, t * t * (3.0f - 2.0f * t));
        }
    }
    return points[N - 1].y;
}

/// Metres inside the hairline, negative on bare skin.
float insideHairline(const vec3& point) {
    const vec3 p = mirrored(point);
    // Front edge by height: sideburn, temple peak, recess, forehead.
    constexpr std::array<glm::vec2, 8> kFront = {{{0.250f, 0.0000f},
                                                  {0.272f, 0.0060f},
                                                  {0.290f, 0.0180f},
                                                  {0.308f, 0.0320f},
                                                  {0.320f, 0.0390f},
                                                  {0.331f, 0.0480f},
                                                  {0.345f, 0.0760f},
                                                  {0.354f, 0.1100f}}};
    // Lower edge from front to back: sideburn, over and behind the ear, nape.
    constexpr std::array<glm::vec2, 6> kBack = {{{-0.100f, 0.2260f},
                                                 {-0.075f, 0.2290f},
                                                 {-0.052f, 0.2400f},
                                                 {-0.034f, 0.2560f},
                                                 {-0.018f, 0.2640f},
                                                 {0.002f, 0.2600f}}};
    const float recess = 0.0060f * gauss(p.x - 0.040f, 0.012f) * smoothstep(0.320f, 0.340f, p.y);
    const float front = 0.8f * (curve(kFront, p.y) - recess - p.z);
    const float below = p.y - curve(kBack, p.z);
    const float ear = -ear::region(p) - 0.0030f;
    return std::min({front, below, ear});
}

/// 0..1 coverage of an eyebrow.
float eyebrow(const vec3& point) {
    const vec3 p = mirrored(point);
    if (p.z < 0.03f) {
        return 0.0f;
    }
    const float t = (p.x - 0.0105f) / 0.0425f;
    const float middle = 0.3030f + 0.0060f * sdf::smoothstep(0.0f, 0.68f, t) - 0.0065f * smoothstep(0.62f, 1.05f, t);
    const float half = mix(0.0036f, 0.0010f, smoothstep(0.35f, 1.0f, t)) * smoothstep(-0.10f, 0.12f, t);
    const float ends = smoothstep(-0.06f, 0.10f, t) * smoothstep(1.04f, 0.90f, t);
    const float ragged = 0.0005f * paintNoise(p * 700.0f);
    return ends * smoothstep(0.0010f, -0.0012f, std::abs(p.y - middle) - half + ragged);
}

}  // namespace

ScalarImage bustScalpDensity(int size) {
    return paintScalar(sharedBust(), size, [](const PaintPoint& point) {
        if (point.part != 0) {
            return 0.0f;
        }
        const float ragged =
            0.0014f * paintNoise(point.position * 320.0f) + 0.0010f * paintNoise(point.position * 90.0f);
        return smoothstep(-0.0025f, 0.0025f, insideHairline(point.position) + ragged);
    });
}

ScalarImage bustBrowDensity(int size) {
    return paintScalar(sharedBust(), size,
                       [](const PaintPoint& point) { return point.part == 0 ? eyebrow(point.position) : 0.0f; });
}

ColourImage bustSkin(int size) {
    return bustSkin(sharedBust(), size);
}

ColourImage bustSkin(const Sculpture& sculpture, int size) {
    return paintColour(sculpture, size, [](const PaintPoint& point) {
        if (point.part != 0) {
            return vec3(0.045f, 0.045f, 0.050f);
        }
        const vec3 p = mirrored(point.position);
        vec3 colour(0.610f, 0.425f, 0.330f);
        const vec3 rose(0.560f, 0.280f, 0.215f);
        // Cheeks, nose tip, chin and ears are a little warmer.
        colour = mix(colour, rose, 0.22f * gauss(glm::distance(p, vec3(0.046f, 0.246f, 0.058f)), 0.016f));
        colour = mix(colour, rose, 0.16f * gauss(glm::distance(p, vec3(0.0f, 0.243f, 0.106f)), 0.010f));
        colour = mix(colour, rose, 0.10f * gauss(glm::distance(p, vec3(0.0f, 0.182f, 0.084f)), 0.012f));
        colour = mix(colour, rose, 0.30f * smoothstep(-0.004f, 0.004f, ear::region(p)));
        const BustMarks marks = bustMarks(p);
        colour = mix(colour, vec3(0.430f, 0.150f, 0.125f), 0.75f * marks.lips);
        colour = mix(colour, colour * vec3(0.80f, 0.70f, 0.68f), marks.lid);
        colour = mix(colour, vec3(0.060f, 0.035f, 0.028f), 0.85f * marks.lash);
        colour = mix(colour, colour * vec3(0.55f, 0.48f, 0.44f), 0.6f * eyebrow(p));
        const float scalp = smoothstep(-0.002f, 0.006f, insideHairline(p));
        colour = mix(colour, colour * vec3(0.92f, 0.91f, 0.91f), scalp);
        return colour * (1.0f + 0.02f * paintNoise(p * 130.0f) + 0.015f * paintNoise(p * 420.0f));
    });
}

}  // namespace whorl::samples
