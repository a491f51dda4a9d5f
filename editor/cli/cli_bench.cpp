// SPDX-License-Identifier: Apache-2.0
#include "editor/cli/bench.h"
#include "editor/cli/cli.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace whorl::cli {
namespace {

struct Options {
    std::string filter;
    bool json = false;
};

std::string shownTime(double seconds) {
    char text[32];
    if (seconds <= 0.0) return "-";
    if (seconds < 1e-3) {
        std::snprintf(text, sizeof text, "%.2f us", seconds * 1e6);
    } else if (seconds < 1.0) {
        std::snprintf(text, sizeof text, "%.3f ms", seconds * 1e3);
    } else {
        std::snprintf(text, sizeof text, "%.3f s", seconds);
    }
    return text;
}

std::string shownNumber(double number) {
    char text[32];
    std::snprintf(text, sizeof text,
                  number >= 1e6   ? "%.2f M"
                  : number >= 1e3 ? "%.1f k"
                                  : "%.1f",
                  number >= 1e6   ? number * 1e-6
                  : number >= 1e3 ? number * 1e-3
                                  : number);
    return text;
}

std::string tableRow(const BenchRow& row) {
    char text[256];
    const double ratio = row.seconds > 0.0 ? row.baselineSeconds / row.seconds : 0.0;
    char shownRatio[32] = "-";
    if (ratio > 0.0) std::snprintf(shownRatio, sizeof shownRatio, "%.2f x", ratio);
    std::snprintf(text, sizeof text, "%-52s %12s %12s %10s  %s\n", row.name.c_str(), shownTime(row.seconds).c_str(),
                  shownTime(row.baselineSeconds).c_str(), shownRatio, row.correct ? "" : "WRONG RESULT");
    std::string line = text;
    if (row.items > 0.0 && row.seconds > 0.0) {
        line += "    " + shownNumber(row.items / row.seconds) + " " + row.unit + "/s";
        line += row.note.empty() ? "\n" : "; " + row.note + "\n";
    } else if (!row.note.empty()) {
        line += "    " + row.note + "\n";
    }
    if (!row.baseline.empty()) line += "    baseline: " + row.baseline + "\n";
    return line;
}

nlohmann::ordered_json rowJson(const BenchRow& row) {
    nlohmann::ordered_json json{{"name", row.name}, {"seconds", row.seconds}};
    if (row.baselineSeconds > 0.0) {
        json["baseline"] = row.baseline;
        json["baseline_seconds"] = row.baselineSeconds;
        json["ratio"] = row.seconds > 0.0 ? row.baselineSeconds / row.seconds : 0.0;
    }
    json["items"] = row.items;
    json["unit"] = row.unit;
    json["correct"] = row.correct;
    json["note"] = row.note;
    return json;
}

Outcome runBenches(const Options& options) {
    const auto asked = [&](const Bench& bench) {
        return std::string(bench.name).find(options.filter) != std::string::npos;
    };
    if (std::ranges::none_of(benches(), asked)) {
        std::string names;
        for (const Bench& bench : benches()) names += (names.empty() ? "" : ", ") + std::string(bench.name);
        return badUsage("FILTER: no benchmark is called \"" + options.filter + "\"; there are " + names + ".");
    }
    bool correct = true;
    std::string wrong;
    auto json = nlohmann::ordered_json::array();
    if (!options.json) {
        char head[128];
        std::snprintf(head, sizeof head, "%-52s %12s %12s %10s\n", "median of at least seven runs", "time", "baseline",
                      "ratio");
        if (!print(head)) return printed("");
    }
    for (const Bench& bench : benches()) {
        if (!asked(bench)) continue;
        for (const BenchRow& row : bench.run()) {
            if (!row.correct) {
                correct = false;
                wrong = row.name;
            }
            if (options.json) {
                json.push_back(rowJson(row));
            } else if (!print(tableRow(row))) {
                return printed("");
            }
        }
    }
    if (options.json) {
        if (Outcome out = printed(json.dump(2) + "\n"); out.status != Status::Ok) return out;
    }
    if (!correct) return badInput({"The benchmark \"" + wrong + "\" gave a wrong result."});
    return done();
}

}  // namespace

void addBench(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program = addProgram(app, "bench", "Benchmarks, each against its own baseline measured in the same run",
                                   [options] { return runBenches(*options); });
    program->add_option("FILTER", options->filter, "Only benchmarks with this in their name");
    program->add_flag("--json", options->json, "As a JSON array");
}

}  // namespace whorl::cli
