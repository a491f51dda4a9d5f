// SPDX-License-Identifier: Apache-2.0
// Makes sixteen hairs at a time: the inside of evaluateHairs.
#pragma once

#include "core/base/plain_vector.h"
#include "core/hair/evaluate.h"
#include "core/hair/shaper.h"

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
    bool turned = true;
    bool keepOutside = false;
    std::uint32_t members = 0;       ///< hairs of a strand, 0: single hairs
    float usualWidth = 0.0f;         ///< root thickness without maps
    std::vector<float> along, ease;  ///< `stride` entries, see ShapeArrays
    std::vector<float> tapers;       ///< numbers of all tapers where no map changes them, else empty
    std::vector<float> taperAlong;   ///< what they make of a width at each vertex
    std::size_t vertices() const { return static_cast<std::size_t>(segments) + 1; }
};
std::vector<GroupTables> makeGroupTables(const Groom& groom, const ModifierChain& chain);

/// One object a thread.
class Evaluator {
public:
    static constexpr std::size_t lanes = GuideShapes::lanes;

    /// `past`: writes past the caches, for much hair that is not read at once.
    Evaluator(const HairSources& sources, const GrownHairs& grown, Strands& strands, bool past)
        : m_sources(sources), m_grown(grown), m_strands(strands), m_mayPass(past) {}

    /// Up to sixteen hairs of one group, by place in `grown`.
    void make(const GroupTables& group, std::span<const std::uint32_t> which);
    /// Widths and colours of up to sixteen hairs of one group and their members.
    void setLook(const GroupTables& group, std::span<const std::uint32_t> which);

private:
    using Rows = std::array<LineVector, 3>;  // x, y, z: vertex v of lane l at [v * 16 + l]

    void take(const GroupTables& group, std::span<const std::uint32_t> which);
    void shape(const GroupTables& group);
    void modify(const GroupTables& group);
    void runStep(const GroupTables& group, const ModifierStep& step);
    void setNumbers(const ModifierStep& step);
    void keepOutside(const GroupTables& group);
    void endRows(const GroupTables& group);
    bool anyCut(const GroupTables& group) const;
    static void straightOn(Rows& rows, const GroupTables& group);
    void cutLane(Rows& rows, const GroupTables& group, std::size_t lane) const;
    void frame(std::size_t vertices);
    void makeMembers(const GroupTables& group);
    void storeStrand(const GroupTables& group, std::size_t lane);
    void store();
    void look(const GroupTables& group);
    void look(const GroupTables& group, std::size_t members, float* const* widths, float* const* colours, bool past);
    void taper(const GroupTables& group, std::size_t lane, float last, float* widths);

    const HairSources& m_sources;
    const GrownHairs& m_grown;
    Strands& m_strands;
    const bool m_mayPass;
    // The hairs in the lanes; those beyond m_count repeat the last one.
    std::size_t m_count = 0;
    std::uint32_t m_roots[lanes] = {};  // places in HairSources::roots
    std::uint32_t m_firstStrand[lanes] = {};
    const HairTraits* m_traits[lanes] = {};
    std::uint32_t m_vertices[lanes] = {};  // that the hair has
    float m_ends[lanes] = {};              // curve parameter that it is cut at, 0 to segments
    bool m_past = false;                   // to be written past the caches
    Shaper m_shaper;
    std::array<LineVector, 3> m_hairs;  // vertex v of lane l at [l * stride + v]
    std::vector<glm::vec3> m_points;
    Rows m_row, m_normal, m_u, m_v, m_w;
    LineVector m_strandRows, m_widths, m_colours, m_places;  // see makeMembers
    LineVector m_scratch;
    std::vector<float> m_numbers, m_tapers;
    float m_random[ModifierArrays::randomRows * lanes] = {};
    std::uint64_t m_keys[lanes] = {};   // of hairs for random numbers
    std::uint64_t m_locks[lanes] = {};  // of the last lock that gathered them, else that of the hair
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
