// SPDX-License-Identifier: Apache-2.0
#include "core/hair/bindings.h"

#include "core/base/parallel.h"
#include "core/surface/surface_point.h"

#include <algorithm>
#include <array>

namespace whorl {

Bindings bindHairs(const Groom& groom, const GuideIndex& index, std::span<const HairRoot> roots, Progress& progress) {
    const std::vector<Group>& groups = *groom.groups;
    Bindings bindings;
    for (std::size_t g = 0; g < groups.size(); ++g)
        bindings.perHair = std::max(
            bindings.perHair, std::min({index.rootsOf(g).size(), GuideIndex::maxNeighbours,
                                        static_cast<std::size_t>(std::max(groups[g].params.general.samples, 0))}));
    const std::size_t places = bindings.perHair;
    bindings.counts.assign(roots.size(), 0);
    bindings.guides.assign(roots.size() * places, 0);
    bindings.matrices.assign(roots.size() * places * 9, 0.0f);
    parallelFor(roots.size(), 512, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        std::array<Neighbour, GuideIndex::maxNeighbours> neighbours;
        for (std::size_t i = begin; i < end; ++i) {
            const HairRoot& root = roots[i];
            const GeneralParams& general = groups[root.group].params.general;
            const std::size_t count =
                index.nearest(root.group, root.position, root.normal, general.samples, neighbours);
            bindings.counts[i] = static_cast<std::uint8_t>(count);
            for (std::size_t j = 0; j < count; ++j) {
                bindings.guides[i * places + j] = neighbours[j].guide;
                const glm::mat3 turn = general.interpolation.index == 0
                                           ? minimalRotation(neighbours[j].root->normal, root.normal)
                                           : glm::mat3(1.0f);
                float* matrix = &bindings.matrices[(i * places + j) * 9];
                for (int row = 0; row < 3; ++row)
                    for (int column = 0; column < 3; ++column) *matrix++ = neighbours[j].weight * turn[column][row];
            }
        }
    });
    return bindings;
}

}  // namespace whorl
