// SPDX-License-Identifier: Apache-2.0
// Benchmarks: each runs its baseline in the same process, interleaved, and checks the result in the same run.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace whorl {

/// One line of output: what was measured against what.
struct BenchRow {
    std::string name;            ///< "sampler/4M roots, 69k triangles, noise map"
    double seconds = 0;          ///< median of ours
    double baselineSeconds = 0;  ///< median of the baseline; 0 when there is none
    std::string baseline;        ///< what the baseline is
    double items = 0;            ///< work done a run (roots, hairs, frames)
    std::string unit;            ///< "roots"
    bool correct = true;         ///< the result was checked against the baseline's or the law
    std::string note;            ///< memory, counts
};

struct Bench {
    std::string_view name;
    std::string_view help;
    std::vector<BenchRow> (*run)();
};

/// All benchmarks; one source bench_NAME.cpp each, named in bench.cpp.
std::span<const Bench> benches();

/// Runs `ours` and `baseline` (may be empty) in turn, at least `runs` times each after one warm-up; medians in seconds.
struct Medians {
    double ours = 0;
    double baseline = 0;
};
Medians interleaved(const std::function<void()>& ours, const std::function<void()>& baseline, int runs = 7);

}  // namespace whorl
