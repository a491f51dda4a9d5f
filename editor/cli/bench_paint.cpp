// SPDX-License-Identifier: Apache-2.0
// One dab of paint on a head-sized mesh, against asking every texel of the map.
#include "core/brushes/paint_canvas.h"
#include "editor/cli/bench.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace whorl {

std::vector<BenchRow> benchPaint();

namespace {

constexpr int rings = 92;
constexpr int sectors = 2 * rings;
constexpr float radius = 0.1f;

glm::vec3 onBall(double u, double v) {
    const double polar = glm::pi<double>() * (1.0 - v), azimuth = glm::two_pi<double>() * u;
    return glm::vec3(
               glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar), -std::sin(polar) * std::sin(azimuth))) *
           radius;
}

/// A ball unrolled over the whole UV square.
SurfaceMesh unrolledBall() {
    SurfaceMesh mesh;
    for (int r = 0; r <= rings; ++r) {
        for (int s = 0; s <= sectors; ++s) {
            mesh.positions.push_back(onBall(static_cast<double>(s) / sectors, static_cast<double>(r) / rings));
            mesh.normals.push_back(mesh.positions.back() / radius);
        }
    }
    const auto at = [](int r, int s) { return static_cast<std::uint32_t>(r * (sectors + 1) + s); };
    const auto add = [&](glm::uvec3 corners) {
        mesh.triangles.push_back(corners);
        for (int k = 0; k < 3; ++k) {
            mesh.cornerUvs.emplace_back(static_cast<float>(corners[k] % (sectors + 1)) / sectors,
                                        static_cast<float>(corners[k] / (sectors + 1)) / rings);
        }
    };
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            add({at(r, s), at(r, s + 1), at(r + 1, s + 1)});
            add({at(r, s), at(r + 1, s + 1), at(r + 1, s)});
        }
    }
    mesh.parts.push_back({.name = "ball", .firstTriangle = 0, .triangleCount = mesh.triangleCount()});
    return mesh;
}

}  // namespace

std::vector<BenchRow> benchPaint() {
    constexpr int size = 2048;
    const Surface surface((Cow<SurfaceMesh>(unrolledBall())));
    MapSet maps;
    maps.set("paint", Map(size, size, 1, TexelFormat::U16, 0.0f));
    const MapSet before = maps;
    const PaintDab dab{
        .centre = onBall(0.3, 0.55), .radius = 0.015f, .strength = 1.0f, .eye = onBall(0.3, 0.55) * 10.0f};

    const auto start = std::chrono::steady_clock::now();
    PaintCanvas canvas(surface, *maps.find("paint"));
    canvas.paint(maps, "paint", dab, 1.0f);
    const double first = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    const auto startOfSecond = std::chrono::steady_clock::now();
    PaintCanvas second(surface, *maps.find("paint"));
    MapSet repainted = maps;
    second.paint(repainted, "paint", dab, 0.5f);
    const double later = std::chrono::duration<double>(std::chrono::steady_clock::now() - startOfSecond).count();

    BenchRow row;
    row.name = "paint/dab of 15 mm, 34k triangles, 2048^2 map";
    row.baseline = "weight of every texel of the map";
    // Each dab a little further and stronger, so that texels change every time.
    int at = 0;
    PaintDab moving = dab;
    const auto ours = [&] {
        ++at;
        moving.centre = onBall(0.3 + 0.002 * (at % 10), 0.55);
        moving.strength = std::min(0.5f + 0.01f * static_cast<float>(at), 1.0f);
        canvas.paint(maps, "paint", moving, 1.0f);
    };
    std::vector<glm::vec3> positions;
    positions.reserve(std::size_t{size} * size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) positions.push_back(onBall((x + 0.5) / size, 1.0 - (y + 0.5) / size));
    }
    std::vector<float> weights(positions.size());
    const auto bruteForce = [&] {
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const glm::vec3 away = positions[i] - dab.centre;
            const float t = std::max(0.0f, 1.0f - glm::dot(away, away) / (dab.radius * dab.radius));
            weights[i] = t * t;
        }
    };
    // Against a map with one dab, the weights are what must be there (the mesh is flat between its vertices).
    PaintCanvas fresh(surface, *before.find("paint"));
    MapSet once = before;
    fresh.paint(once, "paint", dab, 1.0f);
    bruteForce();
    std::size_t painted = 0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float expected = weights[static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x)];
            const float value = once.find("paint")->texel(x, y);
            if (std::abs(value - expected) > 0.02f) row.correct = false;
            if (value > 0.0f) ++painted;
        }
    }
    const Medians medians = interleaved(ours, bruteForce, 15);
    row.seconds = medians.ours;
    row.baselineSeconds = medians.baseline;
    row.items = static_cast<double>(painted);
    row.unit = "texels";
    row.note = std::to_string(painted) + " texels a dab; first dab with its preparation " +
               std::to_string(static_cast<int>(first * 1e6)) + " us, of a later stroke " +
               std::to_string(static_cast<int>(later * 1e6)) + " us; undo keeps " +
               std::to_string(maps.bytesNotSharedWith(before) / 1024) + " KiB";
    return {row};
}

}  // namespace whorl
