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
    Result<gl::Program> points = gl::Program::compute("hair_points.comp.glsl");
    if (!points) return points.error();
    Result<gl::Program> quick = gl::Program::compute("hair_points.comp.glsl", "#define QUICK\n");
    if (!quick) return quick.error();
    Result<gl::Program> smooth = gl::Program::draw("hair.vert.glsl", "hair.frag.glsl", "#define SMOOTH\n");
    if (!smooth) return smooth.error();
    Result<gl::Program> plain = gl::Program::draw("hair.vert.glsl", "hair.frag.glsl");
    if (!plain) return plain.error();
    pass.m_points = std::move(*points);
    pass.m_quickPoints = std::move(*quick);
    pass.m_ribbons = std::move(*smooth);
    pass.m_plainRibbons = std::move(*plain);
    pass.m_positions = gl::Buffer("hair positions");
    pass.m_widths = gl::Buffer("hair widths");
    pass.m_colours = gl::Buffer("hair colours");
    pass.m_first = gl::Buffer("hair first vertices");
    pass.m_roots = gl::Buffer("hair roots");
    pass.m_vertices = gl::Buffer("hair vertices");
    pass.m_orderBuffer = gl::Buffer("hair order");
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
    m_indexedDetail = {};
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

void HairPass::prepare(const HairDetail& detail, const glm::vec3& eye, const glm::vec3& forward) {
    if (m_strands == nullptr) return;
    const std::size_t hairs = detail.hairs(*m_strands);
    const std::size_t points = hairs * detail.pointsPerHair;
    const bool reordered = m_order.update(*m_strands, detail, eye, forward);
    if (reordered && detail.wholeHairs) m_orderBuffer.upload(m_order.order());
    m_vertices.reserve(points * 2 * vertexBytes);
    m_positions.bindStorage(0);
    m_widths.bindStorage(1);
    m_colours.bindStorage(2);
    m_first.bindStorage(3);
    m_roots.bindStorage(4);
    m_orderBuffer.bindStorage(5);
    m_vertices.bindStorage(6);
    gl::Program& program = detail.wholeHairs ? m_quickPoints : m_points;
    program.set("hairCount", static_cast<unsigned>(hairs));
    program.set("stride", detail.stride);
    program.set("pointsPerHair", detail.pointsPerHair);
    program.set("widthScale", detail.widthScale);
    program.set("ordered", detail.wholeHairs ? 1 : 0);
    program.use();
    gl::dispatch((points + 63) / 64);
    makeIndices(detail, reordered);
    gl::vertexBarrier();
}

void HairPass::makeIndices(const HairDetail& detail, bool reordered) {
    const std::size_t pieces = detail.pointsPerHair - 1;
    const std::size_t segments = detail.hairs(*m_strands) * pieces;
    // Whole hairs: the compute shader puts them in order, and the indices depend on the numbers only.
    if (detail.wholeHairs ? detail == m_indexedDetail : !reordered) return;
    m_indexedDetail = detail.wholeHairs ? detail : HairDetail{};
    m_indexScratch.resize(segments * 6);
    parallelFor(segments, 8192, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto segment = detail.wholeHairs ? static_cast<std::uint32_t>(i) : m_order.order()[i];
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

void HairPass::draw(bool smooth) {
    if (m_strands == nullptr) return;
    (smooth ? m_ribbons : m_plainRibbons).use();
    gl::apply({.depth = gl::Depth::Test, .blend = gl::Blend::Over});
    m_vertexArray.bind(m_vertices, vertexBytes, m_indices);
    gl::drawIndexed32(m_indexCount);
}

}  // namespace whorl
