// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/polygons.h"

namespace whorl::import {

void cutPolygons(const Polygons& polygons, const std::vector<glm::vec2>& uvs, RawMesh& mesh) {
    const auto faceCount = static_cast<std::uint32_t>(polygons.faceEnds.size());
    std::vector<Polygons::Run> runs = polygons.runs;
    if (runs.empty()) runs.push_back({});

    // Runs of one part are brought together; parts keep the order of `mesh.parts`.
    std::vector<std::vector<std::uint32_t>> runsOfPart(mesh.parts.size());
    for (std::uint32_t r = 0; r < runs.size(); ++r) runsOfPart[runs[r].part].push_back(r);

    mesh.corners.reserve(polygons.triangles * 3);
    if (!polygons.uvs.empty()) mesh.cornerUvs.reserve(polygons.triangles * 3);
    std::vector<glm::vec3> polygon;
    std::vector<std::uint32_t> cut;
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
        const std::size_t first = mesh.corners.size() / 3;
        for (const std::uint32_t r : runsOfPart[p]) {
            const std::uint32_t end = r + 1 < runs.size() ? runs[r + 1].firstFace : faceCount;
            for (std::uint32_t face = runs[r].firstFace; face < end; ++face) {
                const std::uint64_t begin = face == 0 ? 0 : polygons.faceEnds[face - 1];
                polygon.clear();
                for (std::uint64_t i = begin; i < polygons.faceEnds[face]; ++i) {
                    polygon.push_back(mesh.positions[polygons.positions[i]]);
                }
                cut.clear();
                triangulate(polygon, cut);
                for (const std::uint32_t corner : cut) {
                    mesh.corners.push_back(polygons.positions[begin + corner]);
                    if (polygons.uvs.empty()) continue;
                    const std::uint32_t uv = polygons.uvs[begin + corner];
                    mesh.cornerUvs.push_back(uv == Polygons::noUv ? glm::vec2(0.0f) : uvs[uv]);
                }
            }
        }
        mesh.parts[p].firstTriangle = static_cast<std::uint32_t>(first);
        mesh.parts[p].triangleCount = static_cast<std::uint32_t>(mesh.corners.size() / 3 - first);
    }
}

}  // namespace whorl::import
