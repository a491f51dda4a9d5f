// SPDX-License-Identifier: Apache-2.0
// Hair as camera-facing ribbons, lit along the strand; drawn by the graphics card, or made ready for StrandRaster.
#pragma once

#include "core/hair/strands.h"
#include "core/model/surface_mesh.h"
#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/passes/hair_order.h"
#include "render/passes/map_texture.h"
#include "render/passes/strand_raster.h"

#include <memory>
#include <vector>

namespace whorl {

class HairPass {
public:
    static Result<HairPass> create();

    /// Uploads when the pointer differs from the last one. Root normals come from `mesh`.
    void setStrands(std::shared_ptr<const Strands> strands, const SurfaceMesh& mesh, Uploads& uploads);
    const Strands* strands() const { return m_strands.get(); }

    /// Projects and lights all points, sorts the segments. Scene block and volumes must be bound.
    void prepare(const HairDetail& detail, const glm::vec3& eye, const glm::vec3& forward);
    /// Draws what was prepared.
    void draw();

    /// The same for the processor: points on the picture and segments from far to near. `quick`: with highlights of the
    /// key light only.
    void preparePoints(const HairDetail& detail, const glm::vec3& eye, const glm::vec3& forward, bool quick);
    const std::vector<RasterPoint>& points() const { return m_points; }
    const std::vector<std::uint32_t>& segments() const { return m_segments; }

private:
    void dispatch(gl::Program& program, const HairDetail& detail);
    void makeIndices(const HairDetail& detail);

    std::shared_ptr<const Strands> m_strands;
    HairOrder m_order;
    gl::Program m_corners;
    gl::Program m_allPoints;
    gl::Program m_quickPoints;
    gl::Program m_ribbons;
    gl::VertexArray m_vertexArray;
    gl::Buffer m_positions;
    gl::Buffer m_widths;
    gl::Buffer m_colours;
    gl::Buffer m_first;
    gl::Buffer m_roots;
    gl::Buffer m_vertices;
    gl::Buffer m_indices;
    std::vector<std::uint32_t> m_indexScratch;
    std::size_t m_indexCount = 0;
    std::vector<RasterPoint> m_points;
    std::vector<std::uint32_t> m_segments;
};

}  // namespace whorl
