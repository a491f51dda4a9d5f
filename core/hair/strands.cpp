// SPDX-License-Identifier: Apache-2.0
#include "core/hair/strands.h"

#include "core/base/parallel.h"
#include "core/hair/boxes.kernel.h"
#include "core/hair/curve.h"

#include <algorithm>
#include <cmath>

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

// True when the curves of a box with their widths stay inside `bounds`: between vertices of a curve the width reaches
// at most a sixth farther than at the widest.
bool insideOf(const Bounds& bounds, const HairBoxes& box) {
    const float reach = box.widest * (7.0f / 12.0f);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
        const float low = box.outerLow[axis] - reach, high = box.outerHigh[axis] + reach;
        const float room = std::max(std::abs(low), std::abs(high)) * 3e-6f;
        inside = inside && low - room > bounds.min[axis] && high + room < bounds.max[axis];
    }
    return inside;
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

bool Strands::makeRoom(std::size_t hairs, std::size_t vertices) {
    const auto has = [](const auto& values, std::size_t count) { return values.capacity() >= count; };
    if (has(firstVertex, hairs + 1) && has(ids, hairs) && has(members, hairs) && has(roots, hairs) &&
        has(rootUvs, hairs) && has(groups, hairs) && has(positions, vertices) && has(normals, vertices) &&
        has(widths, vertices) && has(colours, vertices))
        return true;
    *this = Strands();
    hairs += hairs / 16;
    vertices += vertices / 16;
    firstVertex.reserve(hairs + 1);
    ids.reserve(hairs);
    members.reserve(hairs);
    roots.reserve(hairs);
    rootUvs.reserve(hairs);
    groups.reserve(hairs);
    positions.reserve(vertices);
    normals.reserve(vertices);
    widths.reserve(vertices);
    colours.reserve(vertices);
    return false;
}

Bounds Strands::bounds() const {
    constexpr std::size_t together = 64, grain = 16;
    const std::size_t blocks = (count() + together - 1) / together;
    std::vector<HairBoxes> boxes(blocks);
    const auto hairsOf = [&](std::size_t block) { return std::min(together, count() - block * together); };
    parallelFor(blocks, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            const BoxArrays arrays{&firstVertex[block * together], hairsOf(block), &positions.data()->x, widths.data()};
            WHORL_PICK(boxesOfHairs)(arrays, boxes[block]);
        }
    });
    // All vertices are in the box. Hairs that can not reach out of theirs need no closer look.
    Bounds all;
    for (const HairBoxes& box : boxes) {
        if (!(box.low[0] <= box.high[0])) continue;
        all.add({box.low[0], box.low[1], box.low[2]});
        all.add({box.high[0], box.high[1], box.high[2]});
    }
    const Bounds vertices = all;
    std::vector<Bounds> reaching(blocks);
    parallelFor(blocks, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            if (insideOf(vertices, boxes[block])) continue;
            Bounds& bounds = reaching[block] = vertices;
            for (std::size_t i = block * together; i < block * together + hairsOf(block); ++i) {
                const std::size_t first = firstVertex[i], each = firstVertex[i + 1] - first;
                addStrandBounds({&positions[first], each}, {&widths[first], each}, bounds);
            }
        }
    });
    for (const Bounds& bounds : reaching)
        if (!bounds.empty()) all.add(bounds);
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
