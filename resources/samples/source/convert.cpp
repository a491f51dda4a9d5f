// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/grooms.h"

#include <array>
#include <map>

namespace whorl::samples {

SurfaceMesh meshFrom(const Sculpture& sculpture) {
    SurfaceMesh mesh;
    std::map<std::array<float, 3>, std::uint32_t> welded;
    std::vector<std::uint32_t> vertex(sculpture.positions.size());
    for (std::size_t i = 0; i < sculpture.positions.size(); ++i) {
        const glm::vec3& p = sculpture.positions[i];
        const auto [place, isNew] =
            welded.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(mesh.positions.size()));
        if (isNew) {
            mesh.positions.push_back(p);
            mesh.normals.push_back(sculpture.normals[i]);
        }
        vertex[i] = place->second;
    }
    for (const SculptPart& part : sculpture.parts) {
        mesh.parts.push_back(
            {part.name, mesh.triangleCount(), static_cast<std::uint32_t>(part.triangles.size()), part.colour});
        for (const auto& t : part.triangles) {
            mesh.triangles.emplace_back(vertex[t[0]], vertex[t[1]], vertex[t[2]]);
            for (const std::uint32_t corner : t) mesh.cornerUvs.push_back(sculpture.uvs[corner]);
        }
    }
    return mesh;
}

Groom groomFrom(const Sculpture& sculpture) {
    Groom groom = makeGroom(meshFrom(sculpture));
    for (std::size_t i = 0; i < sculpture.parts.size(); ++i) {
        groom.partSettings.edit()[i].growsHair = sculpture.parts[i].growsHair;
    }
    return groom;
}

Map mapFrom(const ScalarImage& image) {
    Map map(image.width, image.height, 1, TexelFormat::U8, 0.0f);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            map.setTexel(x, y, 0, image.values[static_cast<std::size_t>(y * image.width + x)]);
        }
    }
    return map;
}

Map mapFrom(const ColourImage& image) {
    Map map(image.width, image.height, 3, TexelFormat::U8, 0.0f);
    map.srgb = true;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const glm::vec3& colour = image.values[static_cast<std::size_t>(y * image.width + x)];
            for (int c = 0; c < 3; ++c) map.setTexel(x, y, c, srgbFromLinear(colour[c]));
        }
    }
    return map;
}

}  // namespace whorl::samples
