// SPDX-License-Identifier: Apache-2.0
// Hair of some roots with everything that it was made of: what the generator's callers share inside.
#pragma once

#include "core/hair/evaluate.h"
#include "core/hair/generate.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace whorl {

struct HairCount;  // see prepared.h

/// All that is derived from a groom before its first hair. Any number of threads may read it at once.
struct HairParts {
    Groom groom;
    std::optional<SkinGuard> guard;  ///< set when a group keeps outside
    RootSampler sampler;
    GuideIndex index;
    GuideShapes shapes;
    ClumpSet clumps;
    // The request for that number of hairs; see countHairs.
    RootRequest counted{};
    double countedFor = -1.0;
};

/// True when a group keeps its hair outside the skin.
bool wantsSkin(const Groom& groom);

/// What is asked for, besides the groom.
struct HairWish {
    RootRequest request;
    RootRange range;
    float lod = 1.0f;
    bool operator==(const HairWish&) const = default;
};
HairWish wishFor(const HairParts& parts, const GenerateOptions& options);

/// Keeps the request for the number of hairs in `options`, which takes time, so that wishFor need not make it.
void countHairs(HairParts& parts, const GenerateOptions& options);

/// What parameters and maps say; made from the groom of the parts that it is used with.
struct HairLookups {
    DensityLookup density;
    TraitLookup traits;
    ModifierChain chain;
    explicit HairLookups(const Groom& groom, float time = 0.0f) : density(groom), traits(groom, time), chain(groom) {}
};

/// Roots have slots in these arrays. A batch that was grown at once has them in order of the curve; dabs leave slots
/// and take others (see batch_edit.h), and `order` lists those in use.
struct Batch {
    std::vector<HairRoot> roots;
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> free;
    std::vector<std::uint32_t> gone;  // free from the next edit on
    /// All roots, as they are.
    void inOrder();
    Bindings bindings;
    TraitList traits;
    CentresOfHairs centres;
    GrownHairs grown;
    std::shared_ptr<Strands> strands = std::make_shared<Strands>();

    HairSources sourcesOf(const HairParts& parts, const HairLookups& lookups) const {
        return sourcesOf(parts, lookups, traits);
    }
    /// With other traits: those of another time.
    HairSources sourcesOf(const HairParts& parts, const HairLookups& lookups, const TraitList& others) const {
        return {parts.groom,
                roots,
                bindings,
                others,
                parts.shapes,
                lookups.traits.kinkOffset(),
                parts.guard ? &*parts.guard : nullptr,
                lookups.chain,
                parts.clumps,
                centres,
                order};
    }
};

/// Most hairs that a root gives: those of the largest strand, else 1.
std::size_t mostHairsOfRoot(const Groom& groom);

/// 0, 1, 2 ... one a hair: for evaluateHairs.
std::vector<std::uint32_t> allOf(const GrownHairs& grown);

/// Traits of all roots at a level of detail (some left unset when cancelled). `old` gives its memory and, where
/// `coloursKnown`, the colours of the same roots.
TraitList traitsFor(const TraitLookup& lookup, std::span<const HairRoot> roots, float lod, Progress& progress,
                    TraitList old = {}, bool coloursKnown = false);

/// All of the hair of `batch.roots`, which are in order. Unfinished when cancelled.
void growBatch(const HairParts& parts, const HairLookups& lookups, float lod, Batch& batch, Progress& progress);

/// See Generator::stream.
Result<void> streamBatches(const HairParts& parts, const HairLookups& lookups, const GenerateOptions& options,
                           std::uint32_t blockSize, const std::function<bool(const Strands&)>& sink,
                           Progress& progress);

/// Takes one block of hair, once a motion sample: the same hairs with the same numbers of vertices.
using MotionSink = std::function<bool(std::span<const Strands* const> samples)>;

/// The same at several times, at least one: those that `times` were made for (that of `options` is not asked).
Result<void> streamMotion(const HairParts& parts, std::span<const HairLookups* const> times,
                          const GenerateOptions& options, std::uint32_t blockSize, const MotionSink& sink,
                          Progress& progress);

/// Numbers of the hair that streamBatches gives before it leaves out vertices, without making it.
Result<HairCount> countBatches(const HairParts& parts, const HairLookups& lookups, const GenerateOptions& options,
                               Progress& progress);

}  // namespace whorl
