// SPDX-License-Identifier: Apache-2.0
#include "core/model/guide_set.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>

namespace whorl {
namespace {

std::size_t memoryOf(const GuideBlock& block) {
    return block.roots.size() * (sizeof(SurfacePoint) + sizeof(std::uint32_t) + 1) +
           block.firstPoint.size() * sizeof(std::uint32_t) + block.points.size() * sizeof(glm::vec3) +
           sizeof(GuideBlock);
}

void appendTo(GuideBlock& block, std::uint32_t id, SurfacePoint root, std::uint8_t group,
              std::span<const glm::vec3> points) {
    block.roots.push_back(root);
    block.ids.push_back(id);
    block.groups.push_back(group);
    block.points.insert(block.points.end(), points.begin(), points.end());
    block.firstPoint.push_back(static_cast<std::uint32_t>(block.points.size()));
}

}  // namespace

bool GuideSet::sameAs(const GuideSet& other) const {
    if (m_blocks.size() != other.m_blocks.size() || m_nextId != other.m_nextId) return false;
    for (std::size_t i = 0; i < m_blocks.size(); ++i) {
        if (!m_blocks[i].sameAs(other.m_blocks[i])) return false;
    }
    return true;
}

GuideSet::Place GuideSet::locate(std::size_t index) const {
    assert(index < count());
    const auto next = std::upper_bound(m_firstIndex.begin(), m_firstIndex.end(), index);
    const auto block = static_cast<std::size_t>(next - m_firstIndex.begin()) - 1;
    return {block, index - m_firstIndex[block]};
}

SurfacePoint GuideSet::root(std::size_t index) const {
    const Place place = locate(index);
    return m_blocks[place.block]->roots[place.slot];
}

std::uint32_t GuideSet::id(std::size_t index) const {
    const Place place = locate(index);
    return m_blocks[place.block]->ids[place.slot];
}

std::uint8_t GuideSet::group(std::size_t index) const {
    const Place place = locate(index);
    return m_blocks[place.block]->groups[place.slot];
}

std::span<const glm::vec3> GuideSet::points(std::size_t index) const {
    const Place place = locate(index);
    const GuideBlock& block = *m_blocks[place.block];
    const std::uint32_t first = block.firstPoint[place.slot];
    return {block.points.data() + first, block.firstPoint[place.slot + 1] - first};
}

std::span<glm::vec3> GuideSet::editPoints(std::size_t index) {
    const Place place = locate(index);
    GuideBlock& block = m_blocks[place.block].edit();
    const std::uint32_t first = block.firstPoint[place.slot];
    return {block.points.data() + first, block.firstPoint[place.slot + 1] - first};
}

void GuideSet::setRoot(std::size_t index, SurfacePoint root) {
    const Place place = locate(index);
    m_blocks[place.block].edit().roots[place.slot] = root;
}

void GuideSet::setGroup(std::size_t index, std::uint8_t group) {
    const Place place = locate(index);
    m_blocks[place.block].edit().groups[place.slot] = group;
}

void GuideSet::setPoints(std::size_t index, std::span<const glm::vec3> points) {
    assert(points.size() >= 2);
    const Place place = locate(index);
    GuideBlock& block = m_blocks[place.block].edit();
    const std::uint32_t first = block.firstPoint[place.slot];
    const std::uint32_t last = block.firstPoint[place.slot + 1];
    if (points.size() == last - first) {
        std::copy(points.begin(), points.end(), block.points.begin() + first);
        return;
    }
    // The source may lie in the block that is about to move.
    const std::vector<glm::vec3> copy(points.begin(), points.end());
    block.points.erase(block.points.begin() + first, block.points.begin() + last);
    block.points.insert(block.points.begin() + first, copy.begin(), copy.end());
    const auto grown = static_cast<std::int64_t>(copy.size()) - (last - first);
    for (std::size_t i = place.slot + 1; i < block.firstPoint.size(); ++i) {
        block.firstPoint[i] = static_cast<std::uint32_t>(block.firstPoint[i] + grown);
    }
}

std::uint32_t GuideSet::append(SurfacePoint root, std::uint8_t group, std::span<const glm::vec3> points) {
    const std::uint32_t id = m_nextId;
    appendWithId(id, root, group, points);
    return id;
}

void GuideSet::appendWithId(std::uint32_t id, SurfacePoint root, std::uint8_t group,
                            std::span<const glm::vec3> points) {
    assert(points.size() >= 2);
    if (m_blocks.empty() || m_blocks.back()->count() >= GuideBlock::capacity) {
        m_blocks.emplace_back();
        m_firstIndex.push_back(m_firstIndex.back());
    }
    appendTo(m_blocks.back().edit(), id, root, group, points);
    ++m_firstIndex.back();
    m_nextId = std::max(m_nextId, id + 1);
}

void GuideSet::erase(std::span<const std::size_t> indices) {
    auto next = indices.begin();
    std::vector<Cow<GuideBlock>> kept;
    kept.reserve(m_blocks.size());
    std::vector<std::size_t> firstIndex{0};
    for (std::size_t b = 0; b < m_blocks.size(); ++b) {
        const std::size_t first = m_firstIndex[b];
        const std::size_t last = m_firstIndex[b + 1];
        if (next == indices.end() || *next >= last) {
            kept.push_back(m_blocks[b]);
        } else {
            GuideBlock smaller;
            const GuideBlock& block = *m_blocks[b];
            for (std::size_t index = first; index < last; ++index) {
                if (next != indices.end() && *next == index) {
                    ++next;
                    continue;
                }
                const std::size_t slot = index - first;
                const std::uint32_t begin = block.firstPoint[slot];
                appendTo(smaller, block.ids[slot], block.roots[slot], block.groups[slot],
                         {block.points.data() + begin, block.firstPoint[slot + 1] - begin});
            }
            if (smaller.count() == 0) continue;
            kept.emplace_back(std::move(smaller));
        }
        firstIndex.push_back(firstIndex.back() + kept.back()->count());
    }
    m_blocks = std::move(kept);
    m_firstIndex = std::move(firstIndex);
}

void GuideSet::clear() {
    m_blocks.clear();
    m_firstIndex = {0};
}

std::size_t GuideSet::bytesNotSharedWith(const GuideSet& before) const {
    // Blocks move to other places when earlier ones are erased, so places can not be compared one by one.
    std::vector<const GuideBlock*> known;
    known.reserve(before.m_blocks.size());
    for (const auto& block : before.m_blocks) known.push_back(&*block);
    std::sort(known.begin(), known.end());
    std::size_t bytes = m_blocks.size() * sizeof(Cow<GuideBlock>) + m_firstIndex.size() * sizeof(std::size_t);
    for (const auto& block : m_blocks) {
        if (!std::binary_search(known.begin(), known.end(), &*block)) bytes += memoryOf(*block);
    }
    return bytes;
}

std::vector<glm::vec3> resampled(std::span<const glm::vec3> points, int segments) {
    assert(segments >= 1 && !points.empty());
    std::vector<double> along(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        along[i] = along[i - 1] + static_cast<double>(glm::distance(points[i - 1], points[i]));
    }
    std::vector<glm::vec3> result(static_cast<std::size_t>(segments) + 1, points.front());
    std::size_t piece = 0;
    for (int i = 1; i < segments; ++i) {
        const double target = along.back() * i / segments;
        while (piece + 2 < points.size() && along[piece + 1] < target) ++piece;
        if (piece + 1 >= points.size()) continue;
        const double length = along[piece + 1] - along[piece];
        const float t = length > 0.0 ? static_cast<float>((target - along[piece]) / length) : 0.0f;
        result[static_cast<std::size_t>(i)] = points[piece] + (points[piece + 1] - points[piece]) * t;
    }
    result.back() = points.back();
    return result;
}

}  // namespace whorl
