// SPDX-License-Identifier: Apache-2.0
// The members of strands: the part of Evaluator that turns a base hair into several.
#include "core/base/polynomials.h"
#include "core/base/random.h"
#include "core/hair/evaluator.h"
#include "core/hair/members.kernel.h"
#include "core/hair/modifiers/turns.h"

#include <cmath>

namespace whorl {
namespace {

// One coordinate of a Catmull-Rom curve in a lane at `parameter`: see strandPoint.
float rowAt(const std::vector<float>& row, std::size_t lane, std::size_t points, float parameter) {
    constexpr std::size_t lanes = Evaluator::lanes;
    const std::size_t piece = std::min(static_cast<std::size_t>(parameter), points - 2);
    const float t = parameter - static_cast<float>(piece);
    const float a = row[(piece > 0 ? piece - 1 : 0) * lanes + lane], b = row[piece * lanes + lane],
                c = row[(piece + 1) * lanes + lane], d = row[std::min(piece + 2, points - 1) * lanes + lane];
    const float k1 = (c - a) * 0.5f, k2 = a - b * 2.5f + c * 2.0f - d * 0.5f, k3 = (d - a) * 0.5f + (b - c) * 1.5f;
    return b + (k1 + (k2 + k3 * t) * t) * t;
}

std::array<const float*, 3> pointers(const std::array<std::vector<float>, 3>& rows) {
    return {rows[0].data(), rows[1].data(), rows[2].data()};
}

}  // namespace

MemberPlace memberPlace(std::uint32_t seed, std::uint32_t hair, std::uint32_t member, std::uint32_t count,
                        float randomise, float aspect) {
    const auto random = [&](HairChannel channel) {
        return randomFloat(seed, (std::uint64_t{hair} << 8) | member, static_cast<std::uint32_t>(channel));
    };
    // A sunflower (Vogel 1979), turned at random for each strand as far as it is random at all.
    const float even = (static_cast<float>(member) + 0.5f) / static_cast<float>(count);
    const float area = even + randomise * (random(HairChannel::MemberRadius) - even);
    const float turn = 0.381966f * static_cast<float>(member) +
                       randomise * (random(HairChannel::MemberTurn) +
                                    randomFloat(seed, hair, static_cast<std::uint32_t>(HairChannel::StrandTurn)));
    const float radius = count > 1 || randomise > 0.0f ? std::sqrt(area) : 0.0f;
    const TurnSinCos at = sinCosOfTurns(turn);
    const float lift = even + randomise * (random(HairChannel::MemberLift) - even);
    return {radius * at.cos * aspect, radius * at.sin, lift};
}

// Members of the hairs in the lanes, whose whole curves and frames are there.
void Evaluator::makeMembers(const GroupTables& group, std::span<const std::uint32_t> which) {
    const std::size_t full = static_cast<std::size_t>(group.segments) + 1;
    for (Rows* all : {&m_u, &m_v, &m_w, &m_member, &m_memberNormal})
        for (std::vector<float>& row : *all) row.resize(lanes * (full + 2));
    float splay[3][lanes], twist[lanes], offset[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        const HairTraits& t = m_sources.traits[m_roots[std::min(l, which.size() - 1)]];
        for (int i = 0; i < 3; ++i) splay[i][l] = t.splay[i];
        twist[l] = t.twistTurns;
        offset[l] = t.memberOffset;
    }
    const MemberArrays axes{full,
                            m_row[0].data(),
                            m_row[1].data(),
                            m_row[2].data(),
                            m_normal[0].data(),
                            m_normal[1].data(),
                            m_normal[2].data(),
                            m_surfaceX,
                            m_surfaceY,
                            m_surfaceZ,
                            group.along.data(),
                            group.ease.data(),
                            splay[0],
                            splay[1],
                            splay[2],
                            twist,
                            offset,
                            {m_u[0].data(), m_u[1].data(), m_u[2].data()},
                            {m_v[0].data(), m_v[1].data(), m_v[2].data()},
                            {m_w[0].data(), m_w[1].data(), m_w[2].data()}};
    WHORL_PICK(strandAxes)(axes);
    std::size_t most = 0;
    for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t hair = std::min(l, which.size() - 1);
        cutRows(group, l, m_roots[hair]);
        const std::uint32_t strand = m_grown.firstStrand[which[hair]];
        most = std::max<std::size_t>(most, m_strands.firstVertex[strand + 1] - m_strands.firstVertex[strand]);
    }
    const auto seed = static_cast<std::uint32_t>(m_sources.groom.counts->seed);
    for (std::uint32_t member = 0; member < group.members; ++member) {
        float across[lanes], up[lanes], lift[lanes];
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::size_t root = m_roots[std::min(l, which.size() - 1)];
            const HairTraits& t = m_sources.traits[root];
            const MemberPlace place =
                memberPlace(seed, m_sources.roots[root].id, member, group.members, t.memberRandomise, t.memberAspect);
            across[l] = place.across;
            up[l] = place.up;
            lift[l] = place.lift;
        }
        const auto base = pointers(m_row), normal = pointers(m_normal), u = pointers(m_u), v = pointers(m_v),
                   w = pointers(m_w);
        const MemberPoints points{most,
                                  {base[0], base[1], base[2]},
                                  {normal[0], normal[1], normal[2]},
                                  {u[0], u[1], u[2]},
                                  {v[0], v[1], v[2]},
                                  {w[0], w[1], w[2]},
                                  across,
                                  up,
                                  lift,
                                  {m_member[0].data(), m_member[1].data(), m_member[2].data()},
                                  {m_memberNormal[0].data(), m_memberNormal[1].data(), m_memberNormal[2].data()}};
        WHORL_PICK(strandMembers)(points);
        for (std::size_t l = 0; l < which.size(); ++l)
            store(m_member, m_memberNormal, l, m_grown.firstStrand[which[l]] + member);
    }
}

// Cuts the base hair of a lane and all that members are made with, and lets them go straight on by one row.
void Evaluator::cutRows(const GroupTables& group, std::size_t lane, std::size_t root) {
    const std::size_t full = static_cast<std::size_t>(group.segments) + 1;
    const CutEnd end = cutEnd(m_sources.traits[root].cut, group.segments);
    const bool cut = end.parameter < static_cast<float>(group.segments);
    for (Rows* all : {&m_row, &m_u, &m_v, &m_w, &m_normal}) {
        for (std::vector<float>& row : *all) {
            const std::size_t last = (end.vertices - 1) * lanes + lane;
            if (cut) row[last] = rowAt(row, lane, full, end.parameter);
            for (std::size_t v = end.vertices; v < full + 2; ++v)
                row[v * lanes + lane] = 2.0f * row[last] - row[last - lanes];
        }
    }
}

}  // namespace whorl
