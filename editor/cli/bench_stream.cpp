// SPDX-License-Identifier: Apache-2.0
// Many hairs block by block: how fast, and how much memory above the document at the most.
#include "core/io/hair_file.h"
#include "editor/cli/bench_grooms.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace whorl {
namespace {

constexpr std::uint32_t hairs = 1600000;
constexpr double mostBytes = 300e6;

// A number of /proc/self/status, bytes.
double memory(const std::string& key) {
    std::ifstream status("/proc/self/status");
    std::string word;
    double kilobytes = 0.0;
    while (status >> word)
        if (word == key + ":" && status >> kilobytes) return kilobytes * 1024.0;
    return 0.0;
}

// Most memory that `work` takes above what is there before it, bytes.
double peakOf(const std::function<void()>& work) {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
    const double before = memory("VmRSS");
    work();
    return std::max(memory("VmHWM") - before, 0.0);
}

BenchRow streamed(const std::string& name, const std::function<std::uint64_t()>& work) {
    std::uint64_t made = 0;
    const double peak = peakOf([&] { made = work(); });
    const Medians seconds = interleaved([&] { made = work(); }, {});
    char more[96];
    std::snprintf(more, sizeof more, "at most %.0f MB above the document, allowed %.0f", peak * 1e-6, mostBytes * 1e-6);
    BenchRow row = hairRow("stream/" + name, static_cast<double>(made), 2, seconds, {}, more);
    row.correct = peak > 0.0 && peak < mostBytes && std::abs(static_cast<double>(made) - hairs) < 0.01 * hairs;
    return row;
}

}  // namespace

std::vector<BenchRow> benchStream() {
    BenchDocument document = benchDocument();
    document.groom.countAnew();
    Groom strands = inStrands(document.groom);
    strands.countAnew();
    const auto surface = std::make_shared<const Surface>(document.groom.mesh);
    surface->skin();
    Progress progress;
    const auto toNothing = [&](const Groom& groom, std::uint32_t count) {
        Generator generator;
        generator.setSurface(surface);
        std::uint64_t made = 0;
        const Result<void> done = generator.stream(
            groom, {count}, 1u << 14,
            [&](const Strands& block) {
                made += block.count();
                return true;
            },
            progress);
        return done ? made : 0;
    };
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("whorl-bench-" + std::to_string(::getpid()) + ".hair");
    const auto toFile = [&](const Groom& groom, std::uint32_t count) {
        const Result<std::uint64_t> written = writeHair(groom, {count}, file, progress, surface);
        return written ? *written : 0;
    };
    const std::string name = "1600k of the " + document.name;
    std::vector<BenchRow> rows{
        streamed(name + ", to nothing", [&] { return toNothing(document.groom, hairs); }),
        streamed(name + " as strands, to nothing", [&] { return toNothing(strands, hairs / 16); }),
        streamed(name + ", to a .hair file", [&] { return toFile(document.groom, hairs); }),
        streamed(name + " as strands, to a .hair file", [&] { return toFile(strands, hairs / 16); })};
    std::error_code failed;
    std::filesystem::remove(file, failed);
    return rows;
}

}  // namespace whorl
