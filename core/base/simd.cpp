// SPDX-License-Identifier: Apache-2.0
#include "core/base/simd.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <string_view>

namespace whorl {
namespace {

SimdLevel detect() {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("bmi2"))
        return SimdLevel::Avx512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2")) return SimdLevel::Avx2;
#endif
    return SimdLevel::Plain;
}

SimdLevel initialLevel() {
    const char* wish = std::getenv("WHORL_SIMD");
    const SimdLevel best = bestSimdLevel();
    if (!wish) return best;
    if (std::string_view(wish) == "plain") return SimdLevel::Plain;
    if (std::string_view(wish) == "avx2") return std::min(best, SimdLevel::Avx2);
    return best;
}

std::atomic<SimdLevel>& current() {
    static std::atomic<SimdLevel> level{initialLevel()};
    return level;
}

}  // namespace

SimdLevel bestSimdLevel() {
    static const SimdLevel best = detect();
    return best;
}

SimdLevel simdLevel() {
    return current().load(std::memory_order_relaxed);
}

void setSimdLevel(SimdLevel level) {
    current().store(std::min(level, bestSimdLevel()), std::memory_order_relaxed);
}

const char* simdLevelName(SimdLevel level) {
    switch (level) {
        case SimdLevel::Avx512:
            return "avx512";
        case SimdLevel::Avx2:
            return "avx2";
        case SimdLevel::Plain:
            break;
    }
    return "plain";
}

}  // namespace whorl
