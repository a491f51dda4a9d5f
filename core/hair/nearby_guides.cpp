// SPDX-License-Identifier: Apache-2.0
#include "core/hair/nearby_guides.h"

#include "core/hair/bindings.kernel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {

bool NearbyGuides::gather(std::size_t group, const glm::vec3& centre, float radius, int samples) {
    const std::span<const GuideRoot> roots = m_index.rootsOf(group);
    if (roots.empty() || samples < 1) return false;
    const std::size_t needed =
        std::min(std::min(static_cast<std::size_t>(samples), GuideIndex::maxNeighbours) + 1, roots.size());
    // As many as a hair wants are within the first part of this of any root in the ball; the rest is for distances that
    // turned normals make longer.
    m_reach = (m_index.reach(group, centre, needed) + 2.0f * radius) * 1.05f;
    if (m_index.partings().near(centre, m_reach)) return false;
    m_index.within(group, centre, m_reach, m_found);
    if (m_found.size() > mostGuides) return false;
    m_group = group;
    m_samples = samples;
    m_centre = centre;
    m_roots.clear();
    for (const std::uint32_t root : m_found) m_roots.push_back(&roots[root]);
    // The nearest of the ball come first, which are those of most hairs in it: few of the others then find a place.
    std::sort(m_roots.begin(), m_roots.end(), [&](const GuideRoot* a, const GuideRoot* b) {
        const glm::vec3 awayA = a->position - centre, awayB = b->position - centre;
        const float squaredA = glm::dot(awayA, awayA), squaredB = glm::dot(awayB, awayB);
        return squaredA != squaredB ? squaredA < squaredB : a->id < b->id;
    });
    const std::size_t padded = (m_roots.size() + guideLanes - 1) / guideLanes * guideLanes;
    for (std::vector<float>& column : m_columns) column.assign(padded, 0.0f);
    m_squared.resize(padded);
    for (std::size_t i = 0; i < m_roots.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            m_columns[axis][i] = m_roots[i]->position[axis];
            m_columns[axis + 3][i] = m_roots[i]->normal[axis];
        }
    }
    return true;
}

std::size_t NearbyGuides::nearest(const glm::vec3& position, const glm::vec3& normal, std::span<Neighbour> out) {
    const std::size_t all = m_index.rootsOf(m_group).size();
    const std::size_t wanted =
        std::min({static_cast<std::size_t>(m_samples), all, out.size(), GuideIndex::maxNeighbours});
    const std::size_t needed = std::min(wanted + 1, all);
    if (m_roots.size() < needed) return m_index.nearest(m_group, position, normal, m_samples, out);
    const GuideColumns columns{m_columns[0].data(), m_columns[1].data(), m_columns[2].data(), m_columns[3].data(),
                               m_columns[4].data(), m_columns[5].data(), m_squared.size()};
    const float root[6] = {position.x, position.y, position.z, normal.x, normal.y, normal.z};
    WHORL_PICK(distancesToGuides)(columns, root, m_squared.data());

    // The nearest ones, by insertion; equal distances go by id.
    std::array<float, GuideIndex::maxNeighbours + 1> squared;
    std::array<std::uint32_t, GuideIndex::maxNeighbours + 1> which;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < m_roots.size(); ++i) {
        const float distance = m_squared[i];
        const auto before = [&](std::size_t place) {
            return distance < squared[place] ||
                   (distance == squared[place] && m_roots[i]->id < m_roots[which[place]]->id);
        };
        if (count == needed && !before(count - 1)) continue;
        std::size_t place = count < needed ? count++ : count - 1;
        for (; place > 0 && before(place - 1); --place) {
            squared[place] = squared[place - 1];
            which[place] = which[place - 1];
        }
        squared[place] = distance;
        which[place] = i;
    }
    // Only guides within this of the root are all known. The margin is for rounding.
    const float known = m_reach - glm::distance(position, m_centre) * 1.0001f;
    if (all > m_roots.size() && !(known > 0.0f && squared[needed - 1] < known * known * 0.9999f))
        return m_index.nearest(m_group, position, normal, m_samples, out);
    std::array<float, GuideIndex::maxNeighbours> weights;
    shepardWeights({squared.data(), wanted}, needed > wanted ? squared[wanted] : -1.0f, weights);
    for (std::size_t i = 0; i < wanted; ++i) {
        const GuideRoot* guide = m_roots[which[i]];
        out[i] = {guide->guide, weights[i], guide};
    }
    return wanted;
}

}  // namespace whorl
