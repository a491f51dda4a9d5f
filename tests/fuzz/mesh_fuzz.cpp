// SPDX-License-Identifier: Apache-2.0
// Bytes to mesh: whatever comes in, a mesh that keeps its promises or one sentence comes out.
#include "core/io/mesh_import.h"

#include <cmath>
#include <cstdlib>

namespace {

void promise(bool kept) {
    if (!kept) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    whorl::Progress progress;
    const auto got = whorl::importMeshBytes({data, size}, WHORL_FUZZ_FORMAT, progress, {.textures = false});
    if (!got) {
        promise(!got.error().message.empty() && got.error().message.find('\n') == std::string::npos);
        return 0;
    }
    const whorl::SurfaceMesh& mesh = got->mesh;
    promise(!mesh.triangles.empty());
    promise(mesh.normals.size() == mesh.positions.size());
    promise(mesh.cornerUvs.size() == mesh.triangles.size() * 3);
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int k = 0; k < 3; ++k) promise(triangle[k] < mesh.positions.size());
    }
    for (const glm::vec3& p : mesh.positions) promise(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    for (const glm::vec3& n : mesh.normals) promise(std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z));
    for (const glm::vec2& uv : mesh.cornerUvs) promise(std::isfinite(uv.x) && std::isfinite(uv.y));
    std::uint32_t next = 0;
    for (const whorl::MeshPart& part : mesh.parts) {
        promise(part.firstTriangle == next);
        next += part.triangleCount;
    }
    promise(next == mesh.triangleCount());
    return 0;
}
