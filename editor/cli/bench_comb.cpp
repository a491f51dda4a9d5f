// SPDX-License-Identifier: Apache-2.0
// One step of the comb on many guides, against a pass over every point.
#include "core/brushes/brush_index.h"
#include "core/brushes/constraints.h"
#include "core/brushes/orbit_view.h"
#include "editor/cli/bench.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace whorl {

std::vector<BenchRow> benchComb();

namespace {

SurfaceMesh ball(int rings, float radius) {
    SurfaceMesh mesh;
    const int sectors = 2 * rings;
    for (int r = 0; r <= rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            const double polar = glm::pi<double>() * r / rings, azimuth = glm::two_pi<double>() * s / sectors;
            const glm::vec3 normal(
                glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar), -std::sin(polar) * std::sin(azimuth)));
            mesh.positions.push_back(normal * radius);
            mesh.normals.push_back(normal);
        }
    }
    const auto add = [&](glm::uvec3 corners) {
        mesh.triangles.push_back(corners);
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 n = mesh.normals[corners[k]];
            mesh.cornerUvs.emplace_back(0.5f + 0.4f * n.x, 0.5f + 0.4f * n.y);
        }
    };
    const auto at = [&](int r, int s) { return static_cast<std::uint32_t>(r * sectors + s % sectors); };
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            if (r + 1 < rings) add({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
            if (r > 0) add({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
        }
    }
    mesh.parts.push_back({.name = "ball", .firstTriangle = 0, .triangleCount = mesh.triangleCount()});
    return mesh;
}

/// Guides in the order of the triangles, so that blocks are compact, as placed guides are.
Groom hairyBall(std::size_t guides, int points, float length) {
    Groom groom = makeGroom(ball(64, 0.1f));
    groom.groups.edit()[0].params.general.segments = points - 1;
    const std::uint64_t triangles = groom.mesh->triangleCount();
    std::vector<glm::vec3> curve(static_cast<std::size_t>(points));
    for (std::size_t i = 0; i < guides; ++i) {
        const float u = 0.05f + 0.9f * static_cast<float>(i % 31) / 31.0f;
        const float v = (1.0f - u) * (0.05f + 0.9f * static_cast<float>(i % 17) / 17.0f);
        const SurfacePoint root{static_cast<std::uint32_t>(i * triangles / guides), u, v};
        const glm::vec3 from = positionAt(*groom.mesh, root), normal = normalAt(*groom.mesh, root);
        for (int k = 0; k < points; ++k) {
            curve[static_cast<std::size_t>(k)] =
                from + normal * (length * static_cast<float>(k) / static_cast<float>(points - 1));
        }
        groom.guides.append(root, 0, curve);
    }
    return groom;
}

/// The guides under the brush by asking every point of every guide.
std::size_t bruteForce(const GuideSet& guides, const BrushArea& area, std::vector<float>& weights) {
    std::size_t touched = 0;
    weights.clear();
    for (std::size_t b = 0; b < guides.blockCount(); ++b) {
        const GuideBlock& block = guides.block(b);
        for (std::size_t i = 0; i < block.count(); ++i) {
            const std::size_t first = weights.size();
            bool any = false;
            for (std::uint32_t p = block.firstPoint[i]; p < block.firstPoint[i + 1]; ++p) {
                weights.push_back(area.weight(block.points[p]));
                any = any || weights.back() > 0.0f;
            }
            if (any) {
                ++touched;
            } else {
                weights.resize(first);
            }
        }
    }
    return touched;
}

float largestLengthError(const GuideSet& before, const GuideSet& after) {
    float largest = 0.0f;
    for (std::size_t i = 0; i < before.count(); ++i) {
        const auto a = before.points(i), b = after.points(i);
        for (std::size_t k = 1; k < a.size(); ++k) {
            largest = std::max(largest, std::abs(glm::length(a[k] - a[k - 1]) - glm::length(b[k] - b[k - 1])));
        }
    }
    return largest;
}

BenchRow combRow(std::size_t guides, int points, float radiusPixels, float length) {
    const Groom groom = hairyBall(guides, points, length);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    surface->skin();
    const glm::vec2 viewport(1280.0f, 720.0f);
    const StrokeView view = orbitView(surface->bounds, 0.0f, 0.0f, viewport);
    BrushSettings settings;
    settings.radiusPixels = radiusPixels;
    settings.strength = 1.0f;
    settings.frontOnly = false;
    const BrushInfo& comb = *findBrush("comb");
    const BrushArea area{ScreenFrame(view), Reach::Projected, viewport * 0.5f, radiusPixels, {}, 0.0f};

    BenchRow row;
    row.name = "comb/" + std::to_string(guides) + " guides x " + std::to_string(points) + ", " +
               std::to_string(static_cast<int>(radiusPixels)) + " px";
    row.baseline = "weights of every point, without moving any";
    BrushIndex index;
    BrushIndex::Selection selection;
    index.select(groom, *surface, area, view, false, false, selection);
    std::vector<float> weights;
    row.correct = bruteForce(groom.guides, area, weights) == selection.guides.size() && weights == selection.weights;

    auto stroke = Stroke::begin(comb, groom, surface, view, settings);
    if (!stroke) return row;
    // The first step makes the index; the following ones go to and fro at the middle, each exactly one spacing long.
    const float spacing = std::max(1.0f, comb.spacing * radiusPixels);
    int at = 0;
    const auto move = [&] {
        const int place = at % 16 < 8 ? at % 16 : 16 - at % 16;
        ++at;
        stroke->moveTo({viewport * 0.5f + glm::vec2(spacing * static_cast<float>(place), 0.0f), 1.0f});
    };
    move();
    const Medians medians = interleaved(
        move, [&] { bruteForce(groom.guides, area, weights); }, 31);
    const Groom after = stroke->finish();
    const float error = largestLengthError(groom.guides, after.guides);
    row.correct = row.correct && error < 1e-5f;
    row.seconds = medians.ours;
    row.baselineSeconds = medians.baseline;
    row.items = static_cast<double>(selection.guides.size());
    row.unit = "touched guides";
    row.note = std::to_string(selection.guides.size()) + " guides touched; undo keeps " +
               std::to_string(after.bytesNotSharedWith(groom) / 1024) + " KiB";
    return row;
}

}  // namespace

std::vector<BenchRow> benchComb() {
    return {combRow(2000, 16, 50.0f, 0.05f), combRow(2000, 16, 400.0f, 0.05f), combRow(100000, 16, 10.0f, 0.01f),
            combRow(100000, 16, 50.0f, 0.01f), combRow(100000, 64, 10.0f, 0.01f)};
}

}  // namespace whorl
