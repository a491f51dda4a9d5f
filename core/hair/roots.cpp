// SPDX-License-Identifier: Apache-2.0
#include "core/hair/roots.h"

#include "core/base/parallel.h"
#include "core/surface/surface_point.h"

namespace whorl {

HairRoot rootOf(const RootSource& source, std::uint32_t id) {
    HairRoot root;
    root.id = id;
    root.point = source.sampler.stratifiedRoot(id, source.count, source.seed);
    root.position = positionAt(source.mesh, root.point);
    root.normal = normalAt(source.mesh, root.point);
    root.uv = uvAt(source.mesh, root.point);
    root.group = static_cast<std::uint8_t>(source.density.groupAt(root.uv));
    return root;
}

std::vector<HairRoot> makeRoots(const RootSource& source, HairRange range, Progress& progress) {
    if (source.sampler.empty() || range.last <= range.first) return {};
    constexpr std::size_t grain = 2048;
    std::vector<HairRoot> roots(range.last - range.first);
    std::vector<std::uint8_t> kept(roots.size(), 0);
    parallelFor(roots.size(), grain, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        for (std::size_t i = begin; i < end; ++i) {
            roots[i] = rootOf(source, range.first + static_cast<std::uint32_t>(i));
            kept[i] = source.density.at(roots[i].point.triangle, roots[i].uv) > 0.0f;
        }
    });
    std::size_t count = 0;
    for (std::size_t i = 0; i < roots.size(); ++i)
        if (kept[i]) roots[count++] = roots[i];
    roots.resize(count);
    return roots;
}

}  // namespace whorl
