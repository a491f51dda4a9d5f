// SPDX-License-Identifier: Apache-2.0
// Modifiers: the part of Evaluator that runs those of a group, sixteen hairs in lanes.
#include "core/hair/evaluator.h"
#include "core/hair/numbers.kernel.h"
#include "core/model/modifiers/rows.h"

#include <algorithm>

namespace whorl {

void Evaluator::modify(const GroupTables& group) {
    for (std::size_t l = 0; l < lanes; ++l)
        m_keys[l] = m_locks[l] = ModifierChain::hairKey(m_sources.roots[m_roots[l]].id);
    m_scratch.resize(ModifierArrays::scratchRows * group.vertices() * lanes);
    for (const ModifierStep& step : m_sources.chain.shapes(group.group)) runStep(group, step);
}

void Evaluator::setNumbers(const ModifierStep& step) {
    m_numbers.resize(step.numbers.size() * lanes);
    for (std::size_t r = 0; r < step.numbers.size(); ++r) {
        const ModifierNumber& number = step.numbers[r];
        float* row = &m_numbers[r * lanes];
        if (!number.map) {
            std::fill_n(row, lanes, number.value);
            continue;
        }
        for (std::size_t l = 0; l < lanes; ++l)
            row[l] = l < m_count ? number.at(m_sources.roots[m_roots[l]].uv) : row[m_count - 1];
    }
}

void Evaluator::runStep(const GroupTables& group, const ModifierStep& step) {
    const HairSources& s = m_sources;
    setNumbers(step);
    // Nothing to do where the map of the amount is black.
    if (std::all_of(&m_numbers[lanes], &m_numbers[2 * lanes], [](float amount) { return amount <= 0.0f; })) return;

    ModifierArrays arrays{};
    arrays.vertices = group.vertices();
    arrays.x = m_row[0].data();
    arrays.y = m_row[1].data();
    arrays.z = m_row[2].data();
    arrays.scratch = m_scratch.data();
    arrays.along = group.along.data();
    arrays.ease = group.ease.data();
    arrays.numbers = m_numbers.data();
    arrays.random = m_random;
    s.chain.noiseOffset(step, arrays.offset);
    for (std::uint32_t row = 0; row < step.randomRows; ++row) WHORL_PICK(randomNumbers)
    (s.chain.randomSeed(step), step.shared ? m_locks : m_keys, ModifierChain::channelOf(row), m_random + row * lanes);
    std::uint32_t first[lanes] = {};
    float weight[lanes] = {}, thickness[lanes];
    if (step.kind == modifierKindOf<ClumpParams>) {
        const ClumpCentres& centres = s.clumps.clumps[step.clump];
        if (centres.empty()) return;
        const std::vector<std::uint32_t>& nearest = s.centres[step.clump];
        const float* flyaways = &m_numbers[ClumpRows::Flyaways * lanes];
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::uint32_t centre = nearest[m_roots[l]];
            if (centre == ClumpCentres::none) continue;
            first[l] = centre * static_cast<std::uint32_t>(centres.stride);
            weight[l] = 1.0f;
            const bool gathered = m_random[l] >= flyaways[l] && m_numbers[lanes + l] > 0.0f;
            if (gathered) m_locks[l] = ModifierChain::lockKey(centres.roots[centre].id);
        }
        arrays.centreX = centres.x.data();
        arrays.centreY = centres.y.data();
        arrays.centreZ = centres.z.data();
    }
    for (std::size_t l = 0; l < lanes; ++l)
        thickness[l] = group.usualWidth > 0.0f ? m_traits[l]->thickness / group.usualWidth : 1.0f;
    arrays.centreFirst = first;
    arrays.centreWeight = weight;
    arrays.thickness = thickness;
    modifierKernel(step.kind)(arrays);
}

}  // namespace whorl
