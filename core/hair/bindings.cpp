// SPDX-License-Identifier: Apache-2.0
#include "core/hair/bindings.h"

#include "core/base/parallel.h"
#include "core/hair/bindings.kernel.h"
#include "core/hair/nearby_guides.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace whorl {
namespace {

// Hairs that look for their guides together, at most; far apart ones are halved down to the least number.
constexpr std::size_t mostTogether = 64;
constexpr std::size_t leastTogether = 4;

// Turns collected until sixteen can be made at once.
class Turns {
public:
    ~Turns() { flush(); }
    void add(const glm::vec3& from, const glm::vec3& to, float weight, float* matrix) {
        if (glm::dot(from, to) < -0.9f) {
            // Nearly opposite: single precision has no digits left.
            const glm::mat3 turn = minimalRotation(from, to);
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 3; ++column) *matrix++ = weight * turn[column][row];
            return;
        }
        for (int axis = 0; axis < 3; ++axis) {
            m_turns.from[axis][m_count] = from[axis];
            m_turns.to[axis][m_count] = to[axis];
        }
        m_turns.weight[m_count] = weight;
        m_out[m_count] = matrix;
        if (++m_count == guideLanes) flush();
    }

private:
    void flush() {
        if (m_count == 0) return;
        WHORL_PICK(weightedTurns)(m_turns);
        for (std::size_t i = 0; i < m_count; ++i)
            for (std::size_t k = 0; k < 9; ++k) m_out[i][k] = m_turns.matrix[k][i];
        m_count = 0;
    }
    TurnColumns m_turns{};
    std::array<float*, guideLanes> m_out{};
    std::size_t m_count = 0;
};

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
        const bool turned = m_groups[m_roots[hair].group].params.general.interpolation.index == 0;
        m_bindings.counts[hair] = static_cast<std::uint8_t>(count);
        for (std::size_t j = 0; j < count; ++j) {
            const Neighbour& neighbour = m_neighbours[j];
            m_bindings.guides[first + j] = neighbour.guide;
            float* matrix = &m_bindings.matrices[(first + j) * 9];
            if (turned) {
                m_turns.add(neighbour.root->normal, m_roots[hair].normal, neighbour.weight, matrix);
            } else {
                std::fill_n(matrix, 9, 0.0f);
                matrix[0] = matrix[4] = matrix[8] = neighbour.weight;
            }
        }
    }

    const std::vector<Group>& m_groups;
    const GuideIndex& m_index;
    std::span<const HairRoot> m_roots;
    Bindings& m_bindings;
    NearbyGuides m_nearby;
    Turns m_turns;
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
    bindings.matrices.resize(places * 9);
    parallelFor(roots.size(), mostTogether * 16, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        Binder binder(groom, index, roots, bindings);
        for (std::size_t i = begin; i < end; i += mostTogether) binder.bind(i, std::min(i + mostTogether, end));
    });
    return bindings;
}

}  // namespace whorl
