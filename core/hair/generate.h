// SPDX-License-Identifier: Apache-2.0
// The one generator: what is shown, exported, tested and rendered comes out of here.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/hair/strands.h"
#include "core/model/groom.h"
#include "core/sampling/root_sampler.h"
#include "core/surface/surface.h"

#include <functional>
#include <memory>
#include <optional>

namespace whorl {

struct GenerateOptions {
    /// Instead of counts.hairs: about this many, a part of those where they are fewer. See requestFor.
    std::optional<std::uint32_t> hairCount{};
    std::uint32_t part = 0;  ///< 0 to partCount - 1; parts are compact pieces of the surface
    std::uint32_t partCount = 1;
    /// Level of detail: this share of the hairs, 0 to 1, a subset of all, and as much wider as they are fewer.
    float lod = 1.0f;
    float time = 0.0f;  ///< seconds, for animated frizz
    bool operator==(const GenerateOptions&) const = default;
};

/// Turns grooms into hair, neighbours after neighbours, and keeps what the next call can use again: sampler, roots,
/// bindings of hairs to guides. Per hair (seed 000, section 4.2.2): root sample, cut, group, interpolation from the
/// nearest guides of the group (KD-tree, Shepard weights), scale, frizz, kink, modifiers in the group's order, keeping
/// outside, colour, opacity, width, strands, cut, normals by double reflection, skipped vertices. A hair whose cut is
/// zero, or for which there are no guides (all beyond partings), is left out; ids keep their gaps. The same groom, seed
/// and options give the same bytes on any number of threads, any split and any SIMD level. One thread at a time; use
/// one Generator a thread.
class Generator {
public:
    Generator();
    ~Generator();
    Generator(Generator&&) noexcept;
    Generator& operator=(Generator&&) noexcept;

    /// The whole part in memory.
    Result<Strands> generate(const Groom& groom, const GenerateOptions& options, Progress& progress);

    /// The same without a copy: what is given is kept for the next call as well, and copied then only if somebody still
    /// holds it and only part of it changes. It never changes while it is held, and may be let go of in any thread.
    /// Right for whoever shows the hair of each step of an edit.
    Result<std::shared_ptr<const Strands>> generateShared(const Groom& groom, const GenerateOptions& options,
                                                          Progress& progress);

    /// In blocks of at most `blockSize` hairs (a strand stays whole), in the same order, with constant memory: `sink`
    /// gets each block once, from the calling thread, and returns false to stop (the call then gives cancelledError()).
    Result<void> stream(const Groom& groom, const GenerateOptions& options, std::uint32_t blockSize,
                        const std::function<bool(const Strands&)>& sink, Progress& progress);

    /// The piece of the surface that a part grows on. Fails only when cancelled.
    Result<RootRange> rangeOfPart(const Groom& groom, std::uint32_t part, std::uint32_t partCount, Progress& progress);

    /// Uses (and shares) a surface that the caller has already.
    void setSurface(std::shared_ptr<const Surface> surface);

private:
    struct State;
    std::unique_ptr<State> m_state;
};

/// Digest of all hair of the groom: equal for any `parts` and any number of threads. `surface`: that of the groom's
/// mesh when it is at hand.
Result<std::uint64_t> hairDigest(const Groom& groom, std::uint32_t parts, std::optional<std::uint32_t> hairCount,
                                 Progress& progress, std::shared_ptr<const Surface> surface = nullptr);

}  // namespace whorl
