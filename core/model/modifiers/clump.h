// SPDX-License-Identifier: Apache-2.0
// Parameters of the modifier that gathers hairs into locks.
#pragma once

#include "core/param/param.h"

#include <array>

namespace whorl {

inline constexpr std::array<std::string_view, 2> clumpCentreNames{"Scattered", "Guides"};

/// Hairs go to the curve of the nearest centre: one of a scattered set, or a guide.
struct ClumpParams {
    static constexpr BlockInfo info{"clump", "Clump", "Gathers hairs into locks."};

    Choice centres{};
    int count = 300;
    Driven density{1.0f};
    Driven tightness{0.85f};
    Driven rootTightness{0.0f};
    Driven profile{0.5f};
    Driven flyaways{0.03f};
    Driven noise{0.0f};
    Driven noiseFrequency{25.0f};
    bool keepLength = true;
    int seed = 0;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "centres",
                        .label = "Centres",
                        .tip = "Scattered: locks of their own number. Guides: a lock around every guide.",
                        .choices = clumpCentreNames},
              self.centres);
        visit(ParamInfo{.id = "count",
                        .label = "Locks",
                        .min = 1,
                        .max = 1e6,
                        .softMax = 5000,
                        .tip = "Scattered centres of this group. More only adds locks; those there are stay.",
                        .logarithmic = true},
              self.count);
        visit(ParamInfo{.id = "density", .label = "Lock density", .tip = "Share of the scattered centres that stand."},
              self.density);
        visit(ParamInfo{.id = "tightness", .label = "Tightness", .tip = "How far tips go to the middle of their lock."},
              self.tightness);
        visit(ParamInfo{.id = "root_tightness",
                        .label = "Tightness at the root",
                        .tip = "The same near the root. The root itself stays."},
              self.rootTightness);
        visit(ParamInfo{.id = "profile",
                        .label = "Profile",
                        .min = 0.02,
                        .max = 0.98,
                        .tip = "Low: locks close near the tip only. High: they close right above the root."},
              self.profile);
        visit(ParamInfo{.id = "flyaways",
                        .label = "Flyaways",
                        .unit = "%",
                        .shownScale = 100,
                        .tip = "Share of hairs that belong to no lock."},
              self.flyaways);
        visit(ParamInfo{.id = "noise",
                        .label = "Lock noise",
                        .max = 1,
                        .softMax = 0.02,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far whole locks stray."},
              self.noise);
        visit(ParamInfo{.id = "noise_frequency",
                        .label = "Lock noise frequency",
                        .max = 100000,
                        .softMax = 500,
                        .unit = "per metre",
                        .tip = "Noise waves a metre along a lock."},
              self.noiseFrequency);
        visit(ParamInfo{.id = "keep_length", .label = "Keep length", .tip = "Hairs keep their length in the lock."},
              self.keepLength);
        visit(ParamInfo{.id = "seed", .label = "Seed", .max = 1e6, .softMax = 100, .tip = "Other centres."}, self.seed);
    }
    bool operator==(const ClumpParams&) const = default;
};

}  // namespace whorl
