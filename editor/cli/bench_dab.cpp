// SPDX-License-Identifier: Apache-2.0
// Hair after a dab of paint: only what lies under it is made again.
#include "core/base/parallel.h"
#include "core/brushes/paint_canvas.h"
#include "core/sampling/density_total.h"
#include "editor/cli/bench_grooms.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace whorl {

std::vector<BenchRow> benchDab();

namespace {

constexpr std::uint32_t hairs = 100000;

struct Case {
    const char* name;
    const char* map;  ///< painted: "density", "frizz", "length" or "tint"
    int size;
    unsigned threads;
    bool outside;
};

Groom paintable(const Case& c) {
    Groom groom = benchGroom({c.outside, false});
    HairParams& params = groom.groups.edit()[0].params;
    groom.maps.set(c.map, Map(c.size, c.size, 1, TexelFormat::U16, 0.5f));
    const std::string map = c.map;
    if (map == "density") params.general.density = {1.0f, map};
    if (map == "length") params.general.scale = {1.0f, map};
    if (map == "frizz") params.frizz.tip = {0.02f, map};
    if (map == "tint") params.colour.tip.map = map;
    groom.counts.edit().hairs = static_cast<int>(hairs);
    if (map == "density") groom.counts.edit().densityTotal = densityTotalOf(groom);
    return groom;
}

// A stroke of dabs of 15 mm over the side of the ball, every fourth takes away: what the brush gives to the generator.
std::vector<Groom> strokeOf(Groom groom, const Surface& surface, const char* map) {
    std::vector<Groom> steps;
    PaintCanvas canvas(surface, *groom.maps.find(map));
    for (int i = 0; i < 24; ++i) {
        const float turn = 0.3f + 0.08f * static_cast<float>(i), polar = 1.2f + 0.02f * static_cast<float>(i % 7);
        const glm::vec3 out(std::sin(polar) * std::cos(turn), std::cos(polar), -std::sin(polar) * std::sin(turn));
        const PaintDab dab{.centre = out * 0.09f, .radius = 0.015f, .strength = 0.9f, .eye = out};
        canvas.paint(groom.maps, map, dab, i % 4 == 3 ? 0.0f : 1.0f);
        steps.push_back(groom);
    }
    return steps;
}

std::size_t idsThatDiffer(const Strands& a, const Strands& b) {
    std::vector<std::uint32_t> x = a.ids, y = b.ids, apart;
    std::sort(x.begin(), x.end());
    std::sort(y.begin(), y.end());
    std::set_symmetric_difference(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(apart));
    return apart.size();
}

BenchRow afterDab(const Case& c) {
    const ThreadLimit limit(c.threads);
    const Groom groom = paintable(c);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    surface->skin();
    const std::vector<Groom> steps = strokeOf(groom, *surface, c.map);
    Generator kept;
    kept.setSurface(surface);
    // Like the viewport, it holds the newest hair while the next is made.
    std::shared_ptr<const Strands> shown = made(kept, groom, {}), fresh;
    std::size_t next = 0;
    const Medians times = interleaved([&] { shown = made(kept, steps[next++], {}); },
                                      [&] { fresh = madeAnew(steps[next - 1], surface, {}); }, 11);
    char note[96];
    std::snprintf(note, sizeof note, "%zu hairs came or went with the last dab",
                  idsThatDiffer(*madeAnew(steps[next - 2], surface, {}), *fresh));
    BenchRow row = hairRow("dab/" + std::string(c.name), static_cast<double>(shown->count()), c.threads, times,
                           "a fresh generator", note);
    row.correct = digestOf(*shown) == digestOf(*fresh) && shown->count() > 0;
    return row;
}

}  // namespace

std::vector<BenchRow> benchDab() {
    const Case cases[] = {
        {"density 1024^2, 100k x 16", "density", 1024, 1, false},
        {"density 1024^2, 100k x 16", "density", 1024, 2, false},
        {"density 2048^2, 100k x 16", "density", 2048, 1, false},
        {"density 2048^2, 100k x 16", "density", 2048, 2, false},
        {"density 2048^2, 100k x 16, outside the skin", "density", 2048, 2, true},
        {"frizz 2048^2, 100k x 16", "frizz", 2048, 2, false},
        {"length 2048^2, 100k x 16", "length", 2048, 2, false},
        {"colour 2048^2, 100k x 16", "tint", 2048, 2, false},
    };
    std::vector<BenchRow> rows;
    for (const Case& c : cases) rows.push_back(afterDab(c));
    return rows;
}

}  // namespace whorl
