// SPDX-License-Identifier: Apache-2.0
#include "core/hair/generate.h"

#include "core/base/cow.h"
#include "core/hair/batch.h"
#include "core/hair/changes.h"
#include "core/hair/thin.h"

#include <algorithm>
#include <new>

namespace whorl {
namespace {

// Above this many hairs nothing is kept for the next call: it would cost more memory than the hair.
constexpr double mostKept = 1 << 20;

Error tooLarge(std::uint64_t hairs) {
    return {std::to_string(hairs) +
            " hairs do not fit into memory at once; lower the number of hairs or make them in "
            "more parts."};
}

// Above this many bytes of hair no memory is kept for the next copy.
constexpr std::size_t mostSpare = std::size_t{256} << 20;

}  // namespace

struct Generator::State {
    HairParts parts;     // its groom is that of the last call that ended well
    bool valid = false;  // the parts belong together
    std::shared_ptr<const Surface> surface;

    // Hair kept by generate().
    bool batchValid = false;
    HairWish batchWish;
    float batchTime = 0.0f;
    Batch batch;
    std::shared_ptr<const Strands> thin;  // of `batch.strands` without skipped vertices, or null
    std::shared_ptr<Strands> spare;  // what was shared before `batch.strands`; used again when nobody holds it any more

    // What the newest groom changed, worked out by prepare().
    bool densityChanged = true;
    bool bindingsChanged = true;
    bool shapeChanged = true;  // by parameters, of every hair
    bool lookChanged = true;
    bool shapesRebuilt = true;
    bool clumpsRebuilt = true;
    std::vector<std::uint8_t> changedBlocks;
    std::vector<std::vector<std::uint8_t>> movedCentres;  // one list a clump

    Result<void> prepare(const Groom& next, Progress& progress);
    void prepareClumps(bool scatterChanged, Progress& progress);
    std::vector<std::uint8_t> changedGuides() const;
    void guardSkin();

    void ownStrands(bool keep);
    void renewBatch(const HairLookups& lookups, const HairWish& wish, Progress& progress);
    std::vector<std::uint32_t> hairsOfChangedGuides() const;
};

// Brings sampler, index and shapes up to `next`, and notes what changed. Cancelled: everything is made anew next time.
Result<void> Generator::State::prepare(const Groom& next, Progress& progress) {
    const bool known = valid;
    const Groom& groom = parts.groom;
    valid = false;
    densityChanged = !known || !sameDensity(groom, next);
    bindingsChanged = !known || !sameBindings(groom, next);
    shapeChanged = !known || !sameShapeParameters(groom, next);
    lookChanged = !known || !sameLookParameters(groom, next);
    const bool scatterChanged = densityChanged;
    clumpsRebuilt = densityChanged || bindingsChanged || !sameClumps(groom, next) || !sameSegments(groom, next);
    shapesRebuilt = !known || bindingsChanged || !sameSegments(groom, next);
    changedBlocks.assign(next.guides.blockCount(), 1);
    for (std::size_t b = 0; !shapesRebuilt && b < changedBlocks.size(); ++b)
        changedBlocks[b] = !next.guides.blockSameAs(b, groom.guides);

    if (densityChanged) {
        const RootSampler* earlier = groom.mesh.sameAs(next.mesh) ? &parts.sampler : nullptr;
        Result<RootSampler> built = RootSampler::build(next, DensityLookup(next), progress, earlier);
        if (!built) {
            batchValid = false;
            return built.error();
        }
        parts.sampler = std::move(*built);
    }
    if (bindingsChanged) parts.index = GuideIndex(next);
    if (shapesRebuilt) parts.shapes = GuideShapes(next);
    for (std::size_t b = 0; !shapesRebuilt && b < changedBlocks.size(); ++b)
        if (changedBlocks[b]) parts.shapes.update(next, b);
    if (densityChanged || *groom.counts != *next.counts) parts.countedFor = -1.0;
    parts.groom = next;
    prepareClumps(scatterChanged, progress);
    guardSkin();
    valid = !progress.cancelled();
    return {};
}

void Generator::State::prepareClumps(bool scatterChanged, Progress& progress) {
    const ModifierChain chain(parts.groom);
    movedCentres.clear();
    if (clumpsRebuilt) {
        parts.clumps.build(parts.groom, chain, parts.index, parts.shapes, scatterChanged, progress);
    } else if (!chain.clumps().empty() && std::any_of(changedBlocks.begin(), changedBlocks.end(),
                                                      [](std::uint8_t changed) { return changed != 0; })) {
        parts.clumps.renew(parts.groom, chain, parts.shapes, changedGuides(), movedCentres);
    }
}

void Generator::State::guardSkin() {
    if (surface && !surface->shared.sameAs(parts.groom.mesh)) surface.reset();
    if (!wantsSkin(parts.groom)) {
        parts.guard.reset();
        return;
    }
    if (!surface) surface = std::make_shared<Surface>(parts.groom.mesh);
    if (!parts.guard || &parts.guard->skin() != &surface->skin()) parts.guard.emplace(surface->sharedSkin());
}

std::vector<std::uint8_t> Generator::State::changedGuides() const {
    const Groom& groom = parts.groom;
    std::vector<std::uint8_t> changed(groom.guides.count(), 0);
    for (std::size_t b = 0; b < changedBlocks.size(); ++b) {
        if (!changedBlocks[b]) continue;
        std::fill_n(changed.begin() + static_cast<std::ptrdiff_t>(groom.guides.firstOfBlock(b)),
                    groom.guides.block(b).count(), std::uint8_t{1});
    }
    return changed;
}

// Those that a changed guide shapes, or the middle of whose lock has moved.
std::vector<std::uint32_t> Generator::State::hairsOfChangedGuides() const {
    const std::vector<std::uint8_t> changed = changedGuides();
    std::vector<std::uint32_t> which;
    const Bindings& bindings = batch.bindings;
    for (std::uint32_t i = 0; i < batch.grown.count(); ++i) {
        const std::size_t hair = batch.grown.roots[i];
        const std::uint32_t* guides = &bindings.guides[hair * bindings.perHair];
        bool touched =
            std::any_of(guides, guides + bindings.counts[hair], [&](std::uint32_t g) { return changed[g] != 0; });
        for (std::size_t c = 0; !touched && c < movedCentres.size(); ++c) {
            const std::uint32_t centre = batch.centres[c][hair];
            touched = centre != ClumpCentres::none && movedCentres[c][centre] != 0;
        }
        if (touched) which.push_back(i);
    }
    return which;
}

// Makes batch.strands writable. Somebody holds them: writes go to other memory, with the same content if `keep`.
void Generator::State::ownStrands(bool keep) {
    if (batch.strands.use_count() == 1) {
        acquireSole(batch.strands);
        return;
    }
    std::shared_ptr<Strands> other;
    if (spare && spare.use_count() == 1) {
        acquireSole(spare);
        other = std::move(spare);
    } else {
        other = std::make_shared<Strands>();
    }
    if (keep) *other = *batch.strands;
    spare = batch.strands->bytes() <= mostSpare ? batch.strands : nullptr;
    batch.strands = std::move(other);
}

// The kept batch brought up to date: only what the change touches is made again.
void Generator::State::renewBatch(const HairLookups& lookups, const HairWish& wish, Progress& progress) {
    const bool rootsKept = batchValid && !densityChanged && batchWish == wish;
    batchValid = false;
    batchWish = wish;
    const Groom& groom = parts.groom;
    if (!rootsKept) {
        thin.reset();
        ownStrands(false);
        const RootSource source{*groom.mesh, parts.sampler, lookups.density, wish.request};
        batch.roots = makeRoots(source, wish.range, progress);
        growBatch(parts, lookups, wish.lod, batch, progress);
        batchValid = !progress.cancelled();
        return;
    }
    if (bindingsChanged)
        batch.bindings = bindHairs(groom, parts.index, batch.roots, progress, std::move(batch.bindings));
    if (shapeChanged || lookChanged) batch.traits = traitsFor(lookups.traits, batch.roots, wish.lod, progress);
    if (clumpsRebuilt) batch.centres = centresOf(lookups.chain, parts.clumps, batch.roots, progress);
    if (progress.cancelled()) return;
    const HairSources sources = batch.sourcesOf(parts, lookups);
    const bool all = bindingsChanged || shapeChanged || shapesRebuilt || clumpsRebuilt;
    const std::vector<std::uint32_t> some = all ? std::vector<std::uint32_t>{} : hairsOfChangedGuides();
    if (all || lookChanged || !some.empty()) {
        thin.reset();
        ownStrands(!all);
    }
    Strands& strands = *batch.strands;
    if (all) batch.grown = layOut(sources, strands);
    if (!all && lookChanged) renewLook(sources, batch.grown, strands);
    evaluateHairs(sources, batch.grown, all ? allOf(batch.grown) : some, strands, progress);
    batchValid = !progress.cancelled();
}

Generator::Generator() : m_state(std::make_unique<State>()) {}
Generator::~Generator() = default;
Generator::Generator(Generator&&) noexcept = default;
Generator& Generator::operator=(Generator&&) noexcept = default;

void Generator::setSurface(std::shared_ptr<const Surface> surface) {
    m_state->surface = std::move(surface);
}

Result<Strands> Generator::generate(const Groom& groom, const GenerateOptions& options, Progress& progress) {
    Result<std::shared_ptr<const Strands>> shared = generateShared(groom, options, progress);
    if (!shared) return shared.error();
    try {
        return **shared;
    } catch (const std::bad_alloc&) {
        return tooLarge((*shared)->count());
    }
}

Result<std::shared_ptr<const Strands>> Generator::generateShared(const Groom& groom, const GenerateOptions& options,
                                                                 Progress& progress) {
    using Shared = std::shared_ptr<const Strands>;
    State& s = *m_state;
    double expected = 0.0;
    try {
        if (Result<void> ready = s.prepare(groom, progress); !ready) return ready.error();
        if (s.batchTime != options.time && isAnimated(groom)) s.shapeChanged = true;
        s.batchTime = options.time;
        countHairs(s.parts, options);
        const HairWish wish = wishFor(s.parts, options);
        const HairLookups lookups(s.parts.groom, options.time);
        expected = expectedRoots({*groom.mesh, s.parts.sampler, lookups.density, wish.request}, wish.range) *
                   static_cast<double>(mostHairsOfRoot(groom));
        if (expected <= mostKept) {
            s.renewBatch(lookups, wish, progress);
            if (progress.cancelled()) return cancelledError();
            progress.report(1.0f, "Growing hair");
            if (!skipsVertices(groom)) return Shared(s.batch.strands);
            if (!s.thin) s.thin = std::make_shared<const Strands>(thinned(*s.batch.strands, groom));
            return s.thin;
        }
        s.batchValid = false;
        s.batch = Batch{};
        s.spare.reset();
        s.thin.reset();
        auto all = std::make_shared<Strands>();
        bool full = false;
        Result<void> streamed = stream(
            groom, options, 1u << 16,
            [&](const Strands& block) {
                // Vertices are counted in 32 bits.
                full = all->vertexCount() + block.vertexCount() > UINT32_MAX;
                if (!full) all->append(block);
                return !full;
            },
            progress);
        if (full) return tooLarge(static_cast<std::uint64_t>(expected));
        if (!streamed) return streamed.error();
        return Shared(std::move(all));
    } catch (const std::bad_alloc&) {
        s.batchValid = false;
        s.valid = false;
        return tooLarge(static_cast<std::uint64_t>(expected));
    }
}

Result<void> Generator::stream(const Groom& groom, const GenerateOptions& options, std::uint32_t blockSize,
                               const std::function<bool(const Strands&)>& sink, Progress& progress) {
    State& s = *m_state;
    try {
        // The kept hair does not follow this groom.
        s.batchValid = false;
        if (Result<void> ready = s.prepare(groom, progress); !ready) return ready.error();
        countHairs(s.parts, options);
        return streamBatches(s.parts, HairLookups(s.parts.groom, options.time), options, blockSize, sink, progress);
    } catch (const std::bad_alloc&) {
        s.valid = false;
        return tooLarge(blockSize);
    }
}

Result<RootRange> Generator::rangeOfPart(const Groom& groom, std::uint32_t part, std::uint32_t partCount,
                                         Progress& progress) {
    m_state->batchValid = false;
    if (Result<void> ready = m_state->prepare(groom, progress); !ready) return ready.error();
    return m_state->parts.sampler.part(part, partCount);
}

Result<std::uint64_t> hairDigest(const Groom& groom, std::uint32_t parts, std::optional<std::uint32_t> hairCount,
                                 Progress& progress, std::shared_ptr<const Surface> surface) {
    Hasher hasher;
    Generator generator;
    generator.setSurface(std::move(surface));
    GenerateOptions options;
    options.hairCount = hairCount;
    options.partCount = std::max(parts, 1u);
    for (options.part = 0; options.part < options.partCount; ++options.part) {
        const Result<void> made = generator.stream(
            groom, options, 1u << 14,
            [&](const Strands& block) {
                block.addTo(hasher);
                return true;
            },
            progress);
        if (!made) return made.error();
    }
    return hasher.digest();
}

}  // namespace whorl
