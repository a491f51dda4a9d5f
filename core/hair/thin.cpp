// SPDX-License-Identifier: Apache-2.0
#include "core/hair/thin.h"

#include "core/base/parallel.h"
#include "core/hair/curve.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace whorl {
namespace {

// True when all points between are nearer to the line than `threshold` times its length.
bool straight(std::span<const glm::vec3> points, std::size_t from, std::size_t to, float threshold) {
    const glm::vec3 line = points[to] - points[from];
    const float squared = glm::dot(line, line);
    if (!(squared > 0.0f)) return false;
    for (std::size_t v = from + 1; v < to; ++v) {
        const glm::vec3 toPoint = points[v] - points[from];
        const float along = std::clamp(glm::dot(toPoint, line) / squared, 0.0f, 1.0f);
        const glm::vec3 away = toPoint - line * along;
        if (!(glm::dot(away, away) < threshold * threshold * squared)) return false;
    }
    return true;
}

float thresholdOf(const Groom& groom, std::uint8_t group) {
    return group < groom.groups->size() ? (*groom.groups)[group].params.general.skipThreshold : 0.0f;
}

/// One list a hair; empty where all stay.
using KeptVertices = std::vector<std::vector<std::uint32_t>>;

template <class Values>
void appendKept(Values& to, const Values& from, std::size_t first, const std::vector<std::uint32_t>& kept) {
    for (const std::uint32_t v : kept) to.push_back(from[first + v]);
}

Strands withVertices(const Strands& strands, const KeptVertices& keptOf) {
    Strands thin;
    thin.ids = strands.ids;
    thin.members = strands.members;
    thin.roots = strands.roots;
    thin.rootUvs = strands.rootUvs;
    thin.groups = strands.groups;
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < strands.count(); ++i) {
        const std::size_t first = strands.firstVertex[i], count = strands.firstVertex[i + 1] - first;
        if (keptOf[i].empty()) {
            all.resize(count);
            std::iota(all.begin(), all.end(), 0u);
        }
        const std::vector<std::uint32_t>& kept = keptOf[i].empty() ? all : keptOf[i];
        appendKept(thin.positions, strands.positions, first, kept);
        appendKept(thin.normals, strands.normals, first, kept);
        appendKept(thin.widths, strands.widths, first, kept);
        appendKept(thin.colours, strands.colours, first, kept);
        const std::size_t from = thin.firstVertex.back(), vertices = kept.size();
        thin.firstVertex.push_back(static_cast<std::uint32_t>(from + vertices));
        if (vertices == count) continue;
        const std::span<const glm::vec3> points{&thin.positions[from], vertices};
        for (std::size_t v = 0; v < vertices; ++v) {
            glm::vec3& normal = thin.normals[from + v];
            const glm::vec3 tangent = strandTangent(points, v, glm::vec3(0.0f));
            const glm::vec3 turned = normal - tangent * glm::dot(normal, tangent);
            if (glm::dot(turned, turned) > 1e-6f) normal = glm::normalize(turned);
        }
    }
    return thin;
}

}  // namespace

bool skipsVertices(const Groom& groom) {
    return std::any_of(groom.groups->begin(), groom.groups->end(),
                       [](const Group& group) { return group.params.general.skipThreshold > 0.0f; });
}

bool wantsNormals(const Groom& groom) {
    return std::any_of(groom.groups->begin(), groom.groups->end(),
                       [](const Group& group) { return group.params.general.writeNormals; });
}

std::vector<std::uint32_t> keptVertices(std::span<const glm::vec3> points, float threshold) {
    std::vector<std::uint32_t> kept{0};
    const std::size_t last = points.size() - 1;
    while (kept.back() < last) {
        std::size_t to = kept.back() + 1;
        while (to < last && straight(points, kept.back(), to + 1, threshold)) ++to;
        kept.push_back(static_cast<std::uint32_t>(to));
    }
    return kept;
}

std::vector<Strands> thinnedTogether(std::span<const Strands* const> samples, const Groom& groom) {
    const Strands& first = *samples[0];
    KeptVertices kept(first.count());
    parallelFor(first.count(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t from = first.firstVertex[i], count = first.firstVertex[i + 1] - from;
            const float threshold = thresholdOf(groom, first.groups[i]);
            if (!(threshold > 0.0f)) continue;
            for (const Strands* sample : samples) {
                const auto own = keptVertices({&sample->positions[from], count}, threshold);
                if (kept[i].empty()) {
                    kept[i] = own;
                    continue;
                }
                std::vector<std::uint32_t> both;
                std::ranges::set_union(kept[i], own, std::back_inserter(both));
                kept[i] = std::move(both);
            }
        }
    });
    std::vector<Strands> thin;
    for (const Strands* sample : samples) thin.push_back(withVertices(*sample, kept));
    return thin;
}

Strands thinned(const Strands& strands, const Groom& groom) {
    const Strands* one = &strands;
    return std::move(thinnedTogether({&one, 1}, groom)[0]);
}

}  // namespace whorl
