// SPDX-License-Identifier: Apache-2.0
// The members of strands: the part of Evaluator that turns a base hair into several.
#include "core/base/random.h"
#include "core/hair/evaluator.h"
#include "core/hair/members.kernel.h"
#include "core/hair/modifiers/turns.h"
#include "core/hair/strand_members.kernel.h"

#include <algorithm>
#include <cmath>

namespace whorl {
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
    for (Rows* all : {&m_u, &m_v, &m_w})
        for (LineVector& row : *all) row.resize(lanes * (group.stride + 4));
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
    // Widths and colours of the hairs, which their members share.
    const std::size_t stride = group.stride;
    m_widths.resize(lanes * stride);
    m_colours.resize(4 * lanes * stride);
    float *widths[lanes], *colours[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        widths[l] = &m_widths[l * stride];
        colours[l] = &m_colours[4 * l * stride];
    }
    look(group, 1, widths, colours, false);
    RowArrays rows{};
    rows.stride = stride;
    std::size_t next = 0;
    for (const Rows* all : {&m_row, &m_u, &m_v, &m_w, &m_normal})
        for (const LineVector& row : *all) rows.in[next++] = row.data();
    m_strandRows.resize(RowArrays::hairs * StrandRows::size(stride));
    rows.out = m_strandRows.data();
    for (std::size_t l = 0; l < m_count; ++l) {
        if (l % RowArrays::hairs == 0) {
            rows.lane = l;
            WHORL_PICK(strandRows)(rows);
        }
        storeStrand(group, l);
    }
}

// The members of the hair in one lane, whose rows, widths and colours are there.
void Evaluator::storeStrand(const GroupTables& group, std::size_t lane) {
    const auto channel = [](HairChannel of) { return static_cast<std::uint32_t>(of); };
    const std::uint32_t channels[3] = {channel(HairChannel::MemberRadius), channel(HairChannel::MemberTurn),
                                       channel(HairChannel::MemberLift)};
    const auto seed = static_cast<std::uint32_t>(m_sources.groom.counts->seed);
    const std::uint32_t id = m_sources.roots[m_roots[lane]].id;
    const HairTraits& t = *m_traits[lane];
    m_places.resize(3 * ((group.members + lanes - 1) / lanes * lanes));
    const std::size_t places = m_places.size() / 3;
    float *const across = m_places.data(), *const up = across + places, *const lift = up + places;
    WHORL_PICK(memberPlaces)
    ({seed, id, group.members, channels, t.memberRandomise, t.memberAspect,
      randomFloat(seed, id, channel(HairChannel::StrandTurn)), across, up, lift});
    const std::size_t first = m_strands.firstVertex[m_firstStrand[lane]];
    WHORL_PICK(strandMembers)
    ({m_vertices[lane], &m_strandRows[lane % RowArrays::hairs * StrandRows::size(group.stride)], group.members, across,
      up, lift, &m_widths[lane * group.stride], &m_colours[4 * lane * group.stride], &m_strands.positions[first].x,
      &m_strands.normals[first].x, &m_strands.widths[first], &m_strands.colours[first].x, m_past});
}

}  // namespace whorl
