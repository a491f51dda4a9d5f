// SPDX-License-Identifier: Apache-2.0
// The members of strands: the part of Evaluator that turns a base hair into several.
#include "core/base/random.h"
#include "core/hair/evaluator.h"
#include "core/hair/members.kernel.h"
#include "core/hair/modifiers/turns.h"

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

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
void Evaluator::makeMembers(const GroupTables& group) {
    const std::size_t full = static_cast<std::size_t>(group.segments) + 1;
    for (Rows* all : {&m_u, &m_v, &m_w, &m_member, &m_memberNormal})
        for (std::vector<float>& row : *all) row.resize(lanes * (group.stride + 4));
    float splay[3][lanes], twist[lanes], offset[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        const HairTraits& t = *m_traits[l];
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
                            m_shaper.hairs().normalX,
                            m_shaper.hairs().normalY,
                            m_shaper.hairs().normalZ,
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
    for (Rows* all : {&m_row, &m_u, &m_v, &m_w, &m_normal}) {
        if (!anyCut(group)) {
            straightOn(*all, group);
        } else {
            for (std::size_t l = 0; l < lanes; ++l) cutLane(*all, group, l);
        }
    }
    const std::uint32_t most = *std::max_element(m_vertices, m_vertices + lanes);
    const auto seed = static_cast<std::uint32_t>(m_sources.groom.counts->seed);
    const auto channel = [](HairChannel of) { return static_cast<std::uint32_t>(of); };
    const std::uint32_t channels[3] = {channel(HairChannel::MemberRadius), channel(HairChannel::MemberTurn),
                                       channel(HairChannel::MemberLift)};
    std::uint32_t ids[lanes];
    float randomise[lanes], aspect[lanes], strandTurn[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        ids[l] = m_sources.roots[m_roots[l]].id;
        randomise[l] = m_traits[l]->memberRandomise;
        aspect[l] = m_traits[l]->memberAspect;
        strandTurn[l] = randomFloat(seed, ids[l], channel(HairChannel::StrandTurn));
    }
    for (std::uint32_t member = 0; member < group.members; ++member) {
        float across[lanes], up[lanes], lift[lanes];
        WHORL_PICK(memberPlaces)
        ({seed, ids, member, group.members, channels, randomise, aspect, strandTurn, across, up, lift});
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
        store(m_member, m_memberNormal, member);
    }
}

}  // namespace whorl
