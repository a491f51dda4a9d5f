// SPDX-License-Identifier: Apache-2.0
// Paint on maps: hair brought up to a dab is what a fresh generator grows, byte for byte, and nothing else moves.
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/hair/generate.h"
#include "core/sampling/density_total.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <map>

using namespace whorl;

namespace {

bool same(const Strands& a, const Strands& b) {
    return a.firstVertex == b.firstVertex && a.ids == b.ids && a.members == b.members && a.roots == b.roots &&
           a.rootUvs == b.rootUvs && a.groups == b.groups && a.positions == b.positions && a.normals == b.normals &&
           a.widths == b.widths && a.colours == b.colours;
}

float random(std::uint32_t seed, std::uint64_t index, std::uint32_t channel) {
    return randomFloat(seed, index, channel);
}

// A soft round dab on a map; `hard`: the value itself, for maps of numbers.
void dab(Map& map, glm::vec2 uv, float radius, float value, bool hard) {
    const glm::vec2 centre = map.texelFromUv(uv);
    const float reach = radius * static_cast<float>(map.width());
    for (int y = std::max(0, static_cast<int>(centre.y - reach));
         y < std::min(map.height(), static_cast<int>(centre.y + reach) + 1); ++y) {
        for (int x = std::max(0, static_cast<int>(centre.x - reach));
             x < std::min(map.width(), static_cast<int>(centre.x + reach) + 1); ++x) {
            const float dx = static_cast<float>(x) + 0.5f - centre.x, dy = static_cast<float>(y) + 0.5f - centre.y;
            const float weight = 1.0f - (dx * dx + dy * dy) / (reach * reach);
            if (weight <= 0.0f) continue;
            for (int c = 0; c < map.channels(); ++c)
                map.setTexel(x, y, c, hard ? value : map.texel(x, y, c) * (1.0f - weight) + value * weight);
        }
    }
}

Groom paintable(std::uint32_t seed, TexelFormat format, bool groups) {
    Groom groom = testing::groomOn(testing::sphere(24, 40), 200, 7);
    groom.maps.set("density", Map(256, 192, 1, format, 0.5f));
    for (const char* name : {"length", "frizz", "cut"}) groom.maps.set(name, Map(256, 256, 1, format, 0.7f));
    groom.maps.set("tint", Map(128, 128, 3, TexelFormat::U8, 0.4f));
    groom.maps.set("groups", Map(256, 256, 1, TexelFormat::U8, 0.0f));
    std::vector<Group>& all = groom.groups.edit();
    if (groups) {
        all.push_back(all[0]);
        all.push_back(all[0]);
        all[1].name = "second";
        all[2].name = "third";
        all[1].params.strands.hairs = 3;
        groom.counts.edit().groupMap.name = "groups";
        for (std::size_t i = 0; i < groom.guides.count(); ++i)
            groom.guides.setGroup(i, static_cast<std::uint8_t>(i % 3));
    }
    for (std::size_t g = 0; g < all.size(); ++g) {
        HairParams& params = all[g].params;
        if (g != 1) params.general.density = {1.0f, "density"};
        params.general.scale.map = "length";
        params.general.cut.map = "cut";
        params.frizz.tip = {0.01f, "frizz"};
        params.colour.tip.map = "tint";
        params.general.keepOutside = false;
    }
    groom.counts.edit().hairs = 4000;
    groom.counts.edit().shownHairs = 1500;
    groom.counts.edit().seed = static_cast<int>(seed);
    return groom;
}

// As the paint brush does it: what the number of hairs stands for is pinned before the first dab.
void paint(Groom& groom, std::uint32_t seed, std::uint64_t step) {
    const char* const names[] = {"density", "density", "density", "length", "frizz", "cut", "tint", "groups"};
    const std::string name = names[randomBits(seed, step, 0) % std::size(names)];
    const bool hard = name == "groups";
    if (groom.counts->densityTotal == 0.0f && drivesDensity(groom, name))
        groom.counts.edit().densityTotal = densityTotalOf(groom);
    const glm::vec2 uv(random(seed, step, 1) * 1.2f - 0.1f, random(seed, step, 2));
    const float radius = 0.02f + 0.1f * random(seed, step, 3);
    const float values[] = {0.0f, 0.0f, 1.0f, random(seed, step, 4)};
    const float value =
        hard ? static_cast<float>(randomBits(seed, step, 5) % 3) / 255.0f : values[randomBits(seed, step, 5) % 4];
    Map& map = *groom.maps.edit(name);
    dab(map, uv, radius, value, hard);
    if (randomBits(seed, step, 6) % 3 == 0) dab(map, {1.0f - uv.x, uv.y}, radius, value, hard);
}

}  // namespace

class DabTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aDabGivesWhatAFreshGeneratorGives_data() {
        QTest::addColumn<int>("format");
        QTest::addColumn<bool>("groups");
        QTest::addColumn<bool>("locks");
        QTest::newRow("8 bits") << 0 << false << false;
        QTest::newRow("16 bits, groups") << 1 << true << false;
        QTest::newRow("floats, groups") << 2 << true << false;
        QTest::newRow("floats") << 2 << false << false;
        QTest::newRow("16 bits, locks") << 1 << false << true;
    }
    void aDabGivesWhatAFreshGeneratorGives() {
        QFETCH(int, format);
        QFETCH(bool, groups);
        QFETCH(bool, locks);
        const std::uint32_t seed = 11u + static_cast<std::uint32_t>(format) + (groups ? 8u : 0u) + (locks ? 16u : 0u);
        Groom groom = paintable(seed, static_cast<TexelFormat>(format), groups);
        if (locks) {
            Modifier clump{"locks"};
            std::get<ClumpParams>(clump.params).count = 60;
            groom.groups.edit()[0].params.modifiers.push_back(clump);
        }
        std::vector<Groom> history{groom};
        Generator used;
        Progress progress;
        std::vector<std::pair<std::shared_ptr<const Strands>, Strands>> held;
        for (std::uint64_t step = 0; step < 70; ++step) {
            if (step % 11 == 10) {
                groom = history[randomBits(seed, step, 7) % history.size()];
            } else {
                paint(groom, seed, step);
                if (step % 9 == 4) paint(groom, seed, 1000 + step);
                if (step % 8 == 3)
                    for (glm::vec3& p : groom.guides.editPoints(randomBits(seed, step, 8) % 200).subspan(1))
                        p.x += 0.003f;
                if (step % 13 == 6) groom.groups.edit()[0].params.colour.root.value.x = random(seed, step, 9);
                if (step % 17 == 9) groom.groups.edit()[0].params.kink.tip.value = 0.01f * random(seed, step, 9);
            }
            history.push_back(groom);
            GenerateOptions options;
            if (step > 20) options.hairCount = static_cast<std::uint32_t>(groom.counts->shownHairs);
            if (step > 40) options.lod = 0.5f;
            if (step > 50) options.part = 1, options.partCount = 2;
            Generator fresh;
            const Result<Strands> expected = fresh.generate(groom, options, progress);
            const auto got = used.generateShared(groom, options, progress);
            QVERIFY(expected && got);
            QVERIFY2(same(**got, *expected), qPrintable(QString("step %1").arg(step)));
            // Held or not, what was given out stays as it was.
            if (step % 5 != 2) held.emplace_back(*got, *expected);
            for (const auto& [strands, content] : held) QVERIFY(same(*strands, content));
            if (step % 4 == 0) held.clear();
            if (step % 6 == 0 && held.size() > 1) held.erase(held.begin());
        }
    }

    void theFirstDabMovesNothingOutside() {
        // As the viewport shows it, as it is rendered, and a handful.
        for (const std::uint32_t shown : {0u, 1500u, 4000u, 60u}) {
            Groom before = paintable(5, TexelFormat::U16, false);
            before.maps.set("density", Map(256, 192, 1, TexelFormat::U16, 0.5f));
            dab(*before.maps.edit("density"), {0.7f, 0.4f}, 0.2f, 0.1f, false);
            GenerateOptions options;
            if (shown > 0) options.hairCount = shown;
            for (const float value : {0.0f, 1.0f}) {
                Groom after = before;
                after.counts.edit().densityTotal = densityTotalOf(before);
                dab(*after.maps.edit("density"), {0.3f, 0.6f}, 0.1f, value, false);
                Progress progress;
                Generator used, fresh;
                const Strands first = *used.generate(before, options, progress);
                const Strands second = *used.generate(after, options, progress);
                QVERIFY(same(second, *fresh.generate(after, options, progress)));
                std::map<std::uint32_t, std::size_t> places;
                for (std::size_t i = 0; i < second.count(); ++i) places[second.ids[i]] = i;
                const auto far = [](glm::vec2 uv) {
                    return std::abs(uv.x - 0.3f) > 0.11f || std::abs(uv.y - 0.6f) > 0.16f;
                };
                std::size_t kept = 0, outside = 0;
                for (std::size_t i = 0; i < first.count(); ++i) {
                    if (!far(first.rootUvs[i])) continue;
                    ++kept;
                    const auto found = places.find(first.ids[i]);
                    QVERIFY(found != places.end());
                    const std::size_t j = found->second;
                    QVERIFY(second.roots[j] == first.roots[i]);
                    const std::uint32_t from = first.firstVertex[i], to = second.firstVertex[j];
                    QCOMPARE(second.firstVertex[j + 1] - to, first.firstVertex[i + 1] - from);
                    QVERIFY(std::equal(&first.positions[from],
                                       &first.positions[from] + (first.firstVertex[i + 1] - from),
                                       &second.positions[to]));
                }
                for (const glm::vec2& uv : second.rootUvs) outside += far(uv) ? 1 : 0;
                QCOMPARE(outside, kept);
                QVERIFY(kept > (shown > 0 ? shown : 4000) / 2);
                if (shown != 60) QVERIFY(first.count() != second.count());
            }
        }
    }
};

QTEST_APPLESS_MAIN(DabTest)
#include "dab_test.moc"
