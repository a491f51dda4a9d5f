// SPDX-License-Identifier: Apache-2.0
// The places that hairs grow from.
#pragma once

#include "core/sampling/root_sampler.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// One root and the frame there.
struct HairRoot {
    std::uint32_t id = 0;  ///< of the hair in the whole groom: its number in the sampler's sequence
    SurfacePoint point{};
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
    glm::vec2 uv{0.0f};
    std::uint8_t group = 0;
    std::uint32_t unit = 0;  ///< where on the sampler's curve, by which roots are in order; for roots of makeRoots
};

/// What roots are drawn from.
struct RootSource {
    const SurfaceMesh& mesh;
    const RootSampler& sampler;
    const DensityLookup& density;
    RootRequest request;
};

/// The root of hair `id` at its place, but for its unit.
HairRoot rootAt(const RootSource& source, std::uint32_t id, const SurfacePoint& point);

/// The request that gives `share` of `hairs` hairs on the groom as `sampler` measured it, or on the groom as it was
/// before paint (counts.density_total). Where that is not pinned hairs are counted, so keep the answer: then
/// counts.hairs are that many exactly, and other numbers a part of them or more of the same sequence, close to that
/// many. So paint, which pins the weight, moves no hair outside the dab whatever number is shown.
RootRequest requestFor(const CountParams& counts, const RootSampler& sampler, double hairs, double share = 1.0);

/// Number of roots to expect in a range, before those on places of no density are left out.
double expectedRoots(const RootSource& source, RootRange range);

/// Piece `index` of `count` of a range, with equal numbers of roots.
RootRange pieceOf(const RootSampler& sampler, RootRange range, std::size_t index, std::size_t count);

/// Roots in several ranges, in one thread; `ends`: the count of `roots` after each. See the next.
void makeRoots(const RootSource& source, std::span<const RootRange> ranges, std::vector<HairRoot>& roots,
               std::vector<std::size_t>& ends);

/// Roots in `range` in order of the sampler's curve; those on places of no density are left out. Fewer when cancelled.
std::vector<HairRoot> makeRoots(const RootSource& source, RootRange range, Progress& progress);

}  // namespace whorl
