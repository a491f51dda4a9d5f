// SPDX-License-Identifier: Apache-2.0
// Which roots lie on two sides of a parting.
#pragma once

#include "core/model/parting.h"
#include "core/surface/surface_point.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

// A parting stands on the skin as a curtain: its line, drawn out along the skin's normals both ways. A pair of roots is
// parted when the straight way between them meets the curtain. How high the curtain stands depends on the pair: three
// quarters of their distance, which is more than the way between roots can dip under curved skin (half of it on a ball
// between roots a quarter turn off the line). So near the line it is low, and what lies behind a thin ear is left
// alone; a pair that both face away from the curtain's side is not parted by it.
//
// At its ends a parting opens smoothly. The way between two parted roots that goes round the end of the curtain is
// longer than the straight one; up to half as long again, the guide counts as farther away, growing without bound
// towards that half. Beyond, it is separated. So nothing jumps where the straight way slips past the end, and a hair
// farther from both ends than about the distance of the line never takes anything from the other side. Ends that meet
// another parting or the other end of their own, or stop less than a step before, have no way round.

namespace whorl {

/// Immutable once made; any thread may ask. Without partings every question costs one comparison.
class PartingIndex {
public:
    static constexpr float separate = std::numeric_limits<float>::infinity();
    /// How much longer than the straight way the one round an end may be.
    static constexpr float mostDetour = 0.5f;

    /// A root and the skin's unit normal there.
    struct Root {
        glm::vec3 position{0.0f};
        glm::vec3 normal{0.0f, 1.0f, 0.0f};
    };

    PartingIndex() = default;
    PartingIndex(const SurfaceMesh& mesh, std::span<const Parting> partings);

    bool empty() const { return m_pieces.empty(); }
    /// True when neither may take anything from the other. Symmetric.
    bool separated(const Root& a, const Root& b) const { return !empty() && detour(a, b) == separate; }
    /// By how much the distance of the two grows: 1 when no parting is between them, `separate` when they have nothing
    /// to do with each other, and continuous in both roots except across the line itself. Symmetric up to rounding.
    float detour(const Root& a, const Root& b) const;
    /// False only when no two roots in the ball are parted.
    bool near(const glm::vec3& centre, float radius) const;
    /// The place itself, or when it lies less than `distance` beside a parting, moved away to that, on its side: the
    /// middle edges of a symmetric mesh lie in a middle parting, and rounding would put a place of theirs on one side
    /// for one pair and on the other for the next.
    glm::vec3 beside(const glm::vec3& place, float distance) const;

private:
    struct Point {
        glm::vec3 position{0.0f};
        glm::vec3 normal{0.0f};
    };
    struct Piece {
        std::uint32_t point = 0;  // the first of two in m_points
        std::uint32_t line = 0;
    };
    struct Line {
        float longest = 0.0f;     // piece
        std::uint32_t ends[2]{};  // in m_points
        bool open[2]{};           // a way leads round
    };
    // The tree halves the pieces in their order, which is along the lines.
    struct Node {
        Bounds box{};
        std::uint32_t first = 0, last = 0;
        std::uint32_t second = 0;  // the first child follows its parent; 0: a leaf
    };
    void addLine(const SurfaceMesh& mesh, const Parting& parting);
    void joinEnds();
    std::uint32_t build(std::uint32_t first, std::uint32_t last);
    bool crosses(const Piece& piece, float height, const Root& a, const Root& b) const;
    float aroundEnds(const Line& line, const Root& a, const Root& b) const;
    glm::vec3 besidePiece(const Piece& piece, const glm::vec3& place, float distance) const;

    std::vector<Point> m_points;
    std::vector<Piece> m_pieces;
    std::vector<Line> m_lines;
    std::vector<Node> m_nodes;
    float m_longest = 0.0f;
};

}  // namespace whorl
