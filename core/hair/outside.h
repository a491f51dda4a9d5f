// SPDX-License-Identifier: Apache-2.0
// Keeps hair out of the head.
#pragma once

#include "core/surface/distance_field.h"

#include <glm/vec3.hpp>

#include <memory>
#include <span>

namespace whorl {

/// The skin of a mesh and how hair keeps away from it. Immutable once made; any thread may ask.
class SkinGuard {
public:
    explicit SkinGuard(std::shared_ptr<const DistanceField> skin);

    const DistanceField& skin() const { return *m_skin; }
    /// Distance that hair keeps from the skin once it has left its root: a part of the distance field's spacing, which
    /// is about what the field can be wrong by.
    float clearance() const { return m_clearance; }

    /// Moves vertices that are inside the skin, or nearer than the clearance, outwards. `ease` (one a vertex, 0 at the
    /// root, growing to 1) scales the clearance, so that hair leaves its root without a step. Vertices farther than
    /// twice the clearance stay where they are, those between are eased over; the first vertex never moves. A hair that
    /// dives deeper than the field reaches is laid along the skin instead, and goes on from there in its own
    /// directions.
    void keepOutside(std::span<glm::vec3> points, std::span<const float> ease) const { keepFrom({}, points, ease); }

    /// Where `keepOutside` begins to do something: vertices before `first` stay.
    struct Start {
        std::size_t first = 1;
        float awayBefore = 0.0f;  ///< distance of the vertex before
    };
    static constexpr std::size_t lanes = 16;
    /// Of sixteen hairs in lanes: coordinate of vertex v of lane l at [v * 16 + l]. `vertices` where nothing is to do.
    void findStarts(const float* x, const float* y, const float* z, std::span<const float> ease, std::size_t vertices,
                    Start (&starts)[lanes]) const;
    /// As keepOutside, for a hair that starts so.
    void keepFrom(Start start, std::span<glm::vec3> points, std::span<const float> ease) const;

private:
    bool dives(const glm::vec3& from, float distanceFrom, const glm::vec3& to, float distanceTo) const;

    std::shared_ptr<const DistanceField> m_skin;
    float m_clearance = 0.0f;
};

}  // namespace whorl
