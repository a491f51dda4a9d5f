// SPDX-License-Identifier: Apache-2.0
#include "render/passes/hair_pass.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace whorl {
namespace {

constexpr std::size_t vertexBytes = 32;  // of hair_points.comp.glsl

// The skin's normal at each root and a random number that stays with the hair's id.
std::vector<glm::vec4> rootInfo(const Strands& strands, const SurfaceMesh& mesh) {
    std::vector<glm::vec4> roots(strands.count());
    parallelFor(strands.count(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            glm::vec3 normal(0.0f, 1.0f, 0.0f);
            const std::uint32_t first = strands.firstVertex[i];
            if (strands.roots[i].triangle < mesh.triangleCount()) {
                normal = normalAt(mesh, strands.roots[i]);
            } else if (strands.firstVertex[i + 1] - first > 1) {
                const glm::vec3 way = strands.positions[first + 1] - strands.positions[first];
                const float length = glm::length(way);
                if (length > 0.0f) normal = way / length;
            }
            roots[i] = glm::vec4(normal, randomFloat(0x68616972u, strands.ids[i], 0));
        }
    });
    return roots;
}

}  // namespace

Result<HairPass> HairPass::create() {
    HairPass pass;
    Result<gl::Program> corners = gl::Program::compute("hair_points.comp.glsl");
    if (!corners) return corners.error();
    Result<gl::Program> all = gl::Program::compute("hair_points.comp.glsl", "#define POINTS\n");
    if (!all) return all.error();
    Result<gl::Program> quick = gl::Program::compute("hair_points.comp.glsl", "#define POINTS\n#define QUICK\n");
    if (!quick) return quick.error();
    Result<gl::Program> ribbons = gl::Program::draw("hair.vert.glsl", "hair.frag.glsl");
    if (!ribbons) return ribbons.error();
    pass.m_corners = std::move(*corners);
    pass.m_allPoints = std::move(*all);
    pass.m_quickPoints = std::move(*quick);
    pass.m_ribbons = std::move(*ribbons);
    pass.m_positions = gl::Buffer("hair positions");
    pass.m_widths = gl::Buffer("hair widths");
    pass.m_colours = gl::Buffer("hair colours");
    pass.m_first = gl::Buffer("hair first vertices");
    pass.m_roots = gl::Buffer("hair roots");
    pass.m_vertices = gl::Buffer("hair vertices");
    pass.m_indices = gl::Buffer("hair indices");
    pass.m_vertexArray.attribute(0, gl::VertexArray::Type::Float, 4, 0);
    pass.m_vertexArray.attribute(1, gl::VertexArray::Type::Half, 4, 16);
    pass.m_vertexArray.attribute(2, gl::VertexArray::Type::Float, 2, 24);
    return pass;
}

void HairPass::setStrands(std::shared_ptr<const Strands> strands, const SurfaceMesh& mesh, Uploads& uploads) {
    if (strands == m_strands) return;
    m_strands = std::move(strands);
    m_order.clear();
    if (m_strands == nullptr || m_strands->count() == 0) {
        m_strands = nullptr;
        return;
    }
    m_positions.upload(m_strands->positions);
    m_widths.upload(m_strands->widths);
    m_colours.upload(m_strands->colours);
    m_first.upload(m_strands->firstVertex);
    m_roots.upload(rootInfo(*m_strands, mesh));
    ++uploads.strands;
    uploads.bytes += m_positions.size() + m_widths.size() + m_colours.size() + m_first.size() + m_roots.size();
}

void HairPass::dispatch(gl::Program& program, const HairDetail& detail) {
    const std::size_t hairs = detail.hairs(*m_strands);
    m_positions.bindStorage(0);
    m_widths.bindStorage(1);
    m_colours.bindStorage(2);
    m_first.bindStorage(3);
    m_roots.bindStorage(4);
    m_vertices.bindStorage(6);
    program.set("hairCount", static_cast<unsigned>(hairs));
    program.set("stride", detail.stride);
    program.set("pointsPerHair", detail.pointsPerHair);
    program.set("widthScale", detail.widthScale);
    program.use();
    gl::dispatch((hairs * detail.pointsPerHair + 63) / 64);
}

void HairPass::prepare(const HairDetail& detail, const glm::vec3& eye, const glm::vec3& forward) {
    if (m_strands == nullptr) return;
    m_vertices.reserve(std::size_t{detail.hairs(*m_strands)} * detail.pointsPerHair * 2 * vertexBytes);
    dispatch(m_corners, detail);
    // Either way of drawing may have asked for the order before.
    if (m_order.update(*m_strands, detail, eye, forward)) m_indexCount = 0;
    if (m_indexCount == 0) makeIndices(detail);
    m_segments.clear();
    gl::vertexBarrier();
}

void HairPass::preparePoints(const HairDetail& detail, const glm::vec3& eye, const glm::vec3& forward, bool quick) {
    if (m_strands == nullptr) return;
    const std::size_t count = std::size_t{detail.hairs(*m_strands)} * detail.pointsPerHair;
    m_vertices.reserve(count * sizeof(RasterPoint));
    dispatch(quick ? m_quickPoints : m_allPoints, detail);
    if (m_order.update(*m_strands, detail, eye, forward) || m_segments.empty()) {
        const std::vector<std::uint32_t>& order = m_order.order();
        const std::uint32_t pieces = detail.pointsPerHair - 1;
        m_segments.resize(order.size());
        parallelFor(order.size(), 8192, [&](std::size_t begin, std::size_t end) {
            // A hair has one point more than segments.
            for (std::size_t i = begin; i < end; ++i) m_segments[i] = order[i] + order[i] / pieces;
        });
    }
    m_indexCount = 0;
    m_points.resize(count);
    m_vertices.read(m_points.data(), count * sizeof(RasterPoint));
}

void HairPass::makeIndices(const HairDetail& detail) {
    const std::size_t pieces = detail.pointsPerHair - 1;
    const std::size_t segments = detail.hairs(*m_strands) * pieces;
    m_indexScratch.resize(segments * 6);
    parallelFor(segments, 8192, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t segment = m_order.order()[i];
            // A hair has one point more than segments; a point has two vertices.
            const std::uint32_t left = 2 * (segment + segment / static_cast<std::uint32_t>(pieces));
            std::uint32_t* out = m_indexScratch.data() + i * 6;
            out[0] = left;
            out[1] = left + 2;
            out[2] = left + 1;
            out[3] = left + 1;
            out[4] = left + 2;
            out[5] = left + 3;
        }
    });
    m_indices.upload(m_indexScratch);
    m_indexCount = segments * 6;
}

void HairPass::draw() {
    if (m_strands == nullptr) return;
    m_ribbons.use();
    gl::apply({.depth = gl::Depth::Test, .blend = gl::Blend::Over});
    m_vertexArray.bind(m_vertices, vertexBytes, m_indices);
    gl::drawIndexed32(m_indexCount);
}

}  // namespace whorl
