// SPDX-License-Identifier: Apache-2.0
#include "editor/cli/bench.h"

#include <algorithm>
#include <array>
#include <chrono>

namespace whorl {

std::vector<BenchRow> benchSampler();
std::vector<BenchRow> benchHair();
std::vector<BenchRow> benchStrands();
std::vector<BenchRow> benchParaview();
std::vector<BenchRow> benchModifiers();
std::vector<BenchRow> benchEdit();
std::vector<BenchRow> benchDab();
std::vector<BenchRow> benchBox();
std::vector<BenchRow> benchStream();
std::vector<BenchRow> benchPackage();
std::vector<BenchRow> benchComb();
std::vector<BenchRow> benchPaint();
std::vector<BenchRow> benchField();
std::vector<BenchRow> benchLic();
std::vector<BenchRow> benchDraw();
std::vector<BenchRow> benchLicDraw();

std::span<const Bench> benches() {
    static const std::array list{
        Bench{"sampler", "Random roots, against bisection and rejection", benchSampler},
        Bench{"hair", "Generation of hair, against the reference generator", benchHair},
        Bench{"strands", "Hairs of strands from base hairs, against the reference generator", benchStrands},
        Bench{"modifiers", "Each modifier and all together, against the reference generator", benchModifiers},
        Bench{"edit", "Hair after a stroke of the comb, against a fresh generator", benchEdit},
        Bench{"dab", "Hair after a dab of paint, against a fresh generator", benchDab},
        Bench{"box", "Boxes over rendered curves, against a plain loop", benchBox},
        Bench{"stream", "Memory above the document while 1,600,000 hairs go by", benchStream},
        Bench{"paraview", "Hair texture, against ParaView's surface LIC where that is installed", benchParaview},
        Bench{"package", "Packages, against the hair that they stand for as it is", benchPackage},
        Bench{"comb", "One step of the comb, against a pass over every point", benchComb},
        Bench{"paint", "One dab of paint on the model, against a pass over every texel", benchPaint},
        Bench{"field", "Directions of hair after one stroke has moved, against factorising anew", benchField},
        Bench{"lic", "Hair texture over a mesh, against the reference place by place", benchLic},
        Bench{"draw", "Frames, voxel shadows and depth order, against plain lines and plain loops", benchDraw},
        Bench{"lic-draw", "Frames with hair texture, against the bare mesh; uploads of dabs", benchLicDraw},
    };
    return list;
}

Medians interleaved(const std::function<void()>& ours, const std::function<void()>& baseline, int runs) {
    const auto seconds = [](const std::function<void()>& work) {
        if (!work) return 0.0;
        const auto start = std::chrono::steady_clock::now();
        work();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    seconds(ours);
    seconds(baseline);
    std::vector<double> oursTimes, baselineTimes;
    for (int i = 0; i < std::max(runs, 7); ++i) {
        oursTimes.push_back(seconds(ours));
        baselineTimes.push_back(seconds(baseline));
    }
    const auto median = [](std::vector<double>& times) {
        std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
        return times[times.size() / 2];
    };
    return {median(oursTimes), median(baselineTimes)};
}

}  // namespace whorl
