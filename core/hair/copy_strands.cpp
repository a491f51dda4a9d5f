// SPDX-License-Identifier: Apache-2.0
#include "core/hair/copy_strands.h"

#include "core/base/copy_past.h"
#include "core/base/parallel.h"

#include <algorithm>

namespace whorl {
namespace {

void copyRun(const StrandRun& run, const Strands& from, Strands& to, bool past) {
    const auto copy = [&](const auto& source, auto& target) {
        std::copy(source.begin() + run.first, source.begin() + run.last, target.begin() + (run.first + run.strands));
    };
    copy(from.ids, to.ids);
    copy(from.members, to.members);
    copy(from.roots, to.roots);
    copy(from.rootUvs, to.rootUvs);
    copy(from.groups, to.groups);
    std::uint32_t* const firstVertex = to.firstVertex.data() + run.strands;
    for (std::size_t i = run.first + std::size_t{1}; i <= run.last; ++i)
        firstVertex[i] = static_cast<std::uint32_t>(from.firstVertex[i] + run.vertices);
    const std::size_t first = from.firstVertex[run.first], last = from.firstVertex[run.last];
    const auto copyVertices = [&](const auto& source, auto& target) {
        const auto* const begin = source.data() + first;
        auto* const place = target.data() + (static_cast<std::int64_t>(first) + run.vertices);
        if (past) {
            copyPast(begin, place, (last - first) * sizeof *begin);
        } else {
            std::copy_n(begin, last - first, place);
        }
    };
    copyVertices(from.positions, to.positions);
    copyVertices(from.normals, to.normals);
    copyVertices(from.widths, to.widths);
    copyVertices(from.colours, to.colours);
}

}  // namespace

void addRuns(std::uint32_t first, std::uint32_t last, std::int64_t strands, std::int64_t vertices,
             std::vector<StrandRun>& runs) {
    constexpr std::uint32_t most = 1024;
    for (std::uint32_t at = first; at < last; at += most)
        runs.push_back({at, std::min(at + most, last), strands, vertices});
}

void copyRuns(std::span<const StrandRun> runs, const Strands& from, Strands& to) {
    // More than this does not stay in the caches.
    constexpr std::size_t cacheBytes = std::size_t{8} << 20;
    std::size_t count = 0;
    for (const StrandRun& run : runs) count += run.last - run.first;
    if (count == 0) return;
    const bool past = from.bytes() / from.count() * count > cacheBytes;
    parallelFor(runs.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) copyRun(runs[i], from, to, past);
    });
}

void copyStrands(const Strands& from, Strands& to) {
    to.resize(from.count(), from.vertexCount());
    std::vector<StrandRun> runs;
    addRuns(0, static_cast<std::uint32_t>(from.count()), 0, 0, runs);
    copyRuns(runs, from, to);
}

}  // namespace whorl
