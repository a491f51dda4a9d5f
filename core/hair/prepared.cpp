// SPDX-License-Identifier: Apache-2.0
#include "core/hair/prepared.h"

#include "core/hair/batch.h"
#include "core/hair/changes.h"
#include "core/hair/thin.h"

#include <deque>
#include <new>

namespace whorl {
namespace {

Error tooLarge(std::uint32_t blockSize) {
    return {"A block of " + std::to_string(blockSize) + " hairs needs more memory than there is."};
}

}  // namespace

struct PreparedGroom::State {
    HairParts parts;
    HairLookups lookups;  // refer to parts.groom
    explicit State(HairParts made) : parts(std::move(made)), lookups(parts.groom) {}
};

PreparedGroom::PreparedGroom(std::unique_ptr<const State> state) : m_state(std::move(state)) {}
PreparedGroom::~PreparedGroom() = default;

Result<std::shared_ptr<const PreparedGroom>> PreparedGroom::make(const Groom& groom, Progress& progress,
                                                                 std::shared_ptr<const DistanceField> skin) {
    try {
        Result<RootSampler> sampler = RootSampler::build(groom, DensityLookup(groom), progress);
        if (!sampler) return sampler.error();
        HairParts parts{groom, {}, std::move(*sampler), GuideIndex(groom), GuideShapes(groom), {}, {}, -1.0};
        parts.clumps.build(groom, ModifierChain(groom), parts.index, parts.shapes, true, progress);
        countHairs(parts, {});
        if (wantsSkin(groom)) {
            if (!skin) skin = std::make_shared<const DistanceField>(DistanceField::build(*groom.mesh));
            parts.guard.emplace(std::move(skin));
        }
        if (progress.cancelled()) return cancelledError();
        return std::shared_ptr<const PreparedGroom>(new PreparedGroom(std::make_unique<const State>(std::move(parts))));
    } catch (const std::bad_alloc&) {
        return Error{"The groom needs more memory than there is."};
    }
}

const Groom& PreparedGroom::groom() const {
    return m_state->parts.groom;
}

Result<void> PreparedGroom::stream(const GenerateOptions& options, std::uint32_t blockSize,
                                   const std::function<bool(const Strands&)>& sink, Progress& progress) const {
    try {
        return streamMotion(
            options, {&options.time, 1}, blockSize,
            [&](std::span<const Strands* const> samples) { return sink(*samples[0]); }, progress);
    } catch (const std::bad_alloc&) {
        return tooLarge(blockSize);
    }
}

Result<void> PreparedGroom::streamMotion(const GenerateOptions& options, std::span<const float> times,
                                         std::uint32_t blockSize,
                                         const std::function<bool(std::span<const Strands* const>)>& sink,
                                         Progress& progress) const {
    try {
        const HairParts& parts = m_state->parts;
        std::deque<HairLookups> made;
        std::vector<const HairLookups*> lookups;
        for (const float time : times) {
            const bool still = time == 0.0f || !isAnimated(parts.groom);
            lookups.push_back(still ? &m_state->lookups : &made.emplace_back(parts.groom, time));
        }
        return whorl::streamMotion(parts, lookups, options, blockSize, sink, progress);
    } catch (const std::bad_alloc&) {
        return tooLarge(blockSize);
    }
}

Result<HairCount> PreparedGroom::count(const GenerateOptions& options, std::span<const float> times,
                                       Progress& progress) const {
    HairCount count;
    if (skipsVertices(m_state->parts.groom)) {
        const auto made = streamMotion(
            options, times, 4096,
            [&](std::span<const Strands* const> samples) {
                count.hairs += samples[0]->count();
                count.vertices += samples[0]->vertexCount();
                return true;
            },
            progress);
        if (!made) return made.error();
        return count;
    }
    try {
        return countBatches(m_state->parts, m_state->lookups, options, progress);
    } catch (const std::bad_alloc&) {
        return tooLarge(4096);
    }
}

bool PreparedGroom::animated() const {
    return isAnimated(m_state->parts.groom);
}

}  // namespace whorl
