// SPDX-License-Identifier: Apache-2.0
// Hair of one range with everything that it was made of: what the generator's callers share inside.
#pragma once

#include "core/hair/evaluate.h"
#include "core/hair/generate.h"

#include <memory>
#include <optional>
#include <vector>

namespace whorl {

/// All that is derived from a groom before its first hair. Any number of threads may read it at once.
struct HairParts {
    Groom groom;
    std::optional<SkinGuard> guard;  ///< set when a group keeps outside
    SubTriangleSampler sampler;
    GuideIndex index;
    GuideShapes shapes;
};

/// True when a group keeps its hair outside the skin.
bool wantsSkin(const Groom& groom);

/// `options.hairCount`, or that of the groom.
std::uint32_t hairCountOf(const Groom& groom, const GenerateOptions& options);

/// What parameters and maps say; made from the groom of the parts that it is used with.
struct HairLookups {
    DensityLookup density;
    TraitLookup traits;
    explicit HairLookups(const Groom& groom) : density(groom), traits(groom) {}
};

struct Batch {
    HairRange range;
    std::vector<HairRoot> roots;
    Bindings bindings;
    std::vector<HairTraits> traits;
    std::vector<std::uint32_t> grown;
    std::shared_ptr<Strands> strands = std::make_shared<Strands>();

    HairSources sourcesOf(const HairParts& parts, const TraitLookup& lookup) const {
        return {parts.groom,
                roots,
                bindings,
                traits,
                parts.shapes,
                lookup.kinkOffset(),
                parts.guard ? &*parts.guard : nullptr};
    }
};

/// 0, 1, 2 ... one a strand: for evaluateHairs.
std::vector<std::uint32_t> allOf(const Strands& strands);

/// Everything of `batch.range` from nothing; `count` hairs in the whole groom. Unfinished when cancelled.
void makeBatch(const HairParts& parts, const HairLookups& lookups, std::uint32_t count, Batch& batch,
               Progress& progress);

/// See Generator::stream.
Result<void> streamBatches(const HairParts& parts, const HairLookups& lookups, const GenerateOptions& options,
                           std::uint32_t blockSize, const std::function<bool(const Strands&)>& sink,
                           Progress& progress);

}  // namespace whorl
