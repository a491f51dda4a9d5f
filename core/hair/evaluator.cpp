// SPDX-License-Identifier: Apache-2.0
#include "core/hair/evaluator.h"

#include "core/base/polynomials.h"
#include "core/hair/curve.h"
#include "core/hair/shape.kernel.h"
#include "core/model/modifiers/rows.h"

#include <algorithm>

namespace whorl {

std::vector<GroupTables> makeGroupTables(const Groom& groom) {
    std::vector<GroupTables> tables;
    for (const Group& group : *groom.groups) {
        GroupTables t;
        t.group = tables.size();
        t.segments = std::max(group.params.general.segments, 1);
        t.stride = GuideShapes::stride(t.segments);
        t.keepOutside = group.params.general.keepOutside;
        t.members = static_cast<std::uint32_t>(std::max(group.params.strands.hairs, 0));
        t.usualWidth = group.params.general.rootThickness.value;
        for (std::size_t v = 0; v < t.stride; ++v) {
            t.along.push_back(std::min(1.0f, static_cast<float>(v) / static_cast<float>(t.segments)));
            t.ease.push_back(smoothStep(4.0f * t.along.back()));
        }
        tables.push_back(std::move(t));
    }
    return tables;
}

void Evaluator::make(const GroupTables& group, std::span<const std::uint32_t> which) {
    const std::size_t rows = static_cast<std::size_t>(group.segments) + 3;
    for (std::vector<float>* row : {&m_x, &m_y, &m_z}) row->resize(lanes * group.stride);
    for (Rows* all : {&m_row, &m_normal})
        for (std::vector<float>& row : *all) row.resize(lanes * rows);
    for (std::size_t i = 0; i < which.size(); ++i) m_roots[i] = m_grown.roots[which[i]];
    shape(group, which.size());
    if (!m_sources.chain.shapes(group.group).empty()) modify(group, which.size());
    std::size_t most = 0;
    for (std::size_t i = 0; i < which.size(); ++i) most = std::max(most, setPoints(group, which[i], i));
    for (std::size_t l = which.size(); l < lanes; ++l) repeatLane(which.size() - 1, l, most + 1);
    frame(most);
    if (group.members > 0) {
        makeMembers(group, which);
    } else {
        for (std::size_t i = 0; i < which.size(); ++i) store(m_row, m_normal, i, m_grown.firstStrand[which[i]]);
    }
    for (std::size_t i = 0; i < which.size(); ++i) setLook(group, which[i]);
}

void Evaluator::shape(const GroupTables& group, std::size_t count) {
    const HairSources& s = m_sources;
    for (std::size_t i = 0; i < count; ++i) {
        const HairRoot& root = s.roots[m_roots[i]];
        const glm::vec3 start = root.position + root.normal * s.traits[m_roots[i]].displacement;
        for (int axis = 0; axis < 3; ++axis) m_starts[i * 3 + static_cast<std::size_t>(axis)] = start[axis];
        m_surfaceX[i] = root.normal.x;
        m_surfaceY[i] = root.normal.y;
        m_surfaceZ[i] = root.normal.z;
    }
    const ShapeArrays arrays{s.shapes.x.data(),
                             s.shapes.y.data(),
                             s.shapes.z.data(),
                             s.shapes.first.data(),
                             s.bindings.perHair,
                             s.bindings.counts.data(),
                             s.bindings.guides.data(),
                             s.bindings.matrices.data(),
                             s.traits.data(),
                             m_roots,
                             m_starts,
                             group.stride,
                             group.along.data(),
                             group.ease.data(),
                             {s.kinkOffset.x, s.kinkOffset.y, s.kinkOffset.z},
                             m_x.data(),
                             m_y.data(),
                             m_z.data()};
    WHORL_PICK(shapeHairs)(arrays, 0, count);
}

// All modifiers of the group, sixteen hairs in lanes.
void Evaluator::modify(const GroupTables& group, std::size_t count) {
    const std::size_t full = static_cast<std::size_t>(group.segments) + 1;
    std::vector<float>* const hairs[3] = {&m_x, &m_y, &m_z};
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<float>& from = *hairs[axis];
        std::vector<float>& to = m_row[static_cast<std::size_t>(axis)];
        for (std::size_t l = 0; l < lanes; ++l) {
            const float* hair = &from[std::min(l, count - 1) * group.stride];
            for (std::size_t v = 0; v < full; ++v) to[v * lanes + l] = hair[v];
        }
    }
    for (std::size_t l = 0; l < lanes; ++l) {
        const HairRoot& root = m_sources.roots[m_roots[std::min(l, count - 1)]];
        m_keys[l] = m_locks[l] = ModifierChain::hairKey(root.id);
    }
    m_scratch.resize(ModifierArrays::scratchRows * full * lanes);
    for (const ModifierStep& step : m_sources.chain.shapes(group.group)) runStep(group, step, count);
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<float>& from = m_row[static_cast<std::size_t>(axis)];
        std::vector<float>& to = *hairs[axis];
        for (std::size_t l = 0; l < count; ++l)
            for (std::size_t v = 0; v < full; ++v) to[l * group.stride + v] = from[v * lanes + l];
    }
}

void Evaluator::runStep(const GroupTables& group, const ModifierStep& step, std::size_t count) {
    const HairSources& s = m_sources;
    m_numbers.resize(step.numbers.size() * lanes);
    for (std::size_t r = 0; r < step.numbers.size(); ++r) {
        const ModifierNumber& number = step.numbers[r];
        float* row = &m_numbers[r * lanes];
        if (!number.map) {
            std::fill_n(row, lanes, number.at({}));
            continue;
        }
        for (std::size_t l = 0; l < lanes; ++l) row[l] = l < count ? number.at(s.roots[m_roots[l]].uv) : row[count - 1];
    }
    // Nothing to do where the map of the amount is black.
    if (std::all_of(&m_numbers[lanes], &m_numbers[2 * lanes], [](float amount) { return amount <= 0.0f; })) return;

    ModifierArrays arrays{};
    arrays.vertices = static_cast<std::size_t>(group.segments) + 1;
    arrays.x = m_row[0].data();
    arrays.y = m_row[1].data();
    arrays.z = m_row[2].data();
    arrays.scratch = m_scratch.data();
    arrays.along = group.along.data();
    arrays.ease = group.ease.data();
    arrays.numbers = m_numbers.data();
    arrays.random = m_random;
    s.chain.noiseOffset(step, arrays.offset);
    for (std::size_t l = 0; l < lanes; ++l) {
        float random[ModifierArrays::randomRows];
        s.chain.random(step, step.shared ? m_locks[l] : m_keys[l], random);
        for (std::size_t r = 0; r < ModifierArrays::randomRows; ++r) m_random[r * lanes + l] = random[r];
    }
    std::uint32_t first[lanes] = {};
    float weight[lanes] = {}, thickness[lanes];
    if (step.kind == modifierKindOf<ClumpParams>) {
        const ClumpCentres& centres = s.clumps.clumps[step.clump];
        if (centres.empty()) return;
        const std::vector<std::uint32_t>& nearest = s.centres[step.clump];
        const float* flyaways = &m_numbers[ClumpRows::Flyaways * lanes];
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::uint32_t centre = nearest[m_roots[std::min(l, count - 1)]];
            if (centre == ClumpCentres::none) continue;
            first[l] = centre * static_cast<std::uint32_t>(centres.stride);
            weight[l] = 1.0f;
            const bool gathered = m_random[l] >= flyaways[l] && m_numbers[lanes + l] > 0.0f;
            if (gathered) m_locks[l] = ModifierChain::lockKey(centres.roots[centre].id);
        }
        arrays.centreX = centres.x.data();
        arrays.centreY = centres.y.data();
        arrays.centreZ = centres.z.data();
    }
    for (std::size_t l = 0; l < lanes; ++l) {
        const float width = s.traits[m_roots[std::min(l, count - 1)]].thickness;
        thickness[l] = group.usualWidth > 0.0f ? width / group.usualWidth : 1.0f;
    }
    arrays.centreFirst = first;
    arrays.centreWeight = weight;
    arrays.thickness = thickness;
    modifierKernel(step.kind)(arrays);
}

// Keeps the hair outside and puts it into lane `lane`, cut unless members are to be made from it, with one more row
// that goes straight on. Returns its vertex count.
std::size_t Evaluator::setPoints(const GroupTables& group, std::uint32_t hair, std::size_t lane) {
    const std::size_t full = static_cast<std::size_t>(group.segments) + 1;
    const std::size_t row = lane * group.stride;
    m_points.resize(full);
    for (std::size_t v = 0; v < full; ++v) m_points[v] = {m_x[row + v], m_y[row + v], m_z[row + v]};
    if (group.keepOutside && m_sources.skin) m_sources.skin->keepOutside(m_points, group.ease);
    std::size_t vertices = full;
    if (group.members == 0) {
        const std::uint32_t strand = m_grown.firstStrand[hair];
        vertices = m_strands.firstVertex[strand + 1] - m_strands.firstVertex[strand];
        const CutEnd end = cutEnd(m_sources.traits[m_grown.roots[hair]].cut, group.segments);
        if (end.parameter < static_cast<float>(group.segments))
            m_points[vertices - 1] = strandPoint(m_points, end.parameter);
    }
    for (std::size_t v = 0; v < vertices; ++v) setRow(v, lane, m_points[v]);
    const glm::vec3 on = m_points[vertices - 1] * 2.0f - m_points[vertices - 2];
    for (std::size_t v = vertices; v < full + 2; ++v) setRow(v, lane, on);
    return vertices;
}

void Evaluator::setRow(std::size_t v, std::size_t lane, const glm::vec3& p) {
    m_row[0][v * lanes + lane] = p.x;
    m_row[1][v * lanes + lane] = p.y;
    m_row[2][v * lanes + lane] = p.z;
}

void Evaluator::repeatLane(std::size_t from, std::size_t to, std::size_t rows) {
    for (std::size_t v = 0; v < rows; ++v)
        setRow(v, to, {m_row[0][v * lanes + from], m_row[1][v * lanes + from], m_row[2][v * lanes + from]});
    m_surfaceX[to] = m_surfaceX[from];
    m_surfaceY[to] = m_surfaceY[from];
    m_surfaceZ[to] = m_surfaceZ[from];
}

void Evaluator::frame(std::size_t vertices) {
    const FrameArrays arrays{m_row[0].data(),    m_row[1].data(),   m_row[2].data(), m_surfaceX,
                             m_surfaceY,         m_surfaceZ,        vertices,        m_normal[0].data(),
                             m_normal[1].data(), m_normal[2].data()};
    WHORL_PICK(frameHairs)(arrays);
}

void Evaluator::store(const Rows& points, const Rows& normals, std::size_t lane, std::size_t strand) {
    const std::size_t first = m_strands.firstVertex[strand];
    const std::size_t vertices = m_strands.firstVertex[strand + 1] - first;
    for (std::size_t v = 0; v < vertices; ++v) {
        const std::size_t from = v * lanes + lane;
        m_strands.positions[first + v] = {points[0][from], points[1][from], points[2][from]};
        m_strands.normals[first + v] = {normals[0][from], normals[1][from], normals[2][from]};
    }
}

void Evaluator::setLook(const GroupTables& group, std::uint32_t hair) {
    const std::size_t root = m_grown.roots[hair];
    const HairTraits& traits = m_sources.traits[root];
    const std::uint32_t firstStrand = m_grown.firstStrand[hair], lastStrand = m_grown.firstStrand[hair + 1];
    const std::size_t first = m_strands.firstVertex[firstStrand];
    const std::size_t vertices = m_strands.firstVertex[firstStrand + 1] - first;
    const float last = cutEnd(traits.cut, group.segments).parameter / static_cast<float>(group.segments);
    const glm::vec4 rootColour(traits.rootColour[0], traits.rootColour[1], traits.rootColour[2], traits.rootColour[3]);
    const glm::vec4 tipColour(traits.tipColour[0], traits.tipColour[1], traits.tipColour[2], traits.tipColour[3]);
    lookNumbers(m_sources.chain, group.group, m_sources.roots[root].uv, m_taper);
    for (std::size_t v = 0; v < vertices; ++v) {
        const float along = v + 1 < vertices ? group.along[v] : last;
        const float width = traits.rootWidth + (traits.tipWidth - traits.rootWidth) * along;
        m_strands.widths[first + v] = m_taper.empty() ? width : width * taperAt(m_taper, along);
        m_strands.colours[first + v] = rootColour + (tipColour - rootColour) * along;
    }
    for (std::uint32_t strand = firstStrand + 1; strand < lastStrand; ++strand) {
        const std::size_t to = m_strands.firstVertex[strand];
        std::copy_n(&m_strands.widths[first], vertices, &m_strands.widths[to]);
        std::copy_n(&m_strands.colours[first], vertices, &m_strands.colours[to]);
    }
}

}  // namespace whorl
