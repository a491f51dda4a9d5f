// SPDX-License-Identifier: Apache-2.0
#include "core/lic/live_texture.h"

#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>

namespace whorl {
namespace {

constexpr int size = 256;

std::shared_ptr<const LicTexture> fresh(const Groom& groom, const std::shared_ptr<const Surface>& surface) {
    Progress progress;
    auto made = LiveTexture().update(groom, surface, size, progress);
    return made ? *made : nullptr;
}

template <class T>
bool same(const LicTexture::Layer<T>& a, const LicTexture::Layer<T>& b) {
    return a && b ? *a == *b : a == b;
}

bool same(const LicTexture& a, const LicTexture& b) {
    return a.size == b.size && same(a.light, b.light) && same(a.cover, b.cover) && same(a.colours, b.colours) &&
           same(a.cornerUvs, b.cornerUvs) && same(a.tangents, b.tangents) && same(a.sides, b.sides) &&
           a.mean == b.mean && a.deviation == b.deviation;
}

}  // namespace

class LiveTextureTest : public QObject {
    Q_OBJECT

    Groom m_groom;
    std::shared_ptr<const Surface> m_surface;

    FieldStroke stroke(std::initializer_list<glm::vec3> points) const {
        FieldStroke made;
        made.id = 1;
        const std::vector<glm::vec3> line(points);
        if (auto traced = tracedParting(*m_surface, line)) made.points = std::move(*traced);
        return made;
    }

private Q_SLOTS:
    void init() {
        m_groom = testing::groomOn(testing::sphere(32, 48), 60);
        m_surface = std::make_shared<Surface>(m_groom.mesh);
    }

    void everyChangeGivesWhatAFreshOneGives() {
        LiveTexture live;
        Progress progress;
        const auto follow = [&](const char* what) {
            auto made = live.update(m_groom, m_surface, size, progress);
            QVERIFY2(made.ok(), what);
            QVERIFY2(same(**made, *fresh(m_groom, m_surface)), what);
        };
        follow("as it was");
        m_groom.strokes.edit().push_back(stroke({{0.0f, 0.05f, 0.09f}, {0.06f, 0.0f, 0.08f}}));
        follow("a stroke");
        m_groom.lic.edit().grain.value = 0.003f;
        follow("grain");
        m_groom.lic.edit().specular = 0.9f;
        follow("light");
        Parting parting;
        parting.id = 1;
        parting.points = stroke({{0.0f, 0.08f, 0.06f}, {0.0f, 0.0f, 0.1f}, {0.0f, -0.05f, 0.09f}}).points;
        m_groom.partings.edit().push_back(parting);
        follow("a parting");
        m_groom.maps.set("density", Map(64, 64, 1, TexelFormat::U8, 1.0f));
        m_groom.groups.edit()[0].params.general.density.map = "density";
        follow("a density map");
        for (int y = 20; y < 40; ++y)
            for (int x = 10; x < 30; ++x) m_groom.maps.edit("density")->setTexel(x, y, 0, 0.0f);
        follow("a bald spot");
        m_groom.groups.edit()[0].params.colour.tip.value = glm::vec3(0.5f, 0.1f, 0.1f);
        follow("colour");
        m_groom.field.edit().follow = true;
        follow("combing leads");
        m_groom.guides.editPoints(5)[9] += glm::vec3(0.02f, 0.01f, 0.0f);
        follow("a combed guide");
        m_groom.partings = {};
        follow("no parting");
    }

    void nothingNewIsTheSameObject() {
        LiveTexture live;
        Progress progress;
        const auto first = live.update(m_groom, m_surface, size, progress);
        QVERIFY(first.ok());
        m_groom.counts.edit();  // another object that says the same
        QVERIFY(*live.update(m_groom, m_surface, size, progress) != nullptr);
        const auto second = live.update(m_groom, m_surface, size, progress);
        QCOMPARE(*live.update(m_groom, m_surface, size, progress), *second);
        QCOMPARE((*second)->light, (*first)->light);
        // Guides say nothing where strokes lead.
        m_groom.strokes.edit().push_back(stroke({{0.0f, 0.05f, 0.09f}, {0.06f, 0.0f, 0.08f}}));
        Groom combed = m_groom;
        combed.guides.editPoints(3)[4].y += 0.01f;
        QVERIFY(!LiveTexture::differs(m_groom, combed));
        combed.field.edit().follow = true;
        QVERIFY(LiveTexture::differs(m_groom, combed));
    }

    void cornersBeyondAPartingAreMarked() {
        QVERIFY(fresh(m_groom, m_surface)->sides == nullptr);
        Parting parting;
        parting.id = 1;
        // Beside the vertices, which lie on x = 0.
        parting.points = stroke({{0.003f, 0.07f, 0.07f}, {0.003f, 0.0f, 0.1f}, {0.003f, -0.07f, 0.07f}}).points;
        m_groom.partings.edit().push_back(parting);
        const auto texture = fresh(m_groom, m_surface);
        QVERIFY(texture->sides && texture->sides->size() == std::size_t{size} * size);
        const auto parted = std::ranges::count_if(*texture->sides, [](std::uint8_t s) { return (s & 7) != 7; });
        // Only texels of triangles along the line.
        QVERIFY2(parted > 50 && parted < size * size / 20, qPrintable(QString::number(parted)));
        QVERIFY(std::ranges::all_of(*texture->sides, [](std::uint8_t s) { return (s & 7) != 0; }));
    }

    void cancelledItSaysSoAndGoesOnLater() {
        LiveTexture live;
        Progress stopped;
        stopped.cancel();
        QVERIFY(!live.update(m_groom, m_surface, size, stopped));
        Progress progress;
        const auto made = live.update(m_groom, m_surface, size, progress);
        QVERIFY(made.ok() && same(**made, *fresh(m_groom, m_surface)));
    }
};

}  // namespace whorl

QTEST_APPLESS_MAIN(whorl::LiveTextureTest)
#include "live_texture_test.moc"
