// SPDX-License-Identifier: Apache-2.0
#include "render/passes/hair_order.h"

#include "core/base/parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace whorl {
namespace {

constexpr std::uint32_t buckets = 4096;
constexpr std::size_t grain = 512;  // hairs

}  // namespace

void HairOrder::clear() {
    m_strands = nullptr;
    m_segments.clear();
}

bool HairOrder::update(const Strands& strands, const HairDetail& detail, const glm::vec3& eye,
                       const glm::vec3& forward) {
    if (m_strands == &strands && m_detail == detail && m_eye == eye && m_forward == forward) return false;
    m_strands = &strands;
    m_detail = detail;
    m_eye = eye;
    m_forward = forward;
    const std::size_t hairs = detail.hairs(strands);
    const std::size_t pieces = detail.pointsPerHair - 1;
    const std::size_t count = hairs * pieces;
    m_segments.resize(count);
    m_depths.resize(count);
    m_keys.resize(count);
    if (count == 0) return true;

    const std::size_t blocks = (hairs + grain - 1) / grain;
    std::vector<std::array<float, 2>> ranges(blocks);
    parallelFor(hairs, grain, [&](std::size_t begin, std::size_t end) {
        float low = std::numeric_limits<float>::max();
        float high = std::numeric_limits<float>::lowest();
        for (std::size_t hair = begin; hair < end; ++hair) {
            const std::size_t source = hair * detail.stride;
            const std::uint32_t first = strands.firstVertex[source];
            const std::uint32_t vertices = strands.firstVertex[source + 1] - first;
            const float step = vertices > 1 ? static_cast<float>(vertices - 1) / static_cast<float>(pieces) : 0.0f;
            for (std::size_t piece = 0; piece < pieces; ++piece) {
                float depth = 0.0f;
                if (vertices > 0) {
                    const float place = (static_cast<float>(piece) + 0.5f) * step;
                    const auto vertex = std::min(static_cast<std::uint32_t>(place), vertices - 1);
                    const auto next = std::min(vertex + 1, vertices - 1);
                    const float t = place - static_cast<float>(vertex);
                    const glm::vec3 p =
                        strands.positions[first + vertex] * (1.0f - t) + strands.positions[first + next] * t;
                    depth = glm::dot(p - eye, forward);
                }
                m_depths[hair * pieces + piece] = depth;
                low = std::min(low, depth);
                high = std::max(high, depth);
            }
        }
        ranges[begin / grain] = {low, high};
    });
    float low = ranges[0][0];
    float high = ranges[0][1];
    for (const auto& range : ranges) {
        low = std::min(low, range[0]);
        high = std::max(high, range[1]);
    }
    const float scale = high > low ? static_cast<float>(buckets - 1) / (high - low) : 0.0f;
    parallelFor(count, grain * 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            m_keys[i] = static_cast<std::uint16_t>((high - m_depths[i]) * scale);
        }
    });
    std::array<std::uint32_t, buckets + 1> starts{};
    for (std::size_t i = 0; i < count; ++i) ++starts[std::min<std::uint32_t>(m_keys[i], buckets - 1) + 1];
    for (std::uint32_t i = 0; i < buckets; ++i) starts[i + 1] += starts[i];
    for (std::size_t i = 0; i < count; ++i) {
        m_segments[starts[std::min<std::uint32_t>(m_keys[i], buckets - 1)]++] = static_cast<std::uint32_t>(i);
    }
    return true;
}

}  // namespace whorl
