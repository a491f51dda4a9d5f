// SPDX-License-Identifier: Apache-2.0
// Parameters of the modifier that makes hairs shorter or longer.
#pragma once

#include "core/param/param.h"

#include <array>

namespace whorl {

inline constexpr std::array<std::string_view, 2> lengthModeNames{"A share", "A length"};
inline constexpr std::array<std::string_view, 2> lengthMethodNames{"Scale the shape", "Cut the end"};

/// Sets the length of hairs: a share of what it was, or in metres.
struct LengthParams {
    static constexpr BlockInfo info{"length", "Length", "Makes hair shorter or longer, by share, length or at random."};

    Choice mode{};
    Driven factor{0.7f};
    Driven length{0.05f};
    Driven random{0.0f};
    Choice method{};
    int seed = 0;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "mode",
                        .label = "Becomes",
                        .tip = "A share of the length that it has, or a length of its own.",
                        .choices = lengthModeNames},
              self.mode);
        visit(ParamInfo{.id = "factor",
                        .label = "Share",
                        .max = 100,
                        .softMax = 2,
                        .tip = "Length compared with before, when it becomes a share."},
              self.factor);
        visit(ParamInfo{.id = "length",
                        .label = "Length",
                        .max = 100,
                        .softMax = 0.5,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Length when it becomes a length."},
              self.length);
        visit(ParamInfo{.id = "random", .label = "Random", .tip = "Shortens each hair by a random share up to this."},
              self.random);
        visit(ParamInfo{.id = "method",
                        .label = "How",
                        .tip = "Scaled hair keeps its whole shape. Cut hair keeps its root end and grows no longer.",
                        .choices = lengthMethodNames},
              self.method);
        visit(ParamInfo{.id = "seed", .label = "Seed", .max = 1e6, .softMax = 100, .tip = "Other random lengths."},
              self.seed);
    }
    bool operator==(const LengthParams&) const = default;
};

}  // namespace whorl
