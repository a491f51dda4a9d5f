// SPDX-License-Identifier: Apache-2.0
// Makes sixteen hairs at a time: the inside of evaluateHairs.
#pragma once

#include "core/hair/evaluate.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// What all hairs of one group share.
struct GroupTables {
    std::size_t group = 0;
    int segments = 1;
    std::size_t stride = GuideShapes::lanes;
    bool keepOutside = false;
    std::uint32_t members = 0;       ///< hairs of a strand, 0: single hairs
    float usualWidth = 0.0f;         ///< root thickness without maps
    std::vector<float> along, ease;  ///< `stride` entries, see ShapeArrays
};
std::vector<GroupTables> makeGroupTables(const Groom& groom);

/// One object a thread.
class Evaluator {
public:
    static constexpr std::size_t lanes = GuideShapes::lanes;

    Evaluator(const HairSources& sources, const GrownHairs& grown, Strands& strands)
        : m_sources(sources), m_grown(grown), m_strands(strands) {}

    /// Up to sixteen hairs of one group, by place in `grown`.
    void make(const GroupTables& group, std::span<const std::uint32_t> which);
    /// Widths and colours of one hair and its members.
    void setLook(const GroupTables& group, std::uint32_t hair);

private:
    using Rows = std::array<std::vector<float>, 3>;  // x, y, z: vertex v of lane l at [v * 16 + l]

    void shape(const GroupTables& group, std::size_t count);
    void modify(const GroupTables& group, std::size_t count);
    void runStep(const GroupTables& group, const ModifierStep& step, std::size_t count);
    std::size_t setPoints(const GroupTables& group, std::uint32_t hair, std::size_t lane);
    void setRow(std::size_t v, std::size_t lane, const glm::vec3& p);
    void repeatLane(std::size_t from, std::size_t to, std::size_t rows);
    void frame(std::size_t vertices);
    void makeMembers(const GroupTables& group, std::span<const std::uint32_t> which);
    void cutRows(const GroupTables& group, std::size_t lane, std::size_t root);
    void store(const Rows& points, const Rows& normals, std::size_t lane, std::size_t strand);

    const HairSources& m_sources;
    const GrownHairs& m_grown;
    Strands& m_strands;
    std::uint32_t m_roots[lanes] = {};  // places in HairSources::roots
    float m_starts[lanes * 3] = {};
    float m_surfaceX[lanes] = {}, m_surfaceY[lanes] = {}, m_surfaceZ[lanes] = {};
    std::vector<float> m_x, m_y, m_z;  // hair by hair: vertex v of lane l at [l * stride + v]
    std::vector<glm::vec3> m_points;
    Rows m_row, m_normal, m_u, m_v, m_w, m_member, m_memberNormal;
    std::vector<float> m_scratch, m_numbers;
    float m_random[ModifierArrays::randomRows * lanes] = {};
    std::uint64_t m_keys[lanes] = {};   // of hairs for random numbers
    std::uint64_t m_locks[lanes] = {};  // of the last lock that gathered them, else that of the hair
    std::vector<float> m_taper;
};

/// Place of member `member` of `count` in the disc around its base hair: across and up in -1 to 1, lift in 0 to 1.
struct MemberPlace {
    float across = 0.0f;
    float up = 0.0f;
    float lift = 0.0f;
};
MemberPlace memberPlace(std::uint32_t seed, std::uint32_t hair, std::uint32_t member, std::uint32_t count,
                        float randomise, float aspect);

}  // namespace whorl
