// SPDX-License-Identifier: Apache-2.0
// A groom made ready once, for any number of threads that make its hair at once.
#pragma once

#include "core/hair/generate.h"
#include "core/surface/distance_field.h"

#include <memory>

namespace whorl {

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

private:
    struct State;
    explicit PreparedGroom(std::unique_ptr<const State> state);
    std::unique_ptr<const State> m_state;
};

}  // namespace whorl
