// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/cut.h"

#include <glm/common.hpp>

#include <algorithm>

namespace whorl {

float stubLength(const Surface& surface) {
    return glm::length(surface.bounds.size()) * 0.005f;
}
float longestLength(const Surface& surface) {
    return glm::length(surface.bounds.size()) * 4.0f;
}

void withLength(std::span<const glm::vec3> from, float length, std::span<glm::vec3> out) {
    out[0] = from[0];
    const std::size_t last = out.size() - 1;
    std::size_t piece = 1;
    double pieceBegin = 0.0;
    double pieceLength = static_cast<double>(glm::length(from[1] - from[0]));
    for (std::size_t i = 1; i <= last; ++i) {
        const double at = static_cast<double>(length) * static_cast<double>(i) / static_cast<double>(last);
        while (piece + 1 < from.size() && at > pieceBegin + pieceLength) {
            pieceBegin += pieceLength;
            ++piece;
            pieceLength = static_cast<double>(glm::length(from[piece] - from[piece - 1]));
        }
        // Past the tip, t is above 1: straight on.
        const double t = pieceLength > 0.0 ? (at - pieceBegin) / pieceLength : 0.0;
        out[i] = from[piece - 1] + (from[piece] - from[piece - 1]) * static_cast<float>(t);
    }
}

std::optional<float> firstInside(const BrushArea& area, std::span<const glm::vec3> points) {
    float along = 0.0f;
    if (area.distanceInRadii(points[0]) < 1.0f) return 0.0f;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::vec3 a = points[i - 1], b = points[i];
        const float length = glm::length(b - a);
        // A segment can cross the brush between its ends: look at its nearest place, by golden-section search, which
        // needs no formula for perspective and works for circle and ball alike.
        float inside = area.distanceInRadii(b) < 1.0f ? 1.0f : -1.0f;
        if (inside < 0.0f) {
            float low = 0.0f, high = 1.0f;
            for (int k = 0; k < 16; ++k) {
                const float m = low + (high - low) * 0.382f, n = low + (high - low) * 0.618f;
                if (area.distanceInRadii(glm::mix(a, b, m)) < area.distanceInRadii(glm::mix(a, b, n))) {
                    high = n;
                } else {
                    low = m;
                }
            }
            const float nearest = 0.5f * (low + high);
            if (area.distanceInRadii(glm::mix(a, b, nearest)) < 1.0f) inside = nearest;
        }
        if (inside >= 0.0f) {
            float low = 0.0f, high = inside;
            for (int k = 0; k < 16; ++k) {
                const float middle = 0.5f * (low + high);
                (area.distanceInRadii(glm::mix(a, b, middle)) < 1.0f ? high : low) = middle;
            }
            return along + length * high;
        }
        along += length;
    }
    return std::nullopt;
}

}  // namespace whorl
