// SPDX-License-Identifier: Apache-2.0
#include "core/hair/prepared.h"

#include "core/hair/batch.h"
#include "core/hair/changes.h"

#include <new>

namespace whorl {

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
        const HairParts& parts = m_state->parts;
        if (options.time != 0.0f && isAnimated(parts.groom)) {
            const HairLookups then(parts.groom, options.time);
            return streamBatches(parts, then, options, blockSize, sink, progress);
        }
        return streamBatches(parts, m_state->lookups, options, blockSize, sink, progress);
    } catch (const std::bad_alloc&) {
        return Error{"A block of " + std::to_string(blockSize) + " hairs needs more memory than there is."};
    }
}

}  // namespace whorl
