// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/constraints.h"
#include "core/brushes/guide_shape.h"
#include "core/commands/command.h"
#include "core/sampling/sub_triangle_sampler.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>

namespace whorl {
namespace {

constexpr std::size_t maxGuides = 1000000;

/// Of `roots`, the `count` that are farthest from the guides that are there, in their order.
std::vector<SurfacePoint> farthestFrom(const Groom& groom, const SurfaceMesh& mesh, std::vector<SurfacePoint> roots,
                                       std::size_t count) {
    if (roots.size() <= count) return roots;
    std::vector<float> distances;
    for (const SurfacePoint& root : roots)
        distances.push_back(nearestRoot(groom.guides, positionAt(mesh, root)).distance);
    std::vector<std::size_t> order(roots.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return distances[a] > distances[b]; });
    order.resize(count);
    std::sort(order.begin(), order.end());
    std::vector<SurfacePoint> kept;
    for (const std::size_t i : order) kept.push_back(roots[i]);
    return kept;
}

}  // namespace

Result<void> placeGuides(Groom& groom, const Surface& surface, std::size_t count, float length, bool keep,
                         Progress& progress) {
    if (count > maxGuides) {
        return Error{"A groom can have at most " + std::to_string(maxGuides) + " guides, not " + std::to_string(count) +
                     "."};
    }
    const std::size_t present = keep ? groom.guides.count() : 0;
    if (keep && count <= present) return {};
    const SurfaceMesh& mesh = surface.mesh();
    const DensityLookup density(groom);
    auto sampler = SubTriangleSampler::build(mesh, density, {}, progress);
    if (!sampler) return sampler.error();
    if (sampler->empty()) {
        return Error{"No guide has a place: no part grows hair, or the density is zero everywhere."};
    }
    auto roots = evenRoots(mesh, *sampler, count, static_cast<std::uint32_t>(groom.counts->seed), progress);
    if (!roots) return roots.error();
    if (present > 0) *roots = farthestFrom(groom, mesh, std::move(*roots), count - present);

    const float usedLength = length > 0.0f ? length : defaultGuideLength(surface);
    const SkinClearance skin = SkinClearance::of(surface);
    // What was there gives new guides their shape; new ones do not shape each other.
    const Groom before = groom;
    if (!keep) groom.guides.clear();
    for (std::size_t i = 0; i < roots->size(); ++i) {
        if (i % 64 == 0) {
            if (progress.cancelled()) {
                groom = before;
                return cancelledError();
            }
            progress.report(static_cast<float>(i) / static_cast<float>(roots->size()), "Placing guides");
        }
        const SurfacePoint& root = (*roots)[i];
        const int group = std::clamp(density.groupAt(uvAt(mesh, root)), 0, static_cast<int>(groom.groups->size()) - 1);
        const auto groupNumber = static_cast<std::uint8_t>(group);
        if (present > 0) {
            groom.guides.append(root, groupNumber, guideShapeAt(before, surface, root, groupNumber, usedLength));
            continue;
        }
        const int segments = std::max((*groom.groups)[groupNumber].params.general.segments, 1);
        const glm::vec3 position = positionAt(mesh, root), normal = normalAt(mesh, root);
        std::vector<glm::vec3> points{position};
        for (int k = 1; k <= segments; ++k) {
            points.push_back(position + normal * (usedLength * static_cast<float>(k) / static_cast<float>(segments)));
        }
        const std::vector<glm::vec3> straight = points;
        settle(points, straight, skin);
        groom.guides.append(root, groupNumber, points);
    }
    return {};
}

std::uint32_t addGuide(Groom& groom, const Surface& surface, const SurfacePoint& root, std::uint8_t group,
                       float length) {
    return groom.guides.append(root, group, guideShapeAt(groom, surface, root, group, length));
}

std::string ensureDensityMap(Groom& groom, std::size_t group, int size, float fill) {
    const std::string& current = (*groom.groups)[group].params.general.density.map;
    const Map* map = groom.maps.find(current);
    if (!current.empty() && map != nullptr && map->channels() == 1) return current;
    std::string name = "density";
    for (int i = 2; groom.maps.find(name) != nullptr; ++i) name = "density_" + std::to_string(i);
    groom.maps.set(
        name, Map(std::clamp(size, 1, Map::maxSize), std::clamp(size, 1, Map::maxSize), 1, TexelFormat::U16, fill));
    groom.groups.edit()[group].params.general.density.map = name;
    return name;
}

std::string ensureGroupMap(Groom& groom, int size) {
    const std::string& current = groom.counts->groupMap.name;
    const Map* map = groom.maps.find(current);
    if (!current.empty() && map != nullptr && map->channels() == 1 && !map->empty()) return current;
    std::string name = "groups";
    for (int i = 2; groom.maps.find(name) != nullptr; ++i) name = "groups_" + std::to_string(i);
    const int side = std::clamp(size, 1, Map::maxSize);
    groom.maps.set(name, Map(side, side, 1, TexelFormat::U8, 0.0f));
    groom.counts.edit().groupMap.name = name;
    return name;
}

}  // namespace whorl
