// SPDX-License-Identifier: Apache-2.0
#include "core/hair/generate.h"

#include "core/hair/changes.h"
#include "core/hair/kept_hair.h"

#include <algorithm>
#include <new>

namespace whorl {
namespace {

// Above this many hairs nothing is kept for the next call: roots, neighbours and traits take a third of the hair's
// memory again.
constexpr double mostKept = 1 << 22;

Error tooLarge(std::uint64_t hairs) {
    return {std::to_string(hairs) +
            " hairs do not fit into memory at once; lower the number of hairs or make them in "
            "more parts."};
}

}  // namespace

struct Generator::State {
    HairParts parts;     // its groom is that of the last call that ended well
    bool valid = false;  // the parts belong together
    std::shared_ptr<const Surface> surface;
    KeptHair kept;  // by generate()
    float keptTime = 0.0f;

    HairChanges changes;  // by the newest groom, worked out by prepare()

    Result<void> prepare(const Groom& next, Progress& progress);
    Result<void> prepareSampler(const Groom& next, bool known, Progress& progress);
    void prepareClumps(bool scatterChanged, Progress& progress);
    void guardSkin();
};

// Brings sampler, index and shapes up to `next`, and notes what changed. Cancelled: everything is made anew next time.
Result<void> Generator::State::prepare(const Groom& next, Progress& progress) {
    const bool known = valid;
    valid = false;
    changes = HairChanges{};
    const Groom& before = parts.groom;
    const bool scatterChanged = !known || !sameGrowth(before, next);
    if (Result<void> ready = prepareSampler(next, known, progress); !ready) return ready;
    if (known) {
        changes.bindings = !sameBindings(before, next);
        changes.shapeMaps.emplace(before, next);
        changes.shape = !sameShapeParameters(before, next, &*changes.shapeMaps);
        changes.lookMaps.emplace(before, next);
        changes.look = !sameLookParameters(before, next, &*changes.lookMaps);
        changes.clumps = changes.density || changes.bindings || !changes.places.empty() || !sameClumps(before, next) ||
                         !sameSegments(before, next);
        changes.shapes = changes.bindings || !sameSegments(before, next);
    }
    changes.blocks.assign(next.guides.blockCount(), 1);
    for (std::size_t b = 0; !changes.shapes && b < changes.blocks.size(); ++b)
        changes.blocks[b] = !next.guides.blockSameAs(b, before.guides);

    changes.guides = changedGuides(before.guides, next.guides, changes.blocks);

    if (changes.bindings) parts.index = GuideIndex(next);
    if (changes.shapes) parts.shapes = GuideShapes(next);
    for (std::size_t b = 0; !changes.shapes && b < changes.blocks.size(); ++b)
        if (changes.blocks[b]) parts.shapes.update(next, b);
    if (!known || *before.counts != *next.counts) parts.countedFor = -1.0;
    parts.groom = next;
    prepareClumps(scatterChanged, progress);
    guardSkin();
    valid = !progress.cancelled();
    return {};
}

// Where only texels of maps differ, it is brought up to them.
Result<void> Generator::State::prepareSampler(const Groom& next, bool known, Progress& progress) {
    const DensityLookup density(next);
    TouchedMaps maps(parts.groom, next);
    changes.density = !known || !sameDensity(parts.groom, next, &maps);
    if (!changes.density && maps.empty()) return {};
    parts.countedFor = -1.0;
    if (!changes.density && parts.sampler.update(next, density, maps, changes.places)) return {};
    changes.density = true;
    const RootSampler* earlier = parts.groom.mesh.sameAs(next.mesh) ? &parts.sampler : nullptr;
    Result<RootSampler> built = RootSampler::build(next, density, progress, earlier);
    if (!built) {
        kept.drop();
        return built.error();
    }
    parts.sampler = std::move(*built);
    return {};
}

void Generator::State::prepareClumps(bool scatterChanged, Progress& progress) {
    const ModifierChain chain(parts.groom);
    if (chain.clumps().empty() && parts.clumps.clumps.empty()) {
        changes.clumps = false;
    } else if (changes.clumps) {
        parts.clumps.build(parts.groom, chain, parts.index, parts.shapes, scatterChanged, progress);
    } else if (std::any_of(changes.blocks.begin(), changes.blocks.end(), [](std::uint8_t b) { return b != 0; })) {
        parts.clumps.renew(parts.groom, chain, parts.shapes, changes.guides, changes.movedCentres);
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
        if (s.keptTime != options.time && isAnimated(groom)) s.changes.shape = true;
        s.keptTime = options.time;
        countHairs(s.parts, options);
        const HairWish wish = wishFor(s.parts, options);
        const HairLookups lookups(s.parts.groom, options.time);
        expected = expectedRoots({*groom.mesh, s.parts.sampler, lookups.density, wish.request}, wish.range) *
                   static_cast<double>(mostHairsOfRoot(groom));
        if (expected <= mostKept) {
            s.kept.renew(s.parts, lookups, wish, s.changes, progress);
            s.changes = HairChanges{};  // lets go of the maps of before
            if (progress.cancelled()) return cancelledError();
            progress.report(1.0f, "Growing hair");
            return s.kept.share(groom);
        }
        s.kept.clear();
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
        s.kept.drop();
        s.valid = false;
        return tooLarge(static_cast<std::uint64_t>(expected));
    }
}

Result<void> Generator::stream(const Groom& groom, const GenerateOptions& options, std::uint32_t blockSize,
                               const std::function<bool(const Strands&)>& sink, Progress& progress) {
    State& s = *m_state;
    try {
        // The kept hair does not follow this groom.
        s.kept.drop();
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
    m_state->kept.drop();
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
