// SPDX-License-Identifier: Apache-2.0
#include "tests/support/shapes.h"

#include "core/base/random.h"
#include "core/surface/surface_point.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <system_error>
#include <vector>

namespace whorl::testing {

SurfaceMesh plane(int cells, float size) {
    SurfaceMesh mesh;
    const auto n = static_cast<std::uint32_t>(cells);
    for (std::uint32_t row = 0; row <= n; ++row) {
        for (std::uint32_t column = 0; column <= n; ++column) {
            const float x = static_cast<float>(column) / static_cast<float>(n) - 0.5f;
            const float z = static_cast<float>(row) / static_cast<float>(n) - 0.5f;
            mesh.positions.push_back(glm::vec3(x, 0.0f, z) * size);
            mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        }
    }
    const auto uv = [&](std::uint32_t vertex) {
        const glm::vec3& p = mesh.positions[vertex];
        return glm::vec2(p.x, p.z) / size + 0.5f;
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.triangles.emplace_back(a, b, c);
        for (const std::uint32_t vertex : {a, b, c}) mesh.cornerUvs.push_back(uv(vertex));
    };
    for (std::uint32_t row = 0; row < n; ++row) {
        for (std::uint32_t column = 0; column < n; ++column) {
            const std::uint32_t corner = row * (n + 1) + column;
            add(corner, corner + n + 1, corner + 1);
            add(corner + 1, corner + n + 1, corner + n + 2);
        }
    }
    mesh.parts.push_back({.name = "plane", .firstTriangle = 0, .triangleCount = mesh.triangleCount()});
    return mesh;
}

SurfaceMesh sphere(int rings, int sectors, float radius) {
    SurfaceMesh mesh;
    const auto ringCount = static_cast<std::uint32_t>(rings);
    const auto sectorCount = static_cast<std::uint32_t>(sectors);
    const auto addVertex = [&](double polar, double azimuth) {
        const glm::vec3 normal(static_cast<float>(std::sin(polar) * std::cos(azimuth)),
                               static_cast<float>(std::cos(polar)),
                               static_cast<float>(-std::sin(polar) * std::sin(azimuth)));
        mesh.positions.push_back(normal * radius);
        mesh.normals.push_back(normal);
    };
    addVertex(0.0, 0.0);
    for (std::uint32_t ring = 1; ring < ringCount; ++ring) {
        for (std::uint32_t sector = 0; sector < sectorCount; ++sector) {
            addVertex(glm::pi<double>() * ring / ringCount, glm::two_pi<double>() * sector / sectorCount);
        }
    }
    addVertex(glm::pi<double>(), 0.0);
    const auto south = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    mesh.normals[0] = {0.0f, 1.0f, 0.0f};
    mesh.normals[south] = {0.0f, -1.0f, 0.0f};
    mesh.positions[0] = mesh.normals[0] * radius;
    mesh.positions[south] = mesh.normals[south] * radius;

    const auto vertex = [&](std::uint32_t ring, std::uint32_t sector) {
        if (ring == 0) return 0u;
        if (ring == ringCount) return south;
        return 1 + (ring - 1) * sectorCount + sector % sectorCount;
    };
    const auto uv = [&](std::uint32_t ring, float sector) {
        return glm::vec2(sector / static_cast<float>(sectorCount),
                         1.0f - static_cast<float>(ring) / static_cast<float>(ringCount));
    };
    for (std::uint32_t ring = 0; ring < ringCount; ++ring) {
        for (std::uint32_t sector = 0; sector < sectorCount; ++sector) {
            const auto left = static_cast<float>(sector);
            if (ring > 0) {
                mesh.triangles.emplace_back(vertex(ring, sector), vertex(ring + 1, sector), vertex(ring, sector + 1));
                const float below = ring + 1 == ringCount ? left + 0.5f : left;
                for (const glm::vec2& corner : {uv(ring, left), uv(ring + 1, below), uv(ring, left + 1.0f)})
                    mesh.cornerUvs.push_back(corner);
            }
            if (ring + 1 < ringCount) {
                mesh.triangles.emplace_back(vertex(ring, sector + 1), vertex(ring + 1, sector),
                                            vertex(ring + 1, sector + 1));
                const float above = ring == 0 ? left + 0.5f : left + 1.0f;
                for (const glm::vec2& corner : {uv(ring, above), uv(ring + 1, left), uv(ring + 1, left + 1.0f)})
                    mesh.cornerUvs.push_back(corner);
            }
        }
    }
    mesh.parts.push_back({.name = "sphere", .firstTriangle = 0, .triangleCount = mesh.triangleCount()});
    return mesh;
}

Groom groomOn(SurfaceMesh mesh, int guides, int segments, float length) {
    Groom groom = makeGroom(std::move(mesh));
    groom.groups.edit()[0].params.general.segments = segments;
    groom.counts.edit().guides = std::max(guides, 3);
    const std::uint64_t triangles = groom.mesh->triangleCount();
    const auto count = static_cast<std::uint64_t>(guides);
    for (std::uint64_t i = 0; i < count; ++i) {
        SurfacePoint root{static_cast<std::uint32_t>(i * triangles / count), 1.0f / 3.0f, 1.0f / 3.0f};
        if (count > triangles) {
            // Several on one triangle: spread them, so that no two roots are equal.
            root.u = 0.1f + 0.4f * randomFloat(7, i, 0);
            root.v = 0.1f + 0.4f * randomFloat(7, i, 1);
        }
        const glm::vec3 position = positionAt(*groom.mesh, root);
        const glm::vec3 normal = normalAt(*groom.mesh, root);
        std::vector<glm::vec3> points{position};
        for (int k = 1; k <= segments; ++k)
            points.push_back(position + normal * (length * static_cast<float>(k) / static_cast<float>(segments)));
        groom.guides.append(root, 0, points);
    }
    return groom;
}

std::optional<std::filesystem::path> realData(const std::string& name) {
    const char* folder = std::getenv("WHORL_TEST_DATA");
    if (!folder) return std::nullopt;
    std::error_code error;
    std::filesystem::path path = std::filesystem::path(folder) / name;
    if (!std::filesystem::exists(path, error) || error) return std::nullopt;
    return path;
}

namespace {

// Removes the scratch folders of this process when it ends.
struct ScratchFolders {
    std::mutex mutex;
    std::vector<std::filesystem::path> paths;
    ~ScratchFolders() {
        for (const std::filesystem::path& path : paths) {
            std::error_code ignored;
            std::filesystem::remove_all(path, ignored);
        }
    }
};

}  // namespace

std::filesystem::path scratchFolder(const std::string& name) {
    static ScratchFolders folders;
    const std::lock_guard lock(folders.mutex);
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() /
        ("whorl-test-" + std::to_string(getpid()) + "-" + std::to_string(folders.paths.size()) + "-" + name);
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
    folders.paths.push_back(path);
    return path;
}

}  // namespace whorl::testing
