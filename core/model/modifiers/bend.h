// SPDX-License-Identifier: Apache-2.0
// Parameters of the modifier that lets hair hang.
#pragma once

#include "core/param/param.h"

namespace whorl {

/// Turns pieces towards a direction, more and more to the tip. Lengths stay.
struct BendParams {
    static constexpr BlockInfo info{"bend", "Gravity", "Lets hair hang, or blows it to one side."};

    Vector direction{{0.0f, -1.0f, 0.0f}};
    Driven strength{0.8f};
    Driven stiffness{0.3f};
    Driven byThickness{0.0f};
    Driven byLength{0.0f};
    float referenceLength = 0.1f;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "direction", .label = "Direction", .min = -1, .tip = "Where hair is pulled; y is up."},
              self.direction);
        visit(ParamInfo{.id = "strength",
                        .label = "Strength",
                        .max = 100,
                        .softMax = 4,
                        .tip = "How strongly. At 1 a tip turns half way."},
              self.strength);
        visit(ParamInfo{.id = "stiffness",
                        .label = "Stiffness",
                        .tip = "How long hair holds its direction: 0 bends from the root on, 1 at the tip only."},
              self.stiffness);
        visit(ParamInfo{.id = "by_thickness",
                        .label = "Thick is stiff",
                        .tip = "How much hairs that maps make thicker than the group's root thickness bend less."},
              self.byThickness);
        visit(ParamInfo{.id = "by_length",
                        .label = "Long is heavy",
                        .tip = "How much hairs longer than the reference length bend more, and shorter ones less."},
              self.byLength);
        visit(ParamInfo{.id = "reference_length",
                        .label = "Reference length",
                        .min = 1e-6,
                        .max = 100,
                        .softMax = 0.5,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Length at which weight by length changes nothing."},
              self.referenceLength);
    }
    bool operator==(const BendParams&) const = default;
};

}  // namespace whorl
