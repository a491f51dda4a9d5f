// SPDX-License-Identifier: Apache-2.0
#include "core/hair/evaluator.h"

#include "core/base/polynomials.h"
#include "core/hair/curves.kernel.h"

#include <algorithm>

namespace whorl {
namespace {

// One coordinate of the Catmull-Rom curve of a lane (vertex v at [v * 16 + lane]) at `parameter`: see strandPoint.
float laneCurveAt(const LineVector& row, std::size_t lane, std::size_t points, float parameter) {
    constexpr std::size_t lanes = Evaluator::lanes;
    const std::size_t piece = std::min(static_cast<std::size_t>(parameter), points - 2);
    const float t = parameter - static_cast<float>(piece);
    const float a = row[(piece > 0 ? piece - 1 : 0) * lanes + lane], b = row[piece * lanes + lane],
                c = row[(piece + 1) * lanes + lane], d = row[std::min(piece + 2, points - 1) * lanes + lane];
    const float k1 = (c - a) * 0.5f, k2 = a - b * 2.5f + c * 2.0f - d * 0.5f, k3 = (d - a) * 0.5f + (b - c) * 1.5f;
    return b + (k1 + (k2 + k3 * t) * t) * t;
}

}  // namespace

std::vector<GroupTables> makeGroupTables(const Groom& groom, const ModifierChain& chain) {
    std::vector<GroupTables> tables;
    for (const Group& group : *groom.groups) {
        GroupTables t;
        t.group = tables.size();
        t.segments = std::max(group.params.general.segments, 1);
        t.stride = GuideShapes::stride(t.segments);
        t.turned = group.params.general.interpolation.index == 0;
        t.keepOutside = group.params.general.keepOutside;
        t.members = static_cast<std::uint32_t>(std::max(group.params.strands.hairs, 0));
        t.usualWidth = group.params.general.rootThickness.value;
        for (std::size_t v = 0; v < t.stride; ++v) {
            t.along.push_back(std::min(1.0f, static_cast<float>(v) / static_cast<float>(t.segments)));
            t.ease.push_back(smoothStep(4.0f * t.along.back()));
        }
        if (looksAreEven(chain, t.group)) {
            lookNumbers(chain, t.group, {}, t.tapers);
            for (const float along : t.along) t.taperAlong.push_back(taperAt(t.tapers, along));
        }
        tables.push_back(std::move(t));
    }
    return tables;
}

// Fills the lanes.
void Evaluator::take(const GroupTables& group, std::span<const std::uint32_t> which) {
    m_count = which.size();
    for (std::size_t l = 0; l < lanes; ++l) {
        const std::uint32_t hair = which[std::min(l, m_count - 1)];
        m_roots[l] = m_grown.roots[hair];
        m_traits[l] = &m_sources.traits[m_roots[l]];
        m_firstStrand[l] = m_grown.firstStrand[hair];
        const std::uint32_t* first = &m_strands.firstVertex[m_firstStrand[l]];
        m_vertices[l] = first[1] - first[0];
        m_ends[l] = cutEnd(m_traits[l]->cut, group.segments).parameter;
    }
    // Parts of cache lines written past the caches would cost more than they save.
    constexpr std::uint32_t wholeLines = 16;
    m_past = m_mayPass && group.vertices() % wholeLines == 0 && !anyCut(group) &&
             std::all_of(m_firstStrand, m_firstStrand + lanes,
                         [&](std::uint32_t strand) { return m_strands.firstVertex[strand] % wholeLines == 0; });
}

void Evaluator::make(const GroupTables& group, std::span<const std::uint32_t> which) {
    const std::size_t rows = (group.stride + 4) * lanes;
    if (m_row[0].size() < rows) {
        for (Rows* all : {&m_row, &m_normal})
            for (LineVector& row : *all) row.resize(rows);
    }
    take(group, which);
    shape(group);
    if (!m_sources.chain.shapes(group.group).empty()) modify(group);
    if (group.keepOutside && m_sources.skin) keepOutside(group);
    endRows(group);
    if (group.members > 0) {
        frame(group.vertices());
        makeMembers(group);
    } else {
        frame(*std::max_element(m_vertices, m_vertices + lanes));
        store();
        look(group);
    }
}

void Evaluator::setLook(const GroupTables& group, std::span<const std::uint32_t> which) {
    take(group, which);
    look(group);
}

void Evaluator::shape(const GroupTables& group) {
    const HairSources& s = m_sources;
    for (std::size_t l = 0; l < lanes; ++l) m_shaper.set(l, s.roots[m_roots[l]], *m_traits[l]);
    for (LineVector& axis : m_hairs) axis.resize(lanes * group.stride);
    const ShapeSpace space{group.turned, group.stride, group.along.data(), group.ease.data(), s.kinkOffset};
    m_shaper.shape(space, s.shapes, s.bindings, m_roots, m_count, m_hairs[0].data(), m_hairs[1].data(),
                   m_hairs[2].data());
    LaneArrays arrays{};
    arrays.stride = group.stride;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float* hairs = m_hairs[axis].data();
        for (std::size_t l = m_count; l < lanes; ++l)
            std::copy_n(hairs + (m_count - 1) * group.stride, group.stride, hairs + l * group.stride);
        arrays.hairs[axis] = hairs;
        arrays.rows[axis] = m_row[axis].data();
    }
    WHORL_PICK(hairsToLanes)(arrays);
}

void Evaluator::keepOutside(const GroupTables& group) {
    const SkinGuard& skin = *m_sources.skin;
    SkinGuard::Start starts[lanes];
    skin.findStarts(m_row[0].data(), m_row[1].data(), m_row[2].data(), group.ease, group.vertices(), starts);
    m_points.resize(group.vertices());
    for (std::size_t l = 0; l < lanes; ++l) {
        if (starts[l].first >= m_points.size()) continue;
        // Lanes without a hair of their own repeat the last one's points.
        if (l < m_count) {
            for (std::size_t v = starts[l].first - 1; v < m_points.size(); ++v)
                m_points[v] = {m_row[0][v * lanes + l], m_row[1][v * lanes + l], m_row[2][v * lanes + l]};
            skin.keepFrom(starts[l], m_points, group.ease);
        }
        for (std::size_t v = starts[l].first; v < m_points.size(); ++v) {
            m_row[0][v * lanes + l] = m_points[v].x;
            m_row[1][v * lanes + l] = m_points[v].y;
            m_row[2][v * lanes + l] = m_points[v].z;
        }
    }
}

// Cuts single hairs, and gives all one more row that goes straight on.
void Evaluator::endRows(const GroupTables& group) {
    if (group.members > 0 || !anyCut(group)) {
        straightOn(m_row, group);
    } else {
        for (std::size_t l = 0; l < lanes; ++l) cutLane(m_row, group, l);
    }
}

bool Evaluator::anyCut(const GroupTables& group) const {
    return std::any_of(m_ends, m_ends + lanes, [&](float end) { return end < static_cast<float>(group.segments); });
}

void Evaluator::straightOn(Rows& rows, const GroupTables& group) {
    for (LineVector& row : rows) {
        float* on = &row[group.vertices() * lanes];
        const float *last = on - lanes, *before = last - lanes;
        for (std::size_t l = 0; l < lanes; ++l) on[l] = last[l] * 2.0f - before[l];
    }
}

// Ends rows of a lane where its hair is cut, and lets them go straight on from there.
void Evaluator::cutLane(Rows& rows, const GroupTables& group, std::size_t lane) const {
    const std::size_t full = group.vertices(), vertices = m_vertices[lane];
    const bool cut = m_ends[lane] < static_cast<float>(group.segments);
    for (LineVector& row : rows) {
        const std::size_t last = (vertices - 1) * lanes + lane;
        if (cut) row[last] = laneCurveAt(row, lane, full, m_ends[lane]);
        const float on = row[last] * 2.0f - row[last - lanes];
        for (std::size_t v = vertices; v < full + 2; ++v) row[v * lanes + lane] = on;
    }
}

void Evaluator::frame(std::size_t vertices) {
    const HairLanes& hairs = m_shaper.hairs();
    const FrameArrays arrays{m_row[0].data(),    m_row[1].data(),   m_row[2].data(), hairs.normalX,
                             hairs.normalY,      hairs.normalZ,     vertices,        m_normal[0].data(),
                             m_normal[1].data(), m_normal[2].data()};
    WHORL_PICK(frameHairs)(arrays);
}

void Evaluator::store() {
    float *pointsOut[lanes], *normalsOut[lanes];
    for (std::size_t l = 0; l < m_count; ++l) {
        const std::size_t first = m_strands.firstVertex[m_firstStrand[l]];
        pointsOut[l] = &m_strands.positions[first].x;
        normalsOut[l] = &m_strands.normals[first].x;
    }
    WHORL_PICK(storeVectors)
    ({m_count, {m_row[0].data(), m_row[1].data(), m_row[2].data()}, m_vertices, pointsOut, m_past});
    WHORL_PICK(storeVectors)
    ({m_count, {m_normal[0].data(), m_normal[1].data(), m_normal[2].data()}, m_vertices, normalsOut, m_past});
}

// Widths and colours of the hairs and their members, to where they stay.
void Evaluator::look(const GroupTables& group) {
    float *widths[lanes], *colours[lanes];
    for (std::size_t l = 0; l < m_count; ++l) {
        const std::size_t first = m_strands.firstVertex[m_firstStrand[l]];
        widths[l] = &m_strands.widths[first];
        colours[l] = &m_strands.colours[first].x;
    }
    look(group, std::max<std::size_t>(group.members, 1), widths, colours, m_past);
}

void Evaluator::look(const GroupTables& group, std::size_t members, float* const* widths, float* const* colours,
                     bool past) {
    float last[lanes];
    for (std::size_t l = 0; l < m_count; ++l) last[l] = m_ends[l] / static_cast<float>(group.segments);
    const bool tapered = !m_sources.chain.looks(group.group).empty();
    WHORL_PICK(lookHairs)
    ({m_count, members, m_traits, m_vertices, last, group.along.data(), widths, colours, past && !tapered});
    for (std::size_t l = 0; l < m_count && tapered; ++l) {
        taper(group, l, last[l], widths[l]);
        for (std::size_t member = 1; member < members; ++member)
            std::copy_n(widths[l], m_vertices[l], widths[l] + member * m_vertices[l]);
    }
}

// What tapers make of the widths of a lane, which ends at `last`.
void Evaluator::taper(const GroupTables& group, std::size_t lane, float last, float* widths) {
    const std::size_t end = m_vertices[lane] - 1;
    if (!group.tapers.empty()) {
        for (std::size_t v = 0; v < end; ++v) widths[v] *= group.taperAlong[v];
        widths[end] *= taperAt(group.tapers, last);
        return;
    }
    lookNumbers(m_sources.chain, group.group, m_sources.roots[m_roots[lane]].uv, m_tapers);
    for (std::size_t v = 0; v <= end; ++v) widths[v] *= taperAt(m_tapers, v < end ? group.along[v] : last);
}

}  // namespace whorl
