// SPDX-License-Identifier: Apache-2.0
#include "tests/support/lic_scene.h"

#include "core/field/groom_field.h"
#include "core/surface/parting_line.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl::testing {

const Lines aroundTheBall{{{0.1f, 0, 0}, {0.08f, 0.05f, 0.03f}, {0.05f, 0.08f, 0.02f}},
                          {{-0.05f, 0.08f, 0.03f}, {-0.09f, 0.02f, 0.04f}},
                          {{0, -0.02f, -0.1f}, {0.03f, 0.01f, -0.09f}}};

LicScene::LicScene(SurfaceMesh mesh, const Lines& strokes, const Lines& partings)
    : groom(makeGroom(std::move(mesh))), surface(std::make_shared<const Surface>(groom.mesh)) {
    for (const auto& line : partings) part(line);
    for (const auto& line : strokes) stroke(line);
    solve();
}

LicScene::LicScene(Groom made) : groom(std::move(made)), surface(std::make_shared<const Surface>(groom.mesh)) {
    solve();
}

void LicScene::stroke(const std::vector<glm::vec3>& places) {
    FieldStroke made;
    made.id = static_cast<std::uint32_t>(groom.strokes->size()) + 1;
    made.points = *tracedParting(*surface, places);
    groom.strokes.edit().push_back(std::move(made));
}

void LicScene::part(const std::vector<glm::vec3>& places) {
    groom.partings.edit().push_back({nextPartingId(*groom.partings), "", *tracedParting(*surface, places)});
}

void LicScene::solve() {
    Progress progress;
    field = grows.empty() ? *groomField(groom, surface, progress)
                          : *FieldSolver::make(surface, grows, *groom.partings, progress)
                                 ->solve(leadingStrokes(groom, *surface), *groom.field, progress);
}

LicPainter painterFor(const LicScene& scene, int size, LicLayout layout) {
    Progress progress;
    return *LicPainter::make(scene.surface, size, progress, layout);
}

LicTexture painted(const LicPainter& painter, const LicScene& scene, const LicTexture* before) {
    Progress progress;
    return *painter.paint(scene.groom, scene.field, before, progress);
}

std::optional<std::size_t> texelOf(const LicPainter& painter, const TexelAtlas::Slot& slot) {
    const auto side = static_cast<std::uint32_t>(painter.atlas().side());
    const auto size = static_cast<std::uint32_t>(painter.size());
    const std::uint32_t x = slot.texel % side - TexelAtlas::pad, y = slot.texel / side - TexelAtlas::pad;
    if (x >= size || y >= size) return std::nullopt;
    return std::size_t{y} * size + x;
}

std::size_t texelAt(const LicTexture& texture, const SurfacePoint& at) {
    const std::vector<glm::vec2>& uvs = *texture.cornerUvs;
    const glm::vec2 uv = uvs[at.triangle * 3ull] * (1.0f - at.u - at.v) + uvs[at.triangle * 3ull + 1] * at.u +
                         uvs[at.triangle * 3ull + 2] * at.v;
    const int size = texture.size;
    const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(size)), 0, size - 1);
    const int y = std::clamp(static_cast<int>((1.0f - uv.y) * static_cast<float>(size)), 0, size - 1);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
}

float degreesBetween(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29578f;
}

}  // namespace whorl::testing
