// SPDX-License-Identifier: Apache-2.0
#include "core/hair/guide_shapes.h"

#include "core/surface/surface_point.h"

namespace whorl {
namespace {

int segmentsOf(const Groom& groom, std::uint8_t group) {
    return group < groom.groups->size() ? (*groom.groups)[group].params.general.segments : 1;
}

}  // namespace

GuideShapes::GuideShapes(const Groom& groom) {
    std::size_t total = 0;
    first.reserve(groom.guides.count());
    normals.reserve(groom.guides.count() * 3);
    for (std::size_t b = 0; b < groom.guides.blockCount(); ++b) {
        const GuideBlock& block = groom.guides.block(b);
        for (std::size_t i = 0; i < block.count(); ++i) {
            first.push_back(static_cast<std::uint32_t>(total));
            total += stride(segmentsOf(groom, block.groups[i]));
            const bool there = block.roots[i].triangle < groom.mesh->triangleCount();
            const glm::vec3 normal = there ? normalAt(*groom.mesh, block.roots[i]) : glm::vec3(0, 1, 0);
            normals.insert(normals.end(), {normal.x, normal.y, normal.z});
        }
    }
    x.assign(total, 0.0f);
    y.assign(total, 0.0f);
    z.assign(total, 0.0f);
    for (std::size_t b = 0; b < groom.guides.blockCount(); ++b) update(groom, b);
}

void GuideShapes::update(const Groom& groom, std::size_t block) {
    const GuideBlock& guides = groom.guides.block(block);
    for (std::size_t i = 0; i < guides.count(); ++i) {
        std::span<const glm::vec3> points{guides.points.data() + guides.firstPoint[i],
                                          guides.firstPoint[i + 1] - guides.firstPoint[i]};
        const int segments = segmentsOf(groom, guides.groups[i]);
        std::vector<glm::vec3> refitted;
        if (points.size() != static_cast<std::size_t>(segments) + 1) {
            refitted = resampled(points, segments);
            points = refitted;
        }
        const std::size_t start = first[groom.guides.firstOfBlock(block) + i];
        for (std::size_t v = 0; v < points.size(); ++v) {
            const glm::vec3 offset = points[v] - points[0];
            x[start + v] = offset.x;
            y[start + v] = offset.y;
            z[start + v] = offset.z;
        }
    }
}

}  // namespace whorl
