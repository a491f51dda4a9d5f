// SPDX-License-Identifier: Apache-2.0
// What strokes ask of the direction field.
#pragma once

#include "core/field/field_mesh.h"
#include "core/model/field_stroke.h"

#include <vector>

namespace whorl {

/// That a sum of unknowns be a unit number: weight * |sum of shares * unknowns - wanted|^2 is added to what the solver
/// makes small.
struct FieldWish {
    std::uint32_t unknowns[3]{FieldMesh::none, FieldMesh::none, FieldMesh::none};
    std::uint32_t pairs[3]{};  ///< pairs[k]: that of unknowns k and k + 1, round; where both are there
    FieldMesh::Complex shares[3]{};
    FieldMesh::Complex wanted = 1.0;
    double weight = 0.0;
};

/// Along: at places half an edge apart the field has the line's direction. Attract, Repel, Whorl: so it has at the
/// vertices less than the radius away over the skin that of the way to the line, from it, or around the first point,
/// with a weight that falls smoothly to zero at the radius. Nothing for points off the growing area, nor beyond
/// partings.
std::vector<FieldWish> wishesOf(const FieldMesh& field, const FieldStroke& stroke);

/// The way over the skin from an unknown's vertex to a line.
struct WayToLine {
    std::uint32_t unknown = 0;
    FieldMesh::Complex way;  ///< straight on over the skin, in the vertex's frame, metres
};

/// For the unknowns less than `radius` metres from the line through `points`, by unknown. Points that are not on the
/// mesh part the line. Ways go over edges of the growing area that no parting meets.
std::vector<WayToLine> waysToLine(const FieldMesh& field, std::span<const SurfacePoint> points, float radius);

/// A polyline by its length.
class LineByLength {
public:
    explicit LineByLength(std::vector<glm::vec3> points);
    float length() const { return m_before.empty() ? 0.0f : m_before.back(); }
    /// The place after `metres`; the ends for less and more. Not when there are no points.
    glm::vec3 at(float metres) const;

private:
    std::vector<glm::vec3> m_points;
    std::vector<float> m_before;
};

/// The pieces of a stroke's line between points that are not on the mesh.
std::vector<LineByLength> linesOf(const SurfaceMesh& mesh, std::span<const SurfacePoint> points);

}  // namespace whorl
