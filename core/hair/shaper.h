// SPDX-License-Identifier: Apache-2.0
// From guides to curves: the first steps of a hair, sixteen at a time.
#pragma once

#include "core/hair/bindings.h"
#include "core/hair/guide_shapes.h"
#include "core/hair/hair_traits.h"
#include "core/hair/shape.kernel.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace whorl {

/// What the curves of one group share.
struct ShapeSpace {
    bool turned = true;  ///< guides are turned from their surface to the hair's
    std::size_t stride = GuideShapes::lanes;
    const float* along = nullptr;  ///< `stride` entries, see ShapeArrays
    const float* ease = nullptr;
    glm::vec3 kinkOffset{0.0f};
};

/// Interpolation, scale, kink and frizz of up to sixteen hairs of one group. One object a thread.
class Shaper {
public:
    static constexpr std::size_t lanes = HairLanes::lanes;

    /// The hair of a lane.
    void set(std::size_t lane, const HairRoot& root, const HairTraits& traits);
    /// Shapes lanes [0, count), hair `hairs[l]` of `bindings` in lane l. Vertex v of lane l goes to [l * stride + v] of
    /// the three arrays.
    void shape(const ShapeSpace& space, const GuideShapes& guides, const Bindings& bindings, const std::uint32_t* hairs,
               std::size_t count, float* x, float* y, float* z);

    const HairLanes& hairs() const { return m_hairs; }

private:
    void turn(const GuideShapes& guides, std::size_t place);

    HairLanes m_hairs{};
    std::vector<std::uint32_t> m_guides, m_starts;  // guide j of lane l at [j * 16 + l]
    std::vector<float> m_weights, m_matrices;
};

}  // namespace whorl
