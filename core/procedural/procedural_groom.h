// SPDX-License-Identifier: Apache-2.0
// What a WhorlGroom is: a groom that is ready to be made into hair, and what its package knows already.
#pragma once

#include "core/hair/prepared.h"
#include "core/io/package.h"
#include "core/procedural/whorl_procedural.h"

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What is seen from outside does not change once it is opened: any thread.
struct WhorlGroom {
    whorl::Groom groom;
    bool animated = false;
    /// Those of the package; none when their numbers do not hold (overrides) or were never made (documents).
    std::vector<whorl::PackagePart> parts;
    whorl::PackageFrames frames;
    std::uint32_t partCount = 1;
    std::vector<std::string> warnings;
    float meanWidth = 0.0f;  ///< metres, of an average hair without its maps

    /// What all hair needs. Made when it is first asked for, in as many threads as there are; others wait. A stored box
    /// or count needs none of it.
    whorl::Result<const whorl::PreparedGroom*> prepared() const;

private:
    mutable std::mutex m_mutex;
    mutable std::shared_ptr<const whorl::PreparedGroom> m_prepared;
};

namespace whorl::procedural {

/// `overrides` may be empty. Faults of the overrides are told as such (`badArgument`), all else is the file's.
struct OpenFault {
    bool badArgument = false;
};
Result<std::unique_ptr<WhorlGroom>> openGroom(const std::string& path, std::string_view overrides, OpenFault& fault);
Result<std::unique_ptr<WhorlGroom>> openGroom(std::span<const std::uint8_t> document, std::string_view overrides,
                                              OpenFault& fault);

/// A request that was checked: its part is there, its numbers are finite and in range.
struct Wish {
    GenerateOptions options;
    std::vector<float> times;  ///< at least one
    std::uint32_t blockHairs = 4096;
    bool oneThread = false;
};
/// Refuses with a sentence what makes no sense.
Result<Wish> checkedWish(const WhorlGroom& groom, const WhorlRequest& request);

/// What the package stores for the wish, or null.
const Bounds* storedBounds(const WhorlGroom& groom, const Wish& wish, float time);
const PackagePart* storedPart(const WhorlGroom& groom, const Wish& wish);

/// Makes the hair of a wish; see PreparedGroom::streamMotion.
Result<void> streamHair(const WhorlGroom& groom, const Wish& wish,
                        const std::function<bool(std::span<const Strands* const>)>& sink);
/// See whorl_count.
Result<HairCount> countHair(const WhorlGroom& groom, const Wish& wish);

/// See whorl_box.
Result<Bounds> boundsOf(const WhorlGroom& groom, const Wish& wish);

/// See whorl_share_for_scale and whorl_share_for_pixels.
float shareForScale(const WhorlGroom& groom, float pixelsPerMetre);
float shareForPixels(const WhorlGroom& groom, const Bounds& box, float pixels);

}  // namespace whorl::procedural
