// SPDX-License-Identifier: Apache-2.0
// Places of parameters among a modifier's numbers, for its kernel. No includes but <cstddef>: see core/base/simd.h.
#pragma once

#include <cstddef>

// In declared order (tests/core/hair/modifiers_test.cpp holds them to it): every modifier has "on" in row 0 and its
// amount in row 1; a vector takes three rows, a choice its place, a switch 0 or 1.

namespace whorl {

struct ClumpRows {
    enum : std::size_t {
        Centres = 2,
        Count,
        Density,
        Tightness,
        RootTightness,
        Profile,
        Flyaways,
        NoiseAmplitude,
        NoiseFrequency,
        KeepLength,
        Seed,
        count
    };
};

struct CurlRows {
    enum : std::size_t { RootRadius = 2, TipRadius, Turns, Variation, Phase, Flips, Shared, KeepLength, Seed, count };
};

struct NoiseRows {
    enum : std::size_t {
        RootAmplitude = 2,
        TipAmplitude,
        Frequency,
        Correlation = Frequency + 3,
        Octaves,
        Shared,
        KeepLength,
        Seed,
        count
    };
};

struct BendRows {
    enum : std::size_t {
        Direction = 2,
        Strength = Direction + 3,
        Stiffness,
        ByThickness,
        ByLength,
        ReferenceLength,
        count
    };
};

struct LengthRows {
    enum : std::size_t { Mode = 2, Factor, Length, Random, Method, Seed, count };
};

struct SmoothRows {
    enum : std::size_t { Strength = 2, Iterations, KeepLength, count };
};

struct StraightenRows {
    enum : std::size_t { Root = 2, Tip, KeepLength, count };
};

struct TaperRows {
    enum : std::size_t { Root = 2, Tip, Profile, count };
};

}  // namespace whorl
