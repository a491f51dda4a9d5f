// SPDX-License-Identifier: Apache-2.0
// What a RIB asks for: the parameters of a procedural primitive.
#pragma once

#include "core/procedural/procedural_groom.h"
#include "core/procedural/ri.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// In RIB, for the classic interface and for Procedural2:
//
//     Procedural "DynamicLoad" ["libwhorl_procedural.so" "head.groom part=0 frame=12 shutter=0,0.5"] [box]
//     Procedural2 "DynamicLoad" "SimpleBound" "float[6] __bound" [box] "string __dsoname" ["libwhorl_procedural.so"]
//         "string package" ["head.groom"] "int part" [0] "float frame" [12] "float[2] shutter" [0 0.5]
//
// Words of the classic text are separated by spaces; what holds spaces stands in single quotes ('my head.groom',
// overrides='{"counts/hairs": 1000}').

namespace whorl::procedural {

struct RiRequest {
    std::string package;
    std::string overrides;
    std::optional<std::uint32_t> part;  ///< without it the whole groom
    std::uint32_t parts = 0;            ///< 0: those of the package
    float frame = 0.0f;
    float framesPerSecond = 0.0f;  ///< 0: the package's, or 24
    /// Of the RIB's Shutter, in frames from `frame`: with it, hair that moves gets `samples` motion samples.
    std::optional<std::array<float, 2>> shutter;
    int samples = 2;
    float share = 1.0f;
    float lod = 1.0f;  ///< how soon distance makes hairs fewer: 2 half as soon, 0 never
};

/// A sentence when a word is not known or its value makes no sense.
Result<RiRequest> parseRequest(std::string_view text);
Result<RiRequest> parseRequest(RtInt n, const RtToken* tokens, const RtPointer* values);

/// The request as the C interface takes it.
struct RiWish {
    WhorlRequest request{};
    std::vector<float> hairTimes;    ///< seconds; request.times points there
    std::vector<float> motionTimes;  ///< of the RIB's motion block; none without one
};
RiWish wishOf(const RiRequest& request, const WhorlGroom& groom);

/// The groom that all primitives of a file share while one of them lives, opened when it is first needed. Any thread.
class SharedGroom {
public:
    /// A file that has changed since is another groom.
    static std::shared_ptr<SharedGroom> of(const RiRequest& request);
    /// The groom, or a sentence in `error`. The first call opens it, others wait.
    const WhorlGroom* get(WhorlStatus& status, WhorlError& error);
    ~SharedGroom();

private:
    struct State;
    explicit SharedGroom(std::unique_ptr<State> state);
    std::unique_ptr<State> m_state;
};

}  // namespace whorl::procedural
