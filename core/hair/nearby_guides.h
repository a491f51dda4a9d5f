// SPDX-License-Identifier: Apache-2.0
// The guides of many hairs that stand close together, found with one walk through the tree.
#pragma once

#include "core/hair/guide_index.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// Gathers the guides around a ball once, then answers for any root in it with a scan over those few. Gives bit for bit
/// what GuideIndex::nearest gives. One object a thread.
class NearbyGuides {
public:
    /// More than this and a scan is no faster than the tree: halve the ball.
    static constexpr std::size_t mostGuides = 96;

    explicit NearbyGuides(const GuideIndex& index) : m_index(index) {}

    /// Prepares for roots of a group within `radius` of `centre`. False when there would be too many guides, or a
    /// parting is near: ask the index itself.
    bool gather(std::size_t group, const glm::vec3& centre, float radius, int samples);
    /// As GuideIndex::nearest, for the group and samples of the last `gather`.
    std::size_t nearest(const glm::vec3& position, const glm::vec3& normal, std::span<Neighbour> out);

private:
    const GuideIndex& m_index;
    std::size_t m_group = 0;
    int m_samples = 0;
    glm::vec3 m_centre{0.0f};
    float m_reach = 0.0f;                   // all guides nearer than this to the centre are gathered
    std::vector<const GuideRoot*> m_roots;  // nearest to the centre first
    std::vector<std::uint32_t> m_found;
    std::vector<float> m_columns[6];  // positions and normals
    std::vector<float> m_squared;
};

}  // namespace whorl
