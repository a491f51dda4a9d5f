// SPDX-License-Identifier: Apache-2.0
// Which hairs are drawn with how many points, and in which order: far segments first, so that thin hair blends right.
#pragma once

#include "core/hair/strands.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace whorl {

/// How much of the hair is drawn.
struct HairDetail {
    std::uint32_t stride = 1;         ///< every stride-th hair is drawn
    std::uint32_t pointsPerHair = 2;  ///< places along each curve, at least 2
    float widthScale = 1.0f;          ///< what is drawn is this much wider than the hair
    bool operator==(const HairDetail&) const = default;

    std::uint32_t hairs(const Strands& strands) const {
        return static_cast<std::uint32_t>((strands.count() + stride - 1) / stride);
    }
};

/// Segments (hair * (pointsPerHair - 1) + place along it) from far to near along `forward` (the way
/// that the eye looks). Depth is compared in 4,096 steps; equal ones stay in order. The same for any number of threads.
class HairOrder {
public:
    /// Recomputes only when something differs from the last call. True when it did.
    bool update(const Strands& strands, const HairDetail& detail, const glm::vec3& eye, const glm::vec3& forward);
    const std::vector<std::uint32_t>& order() const { return m_segments; }
    void clear();

private:
    const Strands* m_strands = nullptr;
    HairDetail m_detail{};
    glm::vec3 m_eye{0.0f};
    glm::vec3 m_forward{0.0f};
    std::vector<std::uint16_t> m_keys;
    std::vector<float> m_depths;
    std::vector<std::uint32_t> m_segments;
};

}  // namespace whorl
