// SPDX-License-Identifier: Apache-2.0
#include "core/hair/roots.h"

#include "core/base/parallel.h"
#include "core/surface/surface_point.h"

#include <algorithm>

namespace whorl {
namespace {

constexpr double rootsPerPiece = 4096.0;

}  // namespace

HairRoot rootAt(const RootSource& source, std::uint32_t id, const SurfacePoint& point) {
    HairRoot root;
    root.id = id;
    root.point = point;
    root.position = positionAt(source.mesh, point);
    root.normal = normalAt(source.mesh, point);
    root.uv = uvAt(source.mesh, point);
    root.group = static_cast<std::uint8_t>(source.density.groupAt(root.uv));
    return root;
}

RootRequest requestFor(const CountParams& counts, const RootSampler& sampler, double hairs, double share) {
    const auto seed = static_cast<std::uint32_t>(counts.seed);
    const float weight = counts.densityTotal > 0.0f ? counts.densityTotal : sampler.weightFor(counts.hairs, seed);
    return {weight > 0.0f ? hairs * share / static_cast<double>(weight) : 0.0, seed};
}

double expectedRoots(const RootSource& source, RootRange range) {
    const RootSampler& sampler = source.sampler;
    return source.request.rate * sampler.weight() *
           std::max(sampler.shareBefore(range.last) - sampler.shareBefore(range.first), 0.0);
}

RootRange pieceOf(const RootSampler& sampler, RootRange range, std::size_t index, std::size_t count) {
    const double first = sampler.shareBefore(range.first), last = sampler.shareBefore(range.last);
    const auto edge = [&](std::size_t i) {
        if (i == 0) return range.first;
        if (i >= count) return range.last;
        const double share = first + (last - first) * static_cast<double>(i) / static_cast<double>(count);
        return std::clamp(sampler.cut(share), range.first, range.last);
    };
    return {edge(index), edge(index + 1)};
}

void makeRoots(const RootSource& source, std::span<const RootRange> ranges, std::vector<HairRoot>& roots,
               std::vector<std::size_t>& ends) {
    RootList list;
    source.sampler.sample(source.request, ranges, list, ends);
    const CandidateKeys keys = candidateKeys(source.request.seed);
    roots.reserve(roots.size() + list.count());
    std::size_t i = 0;
    for (std::size_t& end : ends) {
        for (; i < end; ++i) {
            HairRoot root = rootAt(source, list.id(i), list.point(i));
            root.unit = list.hasUnits() ? list.unit(i) : unitOf(stratumOf(keys, root.id));
            if (list.hasUnits() && ((root.id & evenId) != 0) != source.density.isEven(root.group)) continue;
            if (source.density.at(root.point.triangle, root.uv) > 0.0f) roots.push_back(root);
        }
        end = roots.size();
    }
}

std::vector<HairRoot> makeRoots(const RootSource& source, RootRange range, Progress& progress) {
    if (source.sampler.empty() || range.last <= range.first) return {};
    source.sampler.prepare(source.request, progress);
    const auto pieces = static_cast<std::size_t>(expectedRoots(source, range) / rootsPerPiece) + 1;
    std::vector<std::vector<HairRoot>> made(pieces);
    parallelFor(pieces, 1, [&](std::size_t begin, std::size_t end) {
        std::vector<std::size_t> ends;
        for (std::size_t piece = begin; piece < end && !progress.cancelled(); ++piece) {
            const RootRange part = pieceOf(source.sampler, range, piece, pieces);
            makeRoots(source, std::span(&part, 1), made[piece], ends);
        }
    });
    if (pieces == 1) return std::move(made[0]);
    std::size_t count = 0;
    for (const std::vector<HairRoot>& roots : made) count += roots.size();
    std::vector<HairRoot> all;
    all.reserve(count);
    for (const std::vector<HairRoot>& roots : made) all.insert(all.end(), roots.begin(), roots.end());
    return all;
}

}  // namespace whorl
