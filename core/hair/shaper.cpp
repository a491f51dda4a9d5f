// SPDX-License-Identifier: Apache-2.0
#include "core/hair/shaper.h"

#include "core/surface/surface_point.h"

#include <algorithm>
#include <array>

namespace whorl {

void Shaper::set(std::size_t lane, const HairRoot& root, const HairTraits& traits) {
    HairLanes& h = m_hairs;
    h.rootX[lane] = root.position.x + root.normal.x * traits.displacement;
    h.rootY[lane] = root.position.y + root.normal.y * traits.displacement;
    h.rootZ[lane] = root.position.z + root.normal.z * traits.displacement;
    h.normalX[lane] = root.normal.x;
    h.normalY[lane] = root.normal.y;
    h.normalZ[lane] = root.normal.z;
    h.scale[lane] = traits.scale;
    for (int axis = 0; axis < 3; ++axis) {
        h.frizz[axis][lane] = traits.frizz[axis];
        h.kinkFrequency[axis][lane] = traits.kinkFrequency[axis];
    }
    h.frizzRoot[lane] = traits.frizzRoot;
    h.frizzTip[lane] = traits.frizzTip;
    h.kinkRoot[lane] = traits.kinkRoot;
    h.kinkTip[lane] = traits.kinkTip;
}

// Matrices of one guide of each lane.
void Shaper::turn(const GuideShapes& guides, std::size_t place) {
    float cosine[lanes];
    float* matrix = &m_matrices[place * 9 * lanes];
    const TurnArrays arrays{
        guides.normals.data(), &m_guides[place * lanes], &m_weights[place * lanes], &m_hairs, matrix, cosine};
    WHORL_PICK(turnGuides)(arrays);
    for (std::size_t l = 0; l < lanes; ++l) {
        if (!(cosine[l] < -0.9f)) continue;
        // Nearly opposite: single precision has no digits left.
        const float* from = &guides.normals[std::size_t{3} * m_guides[place * lanes + l]];
        const glm::mat3 exact =
            minimalRotation({from[0], from[1], from[2]}, {m_hairs.normalX[l], m_hairs.normalY[l], m_hairs.normalZ[l]});
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                matrix[static_cast<std::size_t>(row * 3 + column) * lanes + l] =
                    m_weights[place * lanes + l] * exact[column][row];
    }
}

void Shaper::shape(const ShapeSpace& space, const GuideShapes& guides, const Bindings& bindings,
                   const std::uint32_t* hairs, std::size_t count, float* x, float* y, float* z) {
    const std::size_t places = bindings.perHair;
    m_guides.resize(places * lanes);
    m_starts.resize(places * lanes);
    m_weights.resize(places * lanes);
    m_matrices.resize(places * 9 * lanes);
    std::array<std::uint8_t, lanes> counts{};
    std::size_t most = 0;
    for (std::size_t l = 0; l < lanes; ++l) {
        // Lanes without a hair, and places without a guide, repeat one that there is.
        const std::size_t hair = hairs[std::min(l, count - 1)];
        const std::size_t used = bindings.counts[hair];
        counts[l] = static_cast<std::uint8_t>(used);
        most = std::max(most, used);
        const std::uint32_t* ids = &bindings.guides[hair * places];
        const float* weights = &bindings.weights[hair * places];
        for (std::size_t j = 0; j < places; ++j) {
            const bool there = j < used;
            const std::uint32_t guide = there ? ids[j] : used > 0 ? ids[0] : 0;
            m_guides[j * lanes + l] = guide;
            m_starts[j * lanes + l] = guides.first[guide];
            m_weights[j * lanes + l] = there ? weights[j] : 0.0f;
        }
    }
    for (std::size_t j = 0; j < most; ++j) {
        if (space.turned) {
            turn(guides, j);
            continue;
        }
        float* matrix = &m_matrices[j * 9 * lanes];
        std::fill_n(matrix, 9 * lanes, 0.0f);
        for (const std::size_t diagonal : {0, 4, 8})
            std::copy_n(&m_weights[j * lanes], lanes, matrix + diagonal * lanes);
    }
    const ShapeArrays arrays{guides.x.data(),
                             guides.y.data(),
                             guides.z.data(),
                             &m_hairs,
                             count,
                             counts.data(),
                             m_starts.data(),
                             m_matrices.data(),
                             space.stride,
                             space.along,
                             space.ease,
                             {space.kinkOffset.x, space.kinkOffset.y, space.kinkOffset.z},
                             x,
                             y,
                             z};
    WHORL_PICK(shapeHairs)(arrays);
}

}  // namespace whorl
