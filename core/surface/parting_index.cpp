// SPDX-License-Identifier: Apache-2.0
#include "core/surface/parting_index.h"

#include "core/surface/closest_point.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace whorl {
namespace {

constexpr std::uint32_t leafPieces = 4;

float curtainHeight(float distance, float longestPiece) {
    // The second part is for pieces that leave the skin between their ends.
    return 0.75f * distance + 0.5f * longestPiece;
}

// How often (mod 2) the way from a to b meets the part of a curtain over one piece of a line: all p + (q - p) s +
// (n + (m - n) s) t for s from 0 to 1 and t from -h to h. It is ruled, not made of triangles, whose diagonals would lie
// elsewhere for another h: on which side a place lies is the same for all pairs. Neighbours decide on the ruling that
// they share by the same numbers, and leave no crack; a place on the curtain counts as in front.
bool meets(const Vec3d& a, const Vec3d& b, const Vec3d& p, const Vec3d& q, const Vec3d& n, const Vec3d& m, double h) {
    const Vec3d c = b - a, d = q - p, turn = m - n;
    // The line through a and b meets the ruling at s where c . (normal x (place - a)) is 0: a parabola, known at both
    // ends.
    const double first = glm::dot(c, glm::cross(n, p - a)), last = glm::dot(c, glm::cross(m, q - a));
    const double bend = glm::dot(c, glm::cross(turn, d)), slope = last - first - bend;
    const auto meetsAt = [&](double s) {
        const Vec3d place = p + d * s, normal = n + turn * s;
        const Vec3d across = glm::cross(c, normal);
        const double size = glm::dot(across, across);
        if (!(size > 0.0)) return false;
        const double w = glm::dot(glm::cross(place - a, normal), across) / size;
        const double t = glm::dot(a + c * w - place, normal) / glm::dot(normal, normal);
        if (!(std::abs(t) <= h)) return false;
        const bool toFront = glm::dot(c, glm::cross(d + turn * t, normal)) > 0.0;
        return toFront ? w > 0.0 && w <= 1.0 : w >= 0.0 && w < 1.0;
    };
    const double under = slope * slope - 4.0 * bend * first;
    if ((first >= 0.0) != (last >= 0.0)) {
        // One of the two roots.
        const double far = -0.5 * (slope + std::copysign(std::sqrt(std::max(under, 0.0)), slope));
        const double one = far != 0.0 ? first / far : 2.0, other = bend != 0.0 ? far / bend : 2.0;
        const auto off = [](double s) { return std::max(std::max(-s, s - 1.0), 0.0); };
        return meetsAt(std::clamp(off(one) <= off(other) ? one : other, 0.0, 1.0));
    }
    // None or both.
    const bool turnsBack =
        (first >= 0.0) == (bend > 0.0) && slope * bend < 0.0 && std::abs(slope) < 2.0 * std::abs(bend);
    if (!turnsBack || !(under > 0.0)) return false;
    const double far = -0.5 * (slope + std::copysign(std::sqrt(under), slope));
    return meetsAt(first / far) != meetsAt(far / bend);
}

bool boxesMeet(const Bounds& box, const glm::vec3& low, const glm::vec3& high) {
    return box.min.x <= high.x && box.min.y <= high.y && box.min.z <= high.z && box.max.x >= low.x &&
           box.max.y >= low.y && box.max.z >= low.z;
}

glm::vec3 nearestOnPiece(const glm::vec3& a, const glm::vec3& b, const glm::vec3& p) {
    const glm::vec3 way = b - a;
    const float squared = glm::dot(way, way);
    return squared > 0.0f ? a + way * std::clamp(glm::dot(p - a, way) / squared, 0.0f, 1.0f) : a;
}

}  // namespace

PartingIndex::PartingIndex(const SurfaceMesh& mesh, std::span<const Parting> partings) {
    for (const Parting& parting : partings) addLine(mesh, parting);
    joinEnds();
    for (std::uint32_t i = 0; i < m_lines.size(); ++i) {
        const Line& line = m_lines[i];
        for (std::uint32_t p = line.ends[0]; p < line.ends[1]; ++p) m_pieces.push_back({p, i});
        m_longest = std::max(m_longest, line.longest);
    }
    if (!m_pieces.empty()) build(0, static_cast<std::uint32_t>(m_pieces.size()));
}

void PartingIndex::addLine(const SurfaceMesh& mesh, const Parting& parting) {
    const auto first = static_cast<std::uint32_t>(m_points.size());
    for (const SurfacePoint& point : parting.points) {
        if (point.triangle >= mesh.triangleCount()) continue;
        const Point made{positionAt(mesh, point), normalAt(mesh, point)};
        if (m_points.size() > first && m_points.back().position == made.position) continue;
        m_points.push_back(made);
    }
    const std::size_t count = m_points.size() - first;
    if (count < 2) {
        m_points.resize(first);
        return;
    }
    // Normals of scanned meshes shake; a curtain that shakes would fold.
    const std::span<Point> line = std::span(m_points).subspan(first);
    for (int pass = 0; pass < 3; ++pass) {
        glm::vec3 before = line[0].normal;
        for (std::size_t i = 1; i + 1 < count; ++i) {
            const glm::vec3 sum = before + line[i].normal * 2.0f + line[i + 1].normal;
            before = line[i].normal;
            if (glm::dot(sum, sum) > 1e-6f) line[i].normal = glm::normalize(sum);
        }
    }
    Line made{0.0f, {first, static_cast<std::uint32_t>(m_points.size() - 1)}, {true, true}};
    for (std::size_t i = 1; i < count; ++i)
        made.longest = std::max(made.longest, glm::distance(line[i - 1].position, line[i].position));
    m_lines.push_back(made);
}

// Draws ends that stop just before another line on to it, and closes the way round them.
void PartingIndex::joinEnds() {
    struct Join {
        std::size_t line;
        int end;
        Point to;
    };
    std::vector<Join> joins;
    for (std::size_t i = 0; i < m_lines.size(); ++i) {
        for (int end = 0; end < 2; ++end) {
            const std::uint32_t tip = m_lines[i].ends[end];
            const Point& from = m_points[tip];
            float nearest = m_lines[i].longest;
            std::optional<Point> found;
            for (std::size_t j = 0; j < m_lines.size(); ++j) {
                for (std::uint32_t p = m_lines[j].ends[0]; p < m_lines[j].ends[1]; ++p) {
                    // Of its own line only what does not lead up to the end.
                    if (i == j && std::max(tip, p) - std::min(tip, p) < 4) continue;
                    const Point &a = m_points[p], &b = m_points[p + 1];
                    const glm::vec3 place = nearestOnPiece(a.position, b.position, from.position);
                    const float distance = glm::distance(place, from.position);
                    if (distance > nearest || glm::dot(a.normal, from.normal) < 0.0f) continue;
                    nearest = distance;
                    found = Point{place, from.normal};
                }
            }
            if (found) joins.push_back({i, end, *found});
        }
    }
    if (joins.empty()) return;
    std::vector<Point> points;
    for (std::size_t i = 0; i < m_lines.size(); ++i) {
        Line& line = m_lines[i];
        const std::uint32_t first = line.ends[0], last = line.ends[1];
        const auto begin = static_cast<std::uint32_t>(points.size());
        for (const Join& join : joins) {
            if (join.line != i || join.end != 0) continue;
            if (join.to.position != m_points[first].position) points.push_back(join.to);
            line.open[0] = false;
        }
        points.insert(points.end(), m_points.begin() + first, m_points.begin() + last + 1);
        for (const Join& join : joins) {
            if (join.line != i || join.end != 1) continue;
            if (join.to.position != m_points[last].position) points.push_back(join.to);
            line.open[1] = false;
        }
        line.ends[0] = begin;
        line.ends[1] = static_cast<std::uint32_t>(points.size() - 1);
    }
    m_points = std::move(points);
}

std::uint32_t PartingIndex::build(std::uint32_t first, std::uint32_t last) {
    const auto index = static_cast<std::uint32_t>(m_nodes.size());
    m_nodes.push_back({{}, first, last, 0});
    Bounds box;
    if (last - first <= leafPieces) {
        for (std::uint32_t i = first; i < last; ++i) {
            box.add(m_points[m_pieces[i].point].position);
            box.add(m_points[m_pieces[i].point + 1].position);
        }
    } else {
        const std::uint32_t middle = first + (last - first) / 2;
        box = m_nodes[build(first, middle)].box;
        const std::uint32_t second = build(middle, last);
        box.add(m_nodes[second].box);
        m_nodes[index].second = second;
    }
    m_nodes[index].box = box;
    return index;
}

bool PartingIndex::crosses(const Piece& piece, float height, const Root& a, const Root& b) const {
    const Point &p = m_points[piece.point], &q = m_points[piece.point + 1];
    const glm::vec3 facing = p.normal + q.normal;
    if (glm::dot(facing, a.normal) < -0.5f && glm::dot(facing, b.normal) < -0.5f) return false;
    return meets(Vec3d(a.position), Vec3d(b.position), Vec3d(p.position), Vec3d(q.position), Vec3d(p.normal),
                 Vec3d(q.normal), static_cast<double>(height));
}

float PartingIndex::aroundEnds(const Line& line, const Root& a, const Root& b) const {
    float best = separate;
    const float straight = glm::distance(a.position, b.position);
    for (int end = 0; end < 2; ++end) {
        if (!line.open[end] || !(straight > 0.0f)) continue;
        // Over the curtain's edge, a line: unrolled around it, the shortest way is straight.
        const Point& tip = m_points[line.ends[end]];
        const glm::vec3 fromA = a.position - tip.position, fromB = b.position - tip.position;
        const float alongA = glm::dot(fromA, tip.normal), alongB = glm::dot(fromB, tip.normal);
        const float across = glm::length(fromA - tip.normal * alongA) + glm::length(fromB - tip.normal * alongB);
        const float round = std::sqrt(across * across + (alongA - alongB) * (alongA - alongB));
        const float more = std::max(round / straight - 1.0f, 0.0f);
        if (more < mostDetour) best = std::min(best, (1.0f + more) / (1.0f - more / mostDetour));
    }
    return best;
}

float PartingIndex::detour(const Root& a, const Root& b) const {
    if (m_nodes.empty()) return 1.0f;
    const float distance = glm::distance(a.position, b.position);
    const glm::vec3 reach(curtainHeight(distance, m_longest));
    const glm::vec3 low = glm::min(a.position, b.position) - reach, high = glm::max(a.position, b.position) + reach;
    float factor = 1.0f;
    std::uint32_t crossed = ~std::uint32_t{0};
    std::array<std::uint32_t, 64> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t index = waiting[--count];
        const Node& node = m_nodes[index];
        if (!boxesMeet(node.box, low, high)) continue;
        if (node.second != 0) {
            // The first child is taken first: pieces of a line then come one after another.
            waiting[count++] = node.second;
            waiting[count++] = index + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.last; ++i) {
            const Piece& piece = m_pieces[i];
            if (piece.line == crossed) continue;
            const Line& line = m_lines[piece.line];
            if (!crosses(piece, curtainHeight(distance, line.longest), a, b)) continue;
            crossed = piece.line;
            factor *= aroundEnds(line, a, b);
            if (factor == separate) return separate;
        }
    }
    return factor;
}

bool PartingIndex::near(const glm::vec3& centre, float radius) const {
    if (m_nodes.empty()) return false;
    // Where two roots of the ball cross a curtain is in the ball, and no farther from the line than the curtain's
    // height for the farthest pair.
    const float reach = radius + curtainHeight(2.0f * radius, m_longest);
    std::array<std::uint32_t, 64> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t index = waiting[--count];
        const Node& node = m_nodes[index];
        const glm::vec3 off = glm::max(glm::max(node.box.min - centre, centre - node.box.max), glm::vec3(0.0f));
        if (glm::dot(off, off) > reach * reach) continue;
        if (node.second == 0) return true;
        waiting[count++] = node.second;
        waiting[count++] = index + 1;
    }
    return false;
}

glm::vec3 PartingIndex::besidePiece(const Piece& piece, const glm::vec3& place, float distance) const {
    const Point &p = m_points[piece.point], &q = m_points[piece.point + 1];
    const glm::vec3 way = q.position - p.position, out = glm::normalize(p.normal + q.normal);
    const glm::vec3 across = glm::cross(out, way);
    const float length = glm::length(way), width = glm::length(across);
    if (!(width > 1e-6f * length)) return place;
    const glm::vec3 from = place - p.position, side = across / width;
    const float along = glm::dot(from, way) / length;
    if (along < -distance || along > length + distance) return place;
    if (std::abs(glm::dot(from, out)) > curtainHeight(distance, m_lines[piece.line].longest)) return place;
    const float off = glm::dot(from, side);
    return std::abs(off) < distance ? place + side * (std::copysign(distance, off) - off) : place;
}

glm::vec3 PartingIndex::beside(const glm::vec3& place, float distance) const {
    glm::vec3 moved = place;
    if (m_nodes.empty()) return moved;
    const glm::vec3 reach(distance + curtainHeight(distance, m_longest));
    std::array<std::uint32_t, 64> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t index = waiting[--count];
        const Node& node = m_nodes[index];
        if (!boxesMeet(node.box, place - reach, place + reach)) continue;
        if (node.second != 0) {
            waiting[count++] = node.second;
            waiting[count++] = index + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.last; ++i) moved = besidePiece(m_pieces[i], moved, distance);
    }
    return moved;
}

}  // namespace whorl
