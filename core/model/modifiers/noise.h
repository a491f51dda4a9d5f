// SPDX-License-Identifier: Apache-2.0
// Parameters of the modifier that makes hair unruly.
#pragma once

#include "core/param/param.h"

namespace whorl {

/// A noise vector at every vertex, looked up at its place; neighbours move together or each hair on its own.
struct NoiseParams {
    static constexpr BlockInfo info{"noise", "Noise", "Waves that run through the hair, or strays of each hair."};

    Driven rootAmplitude{0.0f};
    Driven tipAmplitude{0.008f};
    DrivenVector frequency{{30.0f, 30.0f, 30.0f}};
    Driven correlation{1.0f};
    int octaves = 1;
    bool shared = false;
    bool keepLength = true;
    int seed = 0;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "root_amplitude",
                        .label = "Root amplitude",
                        .max = 1,
                        .softMax = 0.02,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far vertices near the root move."},
              self.rootAmplitude);
        visit(ParamInfo{.id = "tip_amplitude",
                        .label = "Tip amplitude",
                        .max = 1,
                        .softMax = 0.05,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far the tip moves."},
              self.tipAmplitude);
        visit(ParamInfo{.id = "frequency",
                        .label = "Frequency",
                        .max = 100000,
                        .softMax = 500,
                        .unit = "per metre",
                        .tip = "Noise waves a metre along x, y, z."},
              self.frequency);
        visit(ParamInfo{.id = "correlation",
                        .label = "Together",
                        .tip = "1: neighbours move together, locks form. 0: each hair goes its own way."},
              self.correlation);
        visit(ParamInfo{.id = "octaves",
                        .label = "Octaves",
                        .min = 1,
                        .max = 4,
                        .tip = "Adds finer noise of twice the frequency and half the amplitude."},
              self.octaves);
        visit(ParamInfo{.id = "shared",
                        .label = "One for a lock",
                        .tip = "What is each hair's own is each lock's own, for hairs that a clump above gathered."},
              self.shared);
        visit(ParamInfo{.id = "keep_length", .label = "Keep length", .tip = "Pieces keep their length."},
              self.keepLength);
        visit(ParamInfo{.id = "seed", .label = "Seed", .max = 1e6, .softMax = 100, .tip = "Other noise."}, self.seed);
    }
    bool operator==(const NoiseParams&) const = default;
};

}  // namespace whorl
