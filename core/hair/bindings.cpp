// SPDX-License-Identifier: Apache-2.0
#include "core/hair/bindings.h"

#include "core/base/parallel.h"
#include "core/hair/nearby_guides.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace whorl {
namespace {

// Hairs that look for their guides together, at most; far apart ones are halved down to the least number.
constexpr std::size_t mostTogether = 64;
constexpr std::size_t leastTogether = 4;

// Binds hairs of one thread.
class Binder {
public:
    Binder(const Groom& groom, const GuideIndex& index, std::span<const HairRoot> roots, Bindings& bindings)
        : m_groups(*groom.groups), m_index(index), m_roots(roots), m_bindings(bindings), m_nearby(index) {}

    /// Hairs [begin, end), at most mostTogether.
    void bind(std::size_t begin, std::size_t end) {
        while (begin < end) {
            // Neighbours are of one group but for the borders of groups.
            std::size_t last = begin + 1;
            while (last < end && m_roots[last].group == m_roots[begin].group) ++last;
            bindTogether(begin, last);
            begin = last;
        }
    }

private:
    void bindTogether(std::size_t begin, std::size_t end) {
        const std::uint8_t group = m_roots[begin].group;
        const GeneralParams& general = m_groups[group].params.general;
        const int samples = general.samples;
        if (end - begin < leastTogether || general.fromTriangle()) {
            for (std::size_t i = begin; i < end; ++i)
                write(i, m_index.guidesOf(group, general, m_roots[i].position, m_roots[i].normal, m_neighbours));
            return;
        }
        glm::vec3 low = m_roots[begin].position, high = low;
        for (std::size_t i = begin + 1; i < end; ++i) {
            low = glm::min(low, m_roots[i].position);
            high = glm::max(high, m_roots[i].position);
        }
        if (m_nearby.gather(group, (low + high) * 0.5f, 0.5f * glm::distance(low, high), samples)) {
            for (std::size_t i = begin; i < end; ++i)
                write(i, m_nearby.nearest(m_roots[i].position, m_roots[i].normal, m_neighbours));
            return;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        bindTogether(begin, middle);
        bindTogether(middle, end);
    }

    void write(std::size_t hair, std::size_t count) {
        const std::size_t first = hair * m_bindings.perHair;
        m_bindings.counts[hair] = static_cast<std::uint8_t>(count);
        for (std::size_t j = 0; j < count; ++j) {
            m_bindings.guides[first + j] = m_neighbours[j].guide;
            m_bindings.weights[first + j] = m_neighbours[j].weight;
        }
    }

    const std::vector<Group>& m_groups;
    const GuideIndex& m_index;
    std::span<const HairRoot> m_roots;
    Bindings& m_bindings;
    NearbyGuides m_nearby;
    std::array<Neighbour, GuideIndex::maxNeighbours> m_neighbours;
};

}  // namespace

Bindings bindHairs(const Groom& groom, const GuideIndex& index, std::span<const HairRoot> roots, Progress& progress,
                   Bindings old) {
    const std::vector<Group>& groups = *groom.groups;
    Bindings bindings = std::move(old);
    bindings.perHair = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const GeneralParams& general = groups[g].params.general;
        const int most = std::max(general.samples, general.fromTriangle() ? 3 : 0);
        bindings.perHair = std::max(bindings.perHair, std::min({index.rootsOf(g).size(), GuideIndex::maxNeighbours,
                                                                static_cast<std::size_t>(std::max(most, 0))}));
    }
    const std::size_t places = roots.size() * bindings.perHair;
    bindings.counts.resize(roots.size());
    bindings.guides.resize(places);
    bindings.weights.resize(places);
    parallelFor(roots.size(), mostTogether * 16, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        Binder binder(groom, index, roots, bindings);
        for (std::size_t i = begin; i < end; i += mostTogether) binder.bind(i, std::min(i + mostTogether, end));
    });
    return bindings;
}

}  // namespace whorl
