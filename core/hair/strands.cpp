// SPDX-License-Identifier: Apache-2.0
#include "core/hair/strands.h"

#include "core/base/parallel.h"
#include "core/hair/curve.h"

#include <algorithm>

namespace whorl {
namespace {

template <class Values>
std::size_t bytesOf(const Values& values) {
    return values.size() * sizeof(values[0]);
}

template <class Values>
void appendTo(Values& values, const Values& more) {
    values.insert(values.end(), more.begin(), more.end());
}

}  // namespace

std::size_t Strands::bytes() const {
    return bytesOf(firstVertex) + bytesOf(ids) + bytesOf(members) + bytesOf(roots) + bytesOf(rootUvs) +
           bytesOf(groups) + bytesOf(positions) + bytesOf(normals) + bytesOf(widths) + bytesOf(colours);
}

void Strands::append(const Strands& more) {
    if (this == &more) {
        const Strands copy = more;
        append(copy);
        return;
    }
    const std::uint32_t base = firstVertex.back();
    firstVertex.reserve(firstVertex.size() + more.count());
    for (std::size_t i = 1; i < more.firstVertex.size(); ++i) firstVertex.push_back(base + more.firstVertex[i]);
    appendTo(ids, more.ids);
    appendTo(members, more.members);
    appendTo(roots, more.roots);
    appendTo(rootUvs, more.rootUvs);
    appendTo(groups, more.groups);
    appendTo(positions, more.positions);
    appendTo(normals, more.normals);
    appendTo(widths, more.widths);
    appendTo(colours, more.colours);
}

void Strands::clear() {
    firstVertex.assign(1, 0);
    ids.clear();
    members.clear();
    roots.clear();
    rootUvs.clear();
    groups.clear();
    positions.clear();
    normals.clear();
    widths.clear();
    colours.clear();
}

void Strands::resize(std::size_t hairs, std::size_t vertices) {
    firstVertex.resize(hairs + 1);
    firstVertex[0] = 0;
    ids.resize(hairs);
    members.resize(hairs);
    roots.resize(hairs);
    rootUvs.resize(hairs);
    groups.resize(hairs);
    positions.resize(vertices);
    normals.resize(vertices);
    widths.resize(vertices);
    colours.resize(vertices);
}

Bounds Strands::bounds() const {
    constexpr std::size_t grain = 4096;
    std::vector<Bounds> blocks((count() + grain - 1) / grain);
    parallelFor(count(), grain, [&](std::size_t begin, std::size_t end) {
        Bounds& block = blocks[begin / grain];
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t first = firstVertex[i], vertices = firstVertex[i + 1] - first;
            addStrandBounds({&positions[first], vertices}, {&widths[first], vertices}, block);
        }
    });
    Bounds all;
    for (const Bounds& block : blocks)
        if (!block.empty()) all.add(block);
    return all;
}

void Strands::addTo(Hasher& hasher) const {
    for (std::size_t i = 0; i < count(); ++i) {
        const std::size_t first = firstVertex[i];
        const std::uint32_t vertices = firstVertex[i + 1] - firstVertex[i];
        const std::uint32_t group = groups[i];
        hasher.add(&ids[i], sizeof ids[i]);
        if (i < members.size() && members[i] > 0) hasher.add(&members[i], sizeof members[i]);
        hasher.add(&roots[i], sizeof roots[i]);
        hasher.add(&rootUvs[i], sizeof rootUvs[i]);
        hasher.add(&group, sizeof group);
        hasher.add(&vertices, sizeof vertices);
        hasher.add(&positions[first], vertices * sizeof positions[0]);
        hasher.add(&normals[first], vertices * sizeof normals[0]);
        hasher.add(&widths[first], vertices * sizeof widths[0]);
        hasher.add(&colours[first], vertices * sizeof colours[0]);
    }
}

}  // namespace whorl
