// SPDX-License-Identifier: Apache-2.0
#include "core/hair/evaluate.h"

#include "core/base/parallel.h"
#include "core/base/polynomials.h"
#include "core/hair/curve.h"
#include "core/hair/shape.kernel.h"

#include <algorithm>

namespace whorl {
namespace {

constexpr std::size_t lanes = GuideShapes::lanes;
constexpr std::size_t blockHairs = 256;

// What all hairs of one group share.
struct GroupTables {
    int segments = 1;
    std::size_t stride = lanes;
    bool keepOutside = false;
    std::vector<float> along;
    std::vector<float> ease;
};

std::vector<GroupTables> makeTables(const Groom& groom) {
    std::vector<GroupTables> tables;
    for (const Group& group : *groom.groups) {
        GroupTables t;
        t.segments = std::max(group.params.general.segments, 1);
        t.stride = GuideShapes::stride(t.segments);
        t.keepOutside = group.params.general.keepOutside;
        for (std::size_t v = 0; v < t.stride; ++v) {
            t.along.push_back(std::min(1.0f, static_cast<float>(v) / static_cast<float>(t.segments)));
            t.ease.push_back(smoothStep(4.0f * t.along.back()));
        }
        tables.push_back(std::move(t));
    }
    return tables;
}

// Widths and colours along one strand.
void setLook(const HairTraits& traits, const GroupTables& group, std::uint32_t strand, Strands& strands) {
    const std::size_t first = strands.firstVertex[strand];
    const std::size_t vertices = strands.firstVertex[strand + 1] - first;
    const float last = cutEnd(traits.cut, group.segments).parameter / static_cast<float>(group.segments);
    const glm::vec4 root(traits.rootColour[0], traits.rootColour[1], traits.rootColour[2], traits.rootColour[3]);
    const glm::vec4 tip(traits.tipColour[0], traits.tipColour[1], traits.tipColour[2], traits.tipColour[3]);
    for (std::size_t v = 0; v < vertices; ++v) {
        const float along = v + 1 < vertices ? group.along[v] : last;
        strands.widths[first + v] = traits.rootWidth + (traits.tipWidth - traits.rootWidth) * along;
        strands.colours[first + v] = root + (tip - root) * along;
    }
}

// Makes up to sixteen hairs of one group at a time. One object a thread.
class Evaluator {
public:
    Evaluator(const HairSources& sources, std::span<const std::uint32_t> grown, Strands& strands)
        : m_sources(sources), m_grown(grown), m_strands(strands) {}

    void make(const GroupTables& group, std::span<const std::uint32_t> which) {
        const std::size_t rows = static_cast<std::size_t>(group.segments) + 3;
        for (std::vector<float>* row : {&m_x, &m_y, &m_z}) row->resize(lanes * group.stride);
        for (std::vector<float>* row : {&m_frameX, &m_frameY, &m_frameZ, &m_normalX, &m_normalY, &m_normalZ})
            row->resize(lanes * rows);
        shape(group, which);
        std::size_t most = 0;
        for (std::size_t i = 0; i < which.size(); ++i) most = std::max(most, finishPoints(group, which[i], i));
        for (std::size_t l = which.size(); l < lanes; ++l) repeatLane(which.size() - 1, l, most + 1);
        frame(most);
        for (std::size_t i = 0; i < which.size(); ++i) finishVertices(group, which[i], i);
    }

private:
    void shape(const GroupTables& group, std::span<const std::uint32_t> which) {
        const HairSources& s = m_sources;
        for (std::size_t i = 0; i < which.size(); ++i) {
            m_hairs[i] = m_grown[which[i]];
            const HairRoot& root = s.roots[m_hairs[i]];
            const glm::vec3 start = root.position + root.normal * s.traits[m_hairs[i]].displacement;
            for (int axis = 0; axis < 3; ++axis) m_roots[i * 3 + static_cast<std::size_t>(axis)] = start[axis];
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
                                 m_hairs,
                                 m_roots,
                                 group.stride,
                                 group.along.data(),
                                 group.ease.data(),
                                 {s.kinkOffset.x, s.kinkOffset.y, s.kinkOffset.z},
                                 m_x.data(),
                                 m_y.data(),
                                 m_z.data()};
        WHORL_PICK(shapeHairs)(arrays, 0, which.size());
    }

    // Keeps the hair outside, cuts it and puts it into lane `lane`, with one more row that goes straight on. Returns
    // its vertex count.
    std::size_t finishPoints(const GroupTables& group, std::uint32_t strand, std::size_t lane) {
        const std::size_t full = static_cast<std::size_t>(group.segments) + 1;
        const std::size_t row = lane * group.stride;
        m_points.resize(full);
        for (std::size_t v = 0; v < full; ++v) m_points[v] = {m_x[row + v], m_y[row + v], m_z[row + v]};
        if (group.keepOutside && m_sources.skin) m_sources.skin->keepOutside(m_points, group.ease);
        const std::size_t first = m_strands.firstVertex[strand];
        const std::size_t vertices = m_strands.firstVertex[strand + 1] - first;
        const CutEnd end = cutEnd(m_sources.traits[m_grown[strand]].cut, group.segments);
        if (end.parameter < static_cast<float>(group.segments))
            m_points[vertices - 1] = strandPoint(m_points, end.parameter);
        std::copy_n(m_points.begin(), vertices, m_strands.positions.begin() + static_cast<std::ptrdiff_t>(first));
        for (std::size_t v = 0; v < vertices; ++v) setRow(v, lane, m_points[v]);
        const glm::vec3 on = m_points[vertices - 1] * 2.0f - m_points[vertices - 2];
        for (std::size_t v = vertices; v < full + 2; ++v) setRow(v, lane, on);
        return vertices;
    }

    void setRow(std::size_t v, std::size_t lane, const glm::vec3& p) {
        m_frameX[v * lanes + lane] = p.x;
        m_frameY[v * lanes + lane] = p.y;
        m_frameZ[v * lanes + lane] = p.z;
    }

    void repeatLane(std::size_t from, std::size_t to, std::size_t rows) {
        for (std::size_t v = 0; v < rows; ++v)
            setRow(v, to, {m_frameX[v * lanes + from], m_frameY[v * lanes + from], m_frameZ[v * lanes + from]});
        m_surfaceX[to] = m_surfaceX[from];
        m_surfaceY[to] = m_surfaceY[from];
        m_surfaceZ[to] = m_surfaceZ[from];
    }

    void frame(std::size_t vertices) {
        const FrameArrays arrays{m_frameX.data(),  m_frameY.data(), m_frameZ.data(), m_surfaceX,
                                 m_surfaceY,       m_surfaceZ,      vertices,        m_normalX.data(),
                                 m_normalY.data(), m_normalZ.data()};
        WHORL_PICK(frameHairs)(arrays);
    }

    void finishVertices(const GroupTables& group, std::uint32_t strand, std::size_t lane) {
        const std::size_t first = m_strands.firstVertex[strand];
        const std::size_t vertices = m_strands.firstVertex[strand + 1] - first;
        for (std::size_t v = 0; v < vertices; ++v) {
            const std::size_t from = v * lanes + lane;
            m_strands.normals[first + v] = {m_normalX[from], m_normalY[from], m_normalZ[from]};
        }
        setLook(m_sources.traits[m_grown[strand]], group, strand, m_strands);
    }

    const HairSources& m_sources;
    std::span<const std::uint32_t> m_grown;
    Strands& m_strands;
    std::uint32_t m_hairs[lanes] = {};
    float m_roots[lanes * 3] = {};
    float m_surfaceX[lanes] = {}, m_surfaceY[lanes] = {}, m_surfaceZ[lanes] = {};
    std::vector<float> m_x, m_y, m_z;
    std::vector<float> m_frameX, m_frameY, m_frameZ, m_normalX, m_normalY, m_normalZ;
    std::vector<glm::vec3> m_points;
};

}  // namespace

std::vector<HairTraits> makeTraits(const TraitLookup& lookup, std::span<const HairRoot> roots, Progress& progress) {
    std::vector<HairTraits> traits(roots.size());
    parallelFor(roots.size(), 1024, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        for (std::size_t i = begin; i < end; ++i) traits[i] = lookup.at(roots[i]);
    });
    return traits;
}

std::vector<std::uint32_t> layOut(const HairSources& sources, Strands& strands) {
    strands.clear();
    std::vector<std::uint32_t> grown;
    std::uint32_t vertices = 0;
    for (std::uint32_t i = 0; i < sources.roots.size(); ++i) {
        const HairRoot& root = sources.roots[i];
        const HairTraits& traits = sources.traits[i];
        const CutEnd end = cutEnd(traits.cut, (*sources.groom.groups)[root.group].params.general.segments);
        if (end.vertices == 0 || sources.bindings.counts[i] == 0 || !(traits.scale > 0.0f)) continue;
        grown.push_back(i);
        vertices += end.vertices;
        strands.firstVertex.push_back(vertices);
        strands.ids.push_back(root.id);
        strands.roots.push_back(root.point);
        strands.rootUvs.push_back(root.uv);
        strands.groups.push_back(root.group);
    }
    strands.positions.resize(vertices);
    strands.normals.resize(vertices);
    strands.widths.resize(vertices);
    strands.colours.resize(vertices);
    return grown;
}

void evaluateHairs(const HairSources& sources, std::span<const std::uint32_t> grown,
                   std::span<const std::uint32_t> which, Strands& strands, Progress& progress) {
    const std::vector<GroupTables> tables = makeTables(sources.groom);
    parallelFor(which.size(), blockHairs, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        Evaluator evaluator(sources, grown, strands);
        std::vector<std::vector<std::uint32_t>> waiting(tables.size());
        for (std::size_t i = begin; i < end; ++i) {
            std::vector<std::uint32_t>& same = waiting[strands.groups[which[i]]];
            same.push_back(which[i]);
            if (same.size() < lanes) continue;
            evaluator.make(tables[strands.groups[which[i]]], same);
            same.clear();
        }
        for (std::size_t g = 0; g < tables.size(); ++g)
            if (!waiting[g].empty()) evaluator.make(tables[g], waiting[g]);
    });
}

void renewLook(const HairSources& sources, std::span<const std::uint32_t> grown, Strands& strands) {
    const std::vector<GroupTables> tables = makeTables(sources.groom);
    parallelFor(grown.size(), blockHairs, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            setLook(sources.traits[grown[i]], tables[strands.groups[i]], static_cast<std::uint32_t>(i), strands);
    });
}

}  // namespace whorl
