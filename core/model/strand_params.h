// SPDX-License-Identifier: Apache-2.0
// Parameters of strands: several hairs around each generated one.
#pragma once

#include "core/param/param.h"

namespace whorl {

/// Hairs around a base hair, which they take the place of (seed 000, section 4.2.2).
struct StrandParams {
    int hairs = 0;
    Driven rootSplay{0.0008f};
    Driven centreSplay{0.0016f};
    Driven tipSplay{0.0008f};
    Driven twist{0.0f};
    Driven offset{0.0f};
    Driven aspect{1.0f};
    Driven randomise{0.3f};

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "hairs",
                        .label = "Hairs a strand",
                        .max = 255,
                        .softMax = 30,
                        .tip = "Hairs that take the place of each hair. 0: hairs stay single."},
              self.hairs);
        const auto splay = [&](std::string_view id, std::string_view label, std::string_view tip, auto& value) {
            visit(
                ParamInfo{
                    .id = id, .label = label, .max = 1, .softMax = 0.01, .unit = "mm", .shownScale = 1000, .tip = tip},
                value);
        };
        splay("root_splay", "Root splay", "How far roots of a strand stand from its middle.", self.rootSplay);
        splay("centre_splay", "Centre splay", "How far a strand opens half way.", self.centreSplay);
        splay("tip_splay", "Tip splay", "How far tips of a strand are from its middle.", self.tipSplay);
        visit(ParamInfo{.id = "twist",
                        .label = "Twist",
                        .min = -125.6637062,
                        .max = 125.6637062,
                        .softMax = 12.56637062,
                        .unit = "degrees",
                        .shownScale = 57.29577951,
                        .tip = "Angle that hairs go around the middle of their strand from root to tip."},
              self.twist);
        visit(ParamInfo{.id = "offset",
                        .label = "Tip offset",
                        .min = -1,
                        .max = 1,
                        .softMax = 0.02,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Lifts tips along the normal of the hair: the last hair of a strand by all of it, the "
                               "others by less."},
              self.offset);
        visit(ParamInfo{.id = "aspect",
                        .label = "Aspect",
                        .min = 0.01,
                        .max = 100,
                        .softMax = 4,
                        .tip = "Breadth of a strand compared with its height. 1 is round."},
              self.aspect);
        visit(
            ParamInfo{
                .id = "randomise", .label = "Randomise", .tip = "0 spreads the hairs of a strand evenly, 1 at random."},
            self.randomise);
    }
    bool operator==(const StrandParams&) const = default;
};

}  // namespace whorl
