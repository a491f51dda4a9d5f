// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/assemble.h"

#include "resources/samples/source/pack.h"

#include <cmath>

namespace whorl::samples {

using glm::dvec2;
using glm::vec3;

namespace {

/// Turns a chart so that its longest direction lies along u or v; a joined chart keeps its axis upright.
void straighten(Chart& chart) {
    if (chart.joined) {
        return;
    }
    dvec2 mean(0.0);
    for (const dvec2& p : chart.uvs) {
        mean += p / double(chart.uvs.size());
    }
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const dvec2& p : chart.uvs) {
        const dvec2 d = p - mean;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    const double c = std::cos(angle), s = std::sin(angle);
    for (dvec2& p : chart.uvs) {
        p = dvec2(s * p.x - c * p.y, c * p.x + s * p.y);
    }
}

/// Angle-weighted vertex normals, for where the field's own gradient does not describe the mesh.
std::vector<vec3> meshNormals(const HalfMesh& mesh) {
    std::vector<vec3> normals(mesh.positions.size(), vec3(0.0f));
    for (const auto& t : mesh.triangles) {
        for (int c = 0; c < 3; ++c) {
            const vec3 u = mesh.positions[t[(c + 1) % 3]] - mesh.positions[t[c]];
            const vec3 v = mesh.positions[t[(c + 2) % 3]] - mesh.positions[t[c]];
            const vec3 n = glm::cross(u, v);
            const float len = glm::length(n);
            if (len > 0.0f) {
                normals[t[c]] += n / len * std::atan2(len, glm::dot(u, v));
            }
        }
    }
    for (size_t v = 0; v < normals.size(); ++v) {
        if (mesh.positions[v].x == 0.0f) {
            normals[v].x = 0.0f;
        }
        normals[v] = glm::normalize(normals[v]);
    }
    return normals;
}

}  // namespace

Sculpture assemble(const HalfMesh& mesh, const Recipe& recipe) {
    std::vector<Chart> charts = cutCharts(mesh, recipe.seams);
    for (Chart& chart : charts) {
        flatten(mesh, chart);
        straighten(chart);
    }
    const std::vector<vec3> smooth = meshNormals(mesh);
    Sculpture out;
    for (const PartStyle& style : recipe.parts) {
        out.parts.push_back({style.name, {}, style.growsHair, style.colour});
    }
    std::vector<Island> islands;
    for (const Chart& chart : charts) {
        const uint8_t region = mesh.labels[chart.meshTriangle[0]];
        const double scale = recipe.texelShare(region);
        auto& triangles = out.parts[size_t(recipe.partOf(region))].triangles;
        std::vector<uint32_t> own(chart.uvs.size()), mirrored(chart.uvs.size());
        Island island, twin;
        auto addVertex = [&](uint32_t v, float side, Island& target) {
            const uint32_t source = chart.meshVertex[v];
            const vec3 flip(side, 1.0f, 1.0f);
            const vec3 p = mesh.positions[source];
            vec3 n = recipe.normal(region, p);
            if (!(glm::dot(n, smooth[source]) > 0.8f)) {
                n = smooth[source];
            }
            out.positions.push_back(p.x == 0.0f ? p : p * flip);
            out.normals.push_back(p.x == 0.0f ? n : n * flip);
            target.points.push_back(chart.uvs[v] * dvec2(side, 1.0) * scale);
            return uint32_t(out.positions.size() - 1);
        };
        const auto base = uint32_t(out.positions.size());
        for (uint32_t v = 0; v < chart.uvs.size(); ++v) {
            own[v] = addVertex(v, 1.0f, island);
        }
        Island& other = chart.joined ? island : twin;
        const auto mirrorBase = chart.joined ? base : uint32_t(out.positions.size());
        for (uint32_t v = 0; v < chart.uvs.size(); ++v) {
            mirrored[v] = chart.onAxis[v] ? own[v] : addVertex(v, -1.0f, other);
        }
        for (const auto& t : chart.triangles) {
            triangles.push_back({own[t[0]], own[t[1]], own[t[2]]});
            island.triangles.push_back({own[t[0]] - base, own[t[1]] - base, own[t[2]] - base});
        }
        for (const auto& t : chart.triangles) {
            triangles.push_back({mirrored[t[0]], mirrored[t[2]], mirrored[t[1]]});
            other.triangles.push_back(
                {mirrored[t[0]] - mirrorBase, mirrored[t[2]] - mirrorBase, mirrored[t[1]] - mirrorBase});
        }
        islands.push_back(std::move(island));
        if (!chart.joined) {
            islands.push_back(std::move(twin));
        }
    }
    packIslands(islands);
    for (const Island& island : islands) {
        for (const dvec2& p : island.points) {
            out.uvs.emplace_back(p);
        }
    }
    return out;
}

}  // namespace whorl::samples
