// SPDX-License-Identifier: Apache-2.0
// Placing guides and the map that they follow.
#include "core/commands/command.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>

using namespace whorl;
using namespace whorl::testing;

class GuidesTest : public QObject {
    Q_OBJECT

    std::shared_ptr<const Surface> m_surface = std::make_shared<const Surface>(Cow<SurfaceMesh>(sphere(16, 32, 0.1f)));
    Groom bald() const {
        Groom groom = groomOn(sphere(16, 32, 0.1f), 3);
        groom.mesh = m_surface->shared;
        groom.guides.clear();
        return groom;
    }

private Q_SLOTS:
    void placedGuidesAreSoundEvenAndStandUp() {
        Groom groom = bald();
        Progress progress;
        QVERIFY(placeGuides(groom, *m_surface, 200, 0.03f, false, progress).ok());
        QCOMPARE(groom.guides.count(), std::size_t{200});
        QVERIFY(checkGroom(groom).empty());
        float nearest = 1e30f;
        for (std::size_t i = 0; i < 200; ++i) {
            const auto points = groom.guides.points(i);
            QCOMPARE(points.size(), std::size_t{16});
            QVERIFY(std::abs(glm::length(points.back() - points.front()) - 0.03f) < 1e-4f);
            QVERIFY(glm::dot(glm::normalize(points.back() - points.front()), glm::normalize(points.front())) > 0.98f);
            for (std::size_t k = 0; k < i; ++k) {
                nearest = std::min(nearest, glm::length(points[0] - groom.guides.points(k)[0]));
            }
        }
        QVERIFY(nearest > 0.005f);  // 200 on this ball are 25 mm apart on average
    }

    void theSameSeedGivesTheSameGuides() {
        Groom a = bald(), b = bald();
        Progress progress;
        QVERIFY(placeGuides(a, *m_surface, 60, 0.0f, false, progress).ok());
        QVERIFY(placeGuides(b, *m_surface, 60, 0.0f, false, progress).ok());
        QVERIFY(groomDigest(a) == groomDigest(b));
        b.counts.edit().seed = 2;
        QVERIFY(placeGuides(b, *m_surface, 60, 0.0f, false, progress).ok());
        QVERIFY(!std::ranges::equal(a.guides.points(0), b.guides.points(0)));
    }

    void toppingUpKeepsWhatIsThere() {
        Groom groom = bald();
        Progress progress;
        QVERIFY(placeGuides(groom, *m_surface, 40, 0.03f, false, progress).ok());
        const Groom before = groom;
        QVERIFY(placeGuides(groom, *m_surface, 100, 0.03f, true, progress).ok());
        QCOMPARE(groom.guides.count(), std::size_t{100});
        for (std::size_t i = 0; i < 40; ++i) {
            QCOMPARE(groom.guides.id(i), before.guides.id(i));
            QVERIFY(std::ranges::equal(groom.guides.points(i), before.guides.points(i)));
        }
        QVERIFY(checkGroom(groom).empty());
        const Groom same = groom;
        QVERIFY(placeGuides(groom, *m_surface, 50, 0.03f, true, progress).ok());
        QVERIFY(groom.sameAs(same));
    }

    void nothingGrowsWhereDensityIsZero() {
        Groom groom = bald();
        const std::string name = ensureDensityMap(groom, 0, 64, 1.0f);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 32; ++x) groom.maps.edit(name)->setTexel(x, y, 0, 0.0f);
        }
        Progress progress;
        QVERIFY(placeGuides(groom, *m_surface, 100, 0.0f, false, progress).ok());
        QVERIFY(groom.guides.count() > 50);
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            QVERIFY(groom.maps.find(name)->sample(uvAt(*groom.mesh, groom.guides.root(i))) > 0.0f);
        }
        groom.maps.set(name, Map(8, 8, 1, TexelFormat::U8, 0.0f));
        const Groom before = groom;
        QVERIFY(!placeGuides(groom, *m_surface, 100, 0.0f, false, progress).ok());
        QVERIFY(groom.sameAs(before));
        QVERIFY(!placeGuides(groom, *m_surface, 2000000, 0.0f, false, progress).ok());
    }

    void cancellingLeavesTheGroomAlone() {
        Groom groom = bald();
        Progress progress;
        progress.cancel();
        const Groom before = groom;
        const auto done = placeGuides(groom, *m_surface, 100, 0.0f, false, progress);
        QVERIFY(!done.ok() && done.error().cancelled);
        QVERIFY(groom.sameAs(before));
    }

    void aNewGuideTakesAfterItsNeighbours() {
        Groom groom = bald();
        const SurfacePoint root{200, 0.3f, 0.3f};
        const std::uint32_t id = addGuide(groom, *m_surface, root, 0, 0.02f);
        QCOMPARE(groom.guides.id(0), id);
        QVERIFY(std::abs(glm::length(groom.guides.points(0).back() - groom.guides.points(0).front()) - 0.02f) < 1e-5f);
        for (glm::vec3& p : groom.guides.editPoints(0).subspan(1)) p.y += 0.03f;
        addGuide(groom, *m_surface, {202, 0.3f, 0.3f}, 0, 0.02f);
        QVERIFY(checkGroom(groom).empty());
        const auto a = groom.guides.points(0), b = groom.guides.points(1);
        QVERIFY(glm::length((a.back() - a.front()) - (b.back() - b.front())) < 0.02f);
        QVERIFY(b.back().y - b.front().y > 0.02f);
    }

    void theDensityMapIsMadeOnce() {
        Groom groom = bald();
        groom.maps.set("density", Map(8, 8, 3, TexelFormat::U8, 0.5f));  // a colour map of that name stays
        const std::string name = ensureDensityMap(groom, 0, 128, 0.25f);
        QCOMPARE(name, std::string("density_2"));
        const Map* map = groom.maps.find(name);
        QVERIFY(map != nullptr && map->width() == 128 && map->channels() == 1 && map->format() == TexelFormat::U16);
        QVERIFY(std::abs(map->texel(3, 3) - 0.25f) < 1e-4f);
        QCOMPARE((*groom.groups)[0].params.general.density.map, name);
        const Groom before = groom;
        QCOMPARE(ensureDensityMap(groom, 0, 64, 1.0f), name);
        QVERIFY(groom.sameAs(before));
    }
};

QTEST_APPLESS_MAIN(GuidesTest)
#include "guides_test.moc"
