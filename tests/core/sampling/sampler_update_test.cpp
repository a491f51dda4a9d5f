// SPDX-License-Identifier: Apache-2.0
// Samplers brought up to paint are those that are built anew.
#include "core/base/random.h"
#include "core/model/map_changes.h"
#include "core/sampling/root_sampler.h"
#include "core/sampling/uv_cells.h"
#include "core/surface/surface_point.h"
#include "tests/support/distribution.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;
using testing::densityGroom;
using testing::samplerOf;

namespace {

float random(std::uint64_t step, std::uint32_t channel) {
    return randomFloat(3, step, channel);
}

void square(Map& map, std::uint64_t step) {
    const int size = 1 + static_cast<int>(random(step, 0) * 40.0f);
    const int x0 = static_cast<int>(random(step, 1) * static_cast<float>(map.width())),
              y0 = static_cast<int>(random(step, 2) * static_cast<float>(map.height()));
    const float values[] = {0.0f, 1.0f, random(step, 3), 0.25f};
    for (int y = y0; y < std::min(y0 + size, map.height()); ++y)
        for (int x = x0; x < std::min(x0 + size, map.width()); ++x)
            for (int c = 0; c < map.channels(); ++c) map.setTexel(x, y, c, values[randomBits(3, step, 4) % 4]);
}

bool same(const RootSampler& a, const RootSampler& b) {
    if (a.weight() != b.weight() || a.pieceCount() != b.pieceCount() || a.empty() != b.empty()) return false;
    if (a.empty()) return true;
    for (std::uint32_t i = 0; i < 1500; ++i) {
        const RootSampler::Candidate x = a.candidate(9, i), y = b.candidate(9, i);
        if (x.code != y.code || x.point != y.point) return false;
        if (a.shareBefore(x.unit) != b.shareBefore(x.unit)) return false;
    }
    RootList x, y;
    a.sample({20000.0 / a.weight(), 2}, {}, x);
    b.sample({20000.0 / a.weight(), 2}, {}, y);
    if (x.count() != y.count()) return false;
    for (std::size_t i = 0; i < x.count(); ++i)
        if (x.id(i) != y.id(i) || x.point(i) != y.point(i)) return false;
    return true;
}

// UVs run over the edges of the square, mirrored and far outside.
SurfaceMesh strayUvs(SurfaceMesh mesh) {
    for (std::size_t i = 0; i < mesh.cornerUvs.size(); ++i) {
        glm::vec2& uv = mesh.cornerUvs[i];
        uv = uv * glm::vec2(-1.5f, 1.3f) + glm::vec2(0.4f, -3.2f);
        if (i / 3 == 7) uv *= 5000.0f;
        if (i / 3 == 9) uv.x = std::nanf("");
    }
    return mesh;
}

}  // namespace

class SamplerUpdateTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void paintGivesWhatBuildingAnewGives_data() {
        QTest::addColumn<int>("shape");
        QTest::addColumn<int>("kind");
        for (const int shape : {0, 1, 2})
            for (const int kind : {0, 1, 2, 3, 4}) QTest::addRow("shape %d, map %d", shape, kind) << shape << kind;
    }
    void paintGivesWhatBuildingAnewGives() {
        QFETCH(int, shape);
        QFETCH(int, kind);
        const SurfaceMesh mesh = shape == 0   ? testing::sphere(20, 30)
                                 : shape == 1 ? testing::plane(2)
                                              : strayUvs(testing::sphere(12, 20));
        Map map(kind == 3 ? 200 : 256, 256, kind == 3 ? 3 : 1,
                kind == 1   ? TexelFormat::U16
                : kind == 2 ? TexelFormat::F32
                            : TexelFormat::U8,
                0.5f);
        map.flipV = kind == 1;
        Groom groom = densityGroom(mesh, map);
        if (kind == 4) {
            // Two groups: the map of groups is painted too.
            groom.maps.set("groups", Map(64, 64, 1, TexelFormat::U8, 0.0f));
            groom.groups.edit().push_back((*groom.groups)[0]);
            groom.groups.edit()[1].name = "other";
            groom.groups.edit()[1].params.general.density = {0.4f, ""};
            groom.counts.edit().groupMap.name = "groups";
        }
        RootSampler kept = samplerOf(groom);
        std::size_t updates = 0, measured = 0;
        for (std::uint64_t step = 0; step < 20; ++step) {
            const Groom before = groom;
            const bool groups = kind == 4 && step % 3 == 0;
            if (groups) {
                Map& numbers = *groom.maps.edit("groups");
                for (int i = 0; i < 9; ++i)
                    numbers.setTexel(static_cast<int>(random(step, 5) * 60.0f) + i % 3,
                                     static_cast<int>(random(step, 6) * 60.0f) + i / 3, 0,
                                     i % 2 ? 1.0f / 255.0f : 0.0f);
            } else {
                square(*groom.maps.edit("density"), step);
            }
            if (kind == 2 && step % 10 == 7) groom.maps.edit("density")->setTexel(3, 3, 0, 1.5f + random(step, 7));
            if (kind == 2 && step % 10 == 9) groom.maps.edit("density")->setTexel(3, 3, 0, 0.5f);
            TouchedMaps maps(before, groom);
            QVERIFY(maps.add("density") && maps.add("groups"));
            const DensityLookup density(groom);
            std::vector<std::uint32_t> touched;
            if (!kept.update(groom, density, maps, touched)) {
                QVERIFY(kind == 2);
                kept = samplerOf(groom);
                continue;
            }
            ++updates;
            measured += touched.size();
            QVERIFY(std::is_sorted(touched.begin(), touched.end()));
            const RootSampler fresh = samplerOf(groom);
            QVERIFY2(same(kept, fresh), qPrintable(QString::number(step)));
            // Away from touched triangles every density and group is as it was.
            const DensityLookup then(before);
            std::vector<bool> is(mesh.triangleCount(), false);
            for (const std::uint32_t place : touched) is[kept.curve().triangles()[place]] = true;
            for (std::uint32_t i = 0; i < 500 && !fresh.empty(); ++i) {
                const SurfacePoint p = fresh.candidate(4, i).point;
                if (is[p.triangle]) continue;
                const glm::vec2 uv = uvAt(mesh, p);
                QVERIFY(density.at(p.triangle, uv) == then.at(p.triangle, uv));
                QVERIFY(density.groupAt(uv) == then.groupAt(uv));
            }
        }
        QVERIFY(updates >= 12);
        // Small dabs measure little of a mesh of many triangles.
        if (shape == 0) QVERIFY2(measured < updates * mesh.triangleCount() / 4, qPrintable(QString::number(measured)));
    }

    void whatIsNotTouchedSamplesAsBefore() {
        Map before(100, 70, 1, TexelFormat::U8, 0.3f);
        for (const bool flip : {false, true}) {
            before.flipV = flip;
            Map after = before;
            for (int i = 0; i < 400; ++i) after.setTexel(40 + i % 20, 30 + i / 20, 0, 1.0f);
            after.setTexel(0, 69, 0, 1.0f);
            TouchedUvs where;
            for (const TexelRect& rect : changedTexels(before, after)) where.add(after, rect);
            std::size_t yes = 0, differ = 0;
            for (std::uint64_t i = 0; i < 200000; ++i) {
                const glm::vec2 uv(random(i, 20) * 4.0f - 2.0f, random(i, 21) * 4.0f - 2.0f);
                const bool differs =
                    before.sample(uv) != after.sample(uv) || before.sampleNearest(uv) != after.sampleNearest(uv);
                yes += where.at(uv) ? 1 : 0;
                differ += differs ? 1 : 0;
                if (differs) QVERIFY(where.at(uv));
            }
            QVERIFY2(differ > 1000 && yes < 3 * differ, qPrintable(QString("%1 %2").arg(differ).arg(yes)));
        }
        QVERIFY(changedTexels(before, before).empty());
        QVERIFY(!TouchedUvs().at({0.5f, 0.5f}));
    }

    void severalRangesAreThoseOneByOne() {
        const Groom groom = densityGroom(testing::sphere(20, 30), testing::painted(testing::Paint::Noise, 64));
        const RootSampler sampler = samplerOf(groom);
        const RootRequest request{3000.0, 5};
        const std::vector<RootRange> ranges{
            {10, 500000000}, {500000000, 500000000}, {900000000, 900000100}, {4000000000u, SurfaceCurve::end}};
        RootList all, one;
        std::vector<std::size_t> ends;
        sampler.sample(request, ranges, all, ends);
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            sampler.sample(request, ranges[i], one);
            QCOMPARE(one.count(), ends[i]);
        }
        for (std::size_t i = 0; i < all.count(); ++i) QVERIFY(all.id(i) == one.id(i) && all.point(i) == one.point(i));
    }
};

QTEST_APPLESS_MAIN(SamplerUpdateTest)
#include "sampler_update_test.moc"
