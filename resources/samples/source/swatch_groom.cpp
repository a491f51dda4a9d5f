// SPDX-License-Identifier: Apache-2.0
// A cushion with a lock of plain hair: small, so that every parameter is seen at once and answers at once.
#include "core/commands/command.h"
#include "resources/samples/source/grooms.h"
#include "resources/samples/source/style.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace whorl::samples {
namespace {

constexpr int cells = 40;
constexpr glm::vec3 halfSize{0.065f, 0.065f, 0.022f};

float across(int i) {
    return -1.0f + 2.0f * static_cast<float>(i) / static_cast<float>(cells);
}

/// Thickness of the cushion, 0 at the rim to 1: x, y from -1 to 1.
float thickness(float x, float y) {
    return std::sqrt(std::max((1.0f - x * x * x * x) * (1.0f - y * y * y * y), 0.0f));
}

/// Front (+z) and back, both a square of the texture; they share the vertices of the rim.
SurfaceMesh cushion() {
    SurfaceMesh mesh;
    constexpr int row = cells + 1;
    std::vector<std::uint32_t> vertex[2];
    for (int side = 0; side < 2; ++side) {
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i) {
                const bool rim = i == 0 || j == 0 || i == cells || j == cells;
                if (side == 1 && rim) {
                    vertex[1].push_back(vertex[0][static_cast<std::size_t>(j * row + i)]);
                    continue;
                }
                // Denser towards the rim, where it is steep; corners are rounded.
                const glm::vec2 square(std::sin(1.5707963f * across(i)), std::sin(1.5707963f * across(j)));
                const glm::vec2 round =
                    square * glm::sqrt(1.0f - 0.25f * glm::vec2(square.y * square.y, square.x * square.x));
                const float z = rim ? 0.0f : thickness(square.x, square.y) * (side == 0 ? 1.0f : -0.5f);
                vertex[static_cast<std::size_t>(side)].push_back(static_cast<std::uint32_t>(mesh.positions.size()));
                mesh.positions.push_back(glm::vec3(round, z) * halfSize);
            }
        }
    }
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f));
    for (int side = 0; side < 2; ++side) {
        const std::uint32_t first = mesh.triangleCount();
        const auto at = [&](int i, int j) { return vertex[side][static_cast<std::size_t>(j * row + i)]; };
        const auto uv = [&](int i, int j) {
            const glm::vec2 place(across(i) * 0.5f + 0.5f, across(j) * 0.5f + 0.5f);
            return side == 0 ? 0.01f + 0.68f * place : glm::vec2(0.71f, 0.01f) + 0.28f * place;
        };
        const auto triangle = [&](glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
            if (side == 1) std::swap(b, c);
            const glm::uvec3 corners(at(a.x, a.y), at(b.x, b.y), at(c.x, c.y));
            const glm::vec3 normal = glm::cross(mesh.positions[corners.y] - mesh.positions[corners.x],
                                                mesh.positions[corners.z] - mesh.positions[corners.x]);
            mesh.triangles.push_back(corners);
            for (int k = 0; k < 3; ++k) mesh.normals[corners[k]] += normal;
            for (const glm::ivec2& p : {a, b, c}) mesh.cornerUvs.push_back(uv(p.x, p.y));
        };
        for (int j = 0; j < cells; ++j) {
            for (int i = 0; i < cells; ++i) {
                // No triangle has all its corners on the rim, where front and back would meet in it.
                const bool rising = (2 * i < cells) == (2 * j < cells);
                if (rising) {
                    triangle({i, j}, {i + 1, j}, {i + 1, j + 1});
                    triangle({i, j}, {i + 1, j + 1}, {i, j + 1});
                } else {
                    triangle({i, j}, {i + 1, j}, {i, j + 1});
                    triangle({i + 1, j}, {i + 1, j + 1}, {i, j + 1});
                }
            }
        }
        mesh.parts.push_back({side == 0 ? "front" : "back", first, mesh.triangleCount() - first, clayColour});
    }
    for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
    return mesh;
}

/// A map over the texture from a function of the place on the front, both from 0 to 1; 0 on the back.
template <class Value>
Map frontMap(Value&& value) {
    constexpr int size = 512;
    Map map(size, size, 1, TexelFormat::U8, 0.0f);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec2 texture((static_cast<float>(x) + 0.5f) / size,
                                    1.0f - (static_cast<float>(y) + 0.5f) / size);
            const glm::vec2 place = (texture - 0.01f) / 0.68f;
            if (place.x <= 1.005f && place.y <= 1.005f) map.setTexel(x, y, 0, value(place));
        }
    }
    return map;
}

}  // namespace

Result<Groom> swatchGroom(Progress& progress) {
    Groom groom = makeGroom(cushion());
    groom.partSettings.edit()[1].growsHair = false;
    groom.maps.set("scalp", frontMap([](glm::vec2 p) {
                       return ramp(p.y, 0.50f, 0.56f) * ramp(p.y, 0.93f, 0.87f) * ramp(p.x, 0.08f, 0.14f) *
                              ramp(p.x, 0.92f, 0.86f);
                   }));
    groom.maps.set("patch", frontMap([](glm::vec2 p) {
                       return std::abs(p.x - 0.5f) < 0.4f && std::abs(p.y - 0.7f) < 0.2f ? 1.0f : 0.0f;
                   }));
    groom.maps.set("ramp", frontMap([](glm::vec2 p) { return p.x; }));
    groom.maps.set("spots", frontMap([](glm::vec2 p) {
                       const float waves = std::sin(p.x * 18.85f) * std::sin(p.y * 18.85f);
                       return ramp(waves, -0.15f, 0.15f);
                   }));
    groom.maps.set("halves", frontMap([](glm::vec2 p) { return p.x < 0.5f ? 0.0f : 1.0f / 255.0f; }));

    HairParams hair;
    hair.general.density = {1.0f, "scalp"};
    hair.general.samples = 4;
    hair.general.rootThickness.value = 0.00016f;
    hair.general.tipThickness.value = 0.00007f;
    hair.colour.root.value = {0.12f, 0.062f, 0.026f};
    hair.colour.tip.value = {0.50f, 0.29f, 0.12f};
    groom.groups = Cow<std::vector<Group>>({{"hair", hair}});
    CountParams& counts = groom.counts.edit();
    counts.guides = 160;
    counts.hairs = 3000;
    counts.shownHairs = 3000;

    const Surface surface(groom.mesh);
    if (auto placed = placeGuides(groom, surface, 160, 0.05f, false, progress); !placed) return placed.error();
    growGuides(
        groom, surface, 0,
        {.length = [](const glm::vec3&) { return 0.06f; },
         .flow = [](const glm::vec3& p,
                    const glm::vec3& root) { return glm::vec3(0.35f * std::sin((root.y - p.y) * 70.0f), -1.0f, 0.0f); },
         .lift = [](const glm::vec3&) { return 0.9f; },
         .layer = [](const glm::vec3& root) { return 0.004f + 0.06f * (0.065f - root.y); },
         .turn = 0.3f,
         .gravity = 0.06f,
         .hug = 0.3f,
         .stray = 0.03f});
    return groom;
}

}  // namespace whorl::samples
