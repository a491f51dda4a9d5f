// SPDX-License-Identifier: Apache-2.0
// Which way hair lies on the skin: a tangent direction everywhere, spread from strokes over the surface.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/field_stroke.h"
#include "core/model/lic_params.h"
#include "core/model/parting.h"
#include "core/surface/surface.h"

#include <complex>
#include <memory>
#include <span>
#include <vector>

// Seed 002 (Mao et al., section 3): the artist gives growing area and parting, a default direction follows from
// gravity, strokes set the direction where they pass, and the rest is interpolated. Here the interpolation is the
// smoothest field of tangent vectors that follows the strokes and, away from them, leans on the default: one sparse
// linear system over the vertices, where vectors are compared after turning them along with the skin (connection
// Laplacian: Knoeppel et al., "Globally Optimal Direction Fields", 2013). Nothing is compared across a parting or
// outside the growing area.

namespace whorl {

/// Where the field turns around a point: +1 a whorl or a star, -1 a saddle.
struct FieldSingularity {
    std::uint32_t triangle = 0;
    int index = 0;
    bool operator==(const FieldSingularity&) const = default;
};

/// Directions at the vertices. Immutable; any thread may ask. Cheap to copy.
class DirectionField {
public:
    DirectionField() = default;

    bool empty() const { return m_state == nullptr; }
    /// Unit tangent (perpendicular to the normal there) at each vertex; zero where no hair grows.
    std::span<const glm::vec3> vertices() const;
    /// One a triangle: 1 inside the growing area. Empty for an empty field.
    std::span<const std::uint8_t> grows() const;
    /// Unit tangent at a place of the skin, from those of the triangle's vertices that no parting separates from it;
    /// zero where no hair grows or directions cancel out.
    glm::vec3 at(const SurfacePoint& point) const;
    /// True when a parting lies between two places that are near each other.
    bool parted(const SurfacePoint& a, const SurfacePoint& b) const;
    /// Triangles around which directions turn once or more, in order; none at partings.
    std::vector<FieldSingularity> singularities() const;

private:
    friend class FieldSolver;
    struct State;
    std::shared_ptr<const State> m_state;
};

/// What mesh, growing area and partings alone decide, made once. It also keeps what the last solution leaves valid, so
/// that solving again after one stroke has changed takes a fraction of the time; the field is the same to the last bit
/// as that of a new solver. Any thread may solve; they take turns. Copies share all of it.
class FieldSolver {
public:
    /// `grows`: one a triangle. Fails only when cancelled.
    static Result<FieldSolver> make(std::shared_ptr<const Surface> surface, std::span<const std::uint8_t> grows,
                                    std::span<const Parting> partings, Progress& progress);

    /// The field that follows `strokes`, and the default direction in pieces of the growing area (by border or parting
    /// on their own) that no stroke touches. Points of strokes outside the growing area have no effect. Within the
    /// radius of Attract, Repel and Whorl, measured over the skin, hair points to the line, from it or around the first
    /// point; towards the rim that blends into what is around. Fails only when cancelled.
    Result<DirectionField> solve(std::span<const FieldStroke> strokes, const FieldParams& params,
                                 Progress& progress) const;
    /// The default direction alone: downhill along `gravity`, and away from near partings. Not smoothed.
    DirectionField defaults(const FieldParams& params) const;

private:
    struct State;
    std::shared_ptr<const State> m_state;
};

}  // namespace whorl
