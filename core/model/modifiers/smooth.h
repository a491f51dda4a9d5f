// SPDX-License-Identifier: Apache-2.0
// Parameters of the modifiers that take bends out of hairs.
#pragma once

#include "core/param/param.h"

namespace whorl {

/// Moves vertices to the middle between their neighbours, again and again. Root and tip stay.
struct SmoothParams {
    static constexpr BlockInfo info{"smooth", "Smooth", "Takes small bends out of hair."};

    Driven strength{0.5f};
    int iterations = 4;
    bool keepLength = true;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "strength", .label = "Strength", .tip = "How much of each bend a step takes out."},
              self.strength);
        visit(ParamInfo{.id = "iterations",
                        .label = "Steps",
                        .min = 1,
                        .max = 100,
                        .softMax = 20,
                        .tip = "How often. More reaches longer waves."},
              self.iterations);
        visit(ParamInfo{.id = "keep_length", .label = "Keep length", .tip = "Pieces keep their length."},
              self.keepLength);
    }
    bool operator==(const SmoothParams&) const = default;
};

/// Pulls hairs to the straight line from root to tip.
struct StraightenParams {
    static constexpr BlockInfo info{"straighten", "Straighten", "Pulls hair straight."};

    Driven root{1.0f};
    Driven tip{1.0f};
    bool keepLength = true;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "root", .label = "Root", .tip = "How straight hair is near the root."}, self.root);
        visit(ParamInfo{.id = "tip", .label = "Tip", .tip = "How straight hair is at the tip."}, self.tip);
        visit(ParamInfo{.id = "keep_length",
                        .label = "Keep length",
                        .tip = "On: hair gets as long as it is. Off: tips stay where they are."},
              self.keepLength);
    }
    bool operator==(const StraightenParams&) const = default;
};

}  // namespace whorl
