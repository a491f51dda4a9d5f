// SPDX-License-Identifier: Apache-2.0
// Parameters of the modifier that changes widths along hairs.
#pragma once

#include "core/param/param.h"

namespace whorl {

/// Multiplies widths along the hair. Moves nothing.
struct TaperParams {
    static constexpr BlockInfo info{"taper", "Taper", "Makes hair thicker or thinner along its way."};

    Driven root{1.0f};
    Driven tip{0.2f};
    Driven profile{0.5f};

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "root",
                        .label = "Root",
                        .max = 100,
                        .softMax = 3,
                        .tip = "Width at the root, compared with before."},
              self.root);
        visit(ParamInfo{.id = "tip",
                        .label = "Tip",
                        .max = 100,
                        .softMax = 3,
                        .tip = "Width at the tip, compared with before."},
              self.tip);
        visit(ParamInfo{.id = "profile",
                        .label = "Profile",
                        .min = 0.02,
                        .max = 0.98,
                        .tip = "Low: changes near the tip only. High: changes near the root already."},
              self.profile);
    }
    bool operator==(const TaperParams&) const = default;
};

}  // namespace whorl
