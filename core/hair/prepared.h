// SPDX-License-Identifier: Apache-2.0
// A groom made ready once, for any number of threads that make its hair at once.
#pragma once

#include "core/hair/generate.h"
#include "core/surface/distance_field.h"

#include <memory>
#include <span>

namespace whorl {

struct HairCount {
    std::uint64_t hairs = 0;  ///< of a strand every one
    std::uint64_t vertices = 0;
};

/// Sampler, tree of guides and skin of one groom. Immutable: where a Generator follows edits in one thread, this serves
/// many threads with the hair of a groom that stays.
class PreparedGroom {
public:
    /// `skin`: that of the groom's mesh when it is at hand; made otherwise, and only when a group keeps outside.
    static Result<std::shared_ptr<const PreparedGroom>> make(const Groom& groom, Progress& progress,
                                                             std::shared_ptr<const DistanceField> skin = nullptr);
    ~PreparedGroom();
    PreparedGroom(const PreparedGroom&) = delete;
    PreparedGroom& operator=(const PreparedGroom&) = delete;

    const Groom& groom() const;

    /// See Generator::stream.
    Result<void> stream(const GenerateOptions& options, std::uint32_t blockSize,
                        const std::function<bool(const Strands&)>& sink, Progress& progress) const;

    /// The same hair at several times (that of `options` is not asked), for motion blur: `sink` gets one block once a
    /// time, the same hairs with the same numbers of vertices, also where vertices are skipped. At least one time.
    Result<void> streamMotion(const GenerateOptions& options, std::span<const float> times, std::uint32_t blockSize,
                              const std::function<bool(std::span<const Strands* const>)>& sink,
                              Progress& progress) const;

    /// Exact numbers of what streamMotion gives, of one of the times. Made without the hair unless it skips vertices.
    Result<HairCount> count(const GenerateOptions& options, std::span<const float> times, Progress& progress) const;

    /// True when times differ: frizz is animated.
    bool animated() const;

private:
    struct State;
    explicit PreparedGroom(std::unique_ptr<const State> state);
    std::unique_ptr<const State> m_state;
};

}  // namespace whorl
