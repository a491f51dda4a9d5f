// SPDX-License-Identifier: Apache-2.0
// Hair texture in the real window: the switch in the View panel, and that it follows parameters and guides.
#include "core/io/document.h"
#include "core/param/path.h"
#include "editor/app/exports.h"
#include "editor/app/files.h"
#include "editor/app/widgets/param_form.h"
#include "tests/editor/window.h"

#include <QComboBox>
#include <QTest>
#include <algorithm>
#include <cstdlib>

using namespace whorl;

class LicViewTest : public QObject, private testing::WindowFixture {
    Q_OBJECT

    QImage picture() {
        [&] { QVERIFY(testing::settle(*m_window)); }();
        QImage image = view().grabFramebuffer().convertToFormat(QImage::Format_RGB32);
        // Without the line of text, which tells times.
        return image.copy(0, 0, image.width(), image.height() - 40);
    }

    static int differing(const QImage& a, const QImage& b) {
        int count = 0;
        for (int y = 0; y < a.height(); ++y) {
            for (int x = 0; x < a.width(); ++x) {
                const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
                const int most = std::max(
                    {std::abs(qRed(p) - qRed(q)), std::abs(qGreen(p) - qGreen(q)), std::abs(qBlue(p) - qBlue(q))});
                count += most > 8;
            }
        }
        return count;
    }

    /// As an artist picks it, by the name that the list shows.
    void choose(const char* name) {
        auto* list = find<QComboBox>("hair_as_choice");
        QVERIFY(list);
        const int index = list->findText(name);
        QVERIFY(index >= 0);
        list->setCurrentIndex(index);
        Q_EMIT list->activated(index);
    }

private Q_SLOTS:
    void initTestCase() {
        m_folder = testing::scratchFolder("lic_view_test");
        testing::useScratchSettings(m_folder);
        m_file = m_folder / "ball.whorl";
        Groom groom = testing::groomOn(testing::sphere(24, 32), 300);
        groom.counts.edit().hairs = 500;
        // Combed down.
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const auto points = groom.guides.editPoints(i);
            const glm::vec3 root = points[0];
            for (std::size_t k = 1; k < points.size(); ++k)
                points[k] = root * 1.05f - glm::vec3(0.0f, 0.003f * static_cast<float>(k), 0.0f);
        }
        Progress progress;
        QVERIFY(saveDocument(groom, m_file, progress).ok());
    }

    void init() {
        m_window = testing::openWindow(m_folder / "journals");
        QVERIFY(m_window);
        if (!m_window->viewport()) QSKIP("No viewport on this machine.");
        m_window->resize(900, 640);
        QVERIFY(m_window->files().open(m_file));
    }

    void cleanup() { close(); }

    void theSwitchShowsHairTextureOrBoth() {
        const QImage hair = picture();
        QVERIFY(!view().licTexture());
        choose("Texture");
        QVERIFY2(view().statusText().contains("painting hair texture"), qPrintable(view().statusText()));
        const QImage texture = picture();
        QVERIFY(!view().statusText().contains("painting"));
        QVERIFY(view().licTexture() && !view().licTexture()->empty());
        QVERIFY(!view().viewSettings().showHair && view().viewSettings().showLic);
        QVERIFY(differing(hair, texture) > 2000);
        choose("Both");
        const QImage both = picture();
        QVERIFY(view().viewSettings().showHair && view().viewSettings().showLic);
        QVERIFY(differing(both, texture) > 500);
        QVERIFY(differing(both, hair) > 500);
        choose("Hair");
        QCOMPARE(differing(picture(), hair), 0);
    }

    void renderedPicturesShowWhatTheViewShows() {
        const auto rendered = [&] {
            const std::filesystem::path file = m_folder / "rendered.png";
            [&] { QVERIFY(m_window->exports().renderPicture(file, 500, 400)); }();
            return QImage(textOf(file)).convertToFormat(QImage::Format_RGB32);
        };
        const QImage hair = rendered();
        QCOMPARE(hair.size(), QSize(500, 400));
        choose("Texture");
        const QImage texture = rendered();
        choose("Both");
        const QImage both = rendered();
        ViewOptions bare = m_window->state().viewOptions();
        bare.showHair = false;
        m_window->state().setViewOptions(bare);
        const QImage skin = rendered();
        QVERIFY(differing(texture, skin) > 5000);
        QVERIFY(differing(texture, hair) > 5000);
        QVERIFY(differing(both, hair) > 500);
        QVERIFY(differing(both, texture) > 500);
    }

    void itFollowsParameters() {
        choose("Texture");
        const QImage before = picture();
        const auto first = view().licTexture();
        const auto change = [&](const char* path, const ParamValue& value) {
            Groom after = document().committed();
            QVERIFY2(setGroomValue(after, path, value).ok(), path);
            document().edit(std::move(after), path);
        };
        // Light only: the picture changes, the texture is the one that was.
        Groom lit = document().committed();
        lit.lic.edit().ambient = 1.5f;
        document().edit(std::move(lit), "Ambient");
        QVERIFY(differing(picture(), before) > 2000);
        QVERIFY(view().licTexture()->light == first->light);
        document().undo();
        QCOMPARE(differing(picture(), before), 0);
        Groom coarse = document().committed();
        coarse.lic.edit().grain.value = 0.003f;
        document().edit(std::move(coarse), "Grain");
        QVERIFY(differing(picture(), before) > 500);
        QVERIFY(view().licTexture()->light != first->light);
        document().undo();
        QCOMPARE(differing(picture(), before), 0);
        change("groups/hair/colour/tip", glm::vec3(0.9f, 0.1f, 0.1f));
        QVERIFY(differing(picture(), before) > 2000);
    }

    void itFollowsTheCombWhileItMoves() {
        choose("Texture");
        const QImage before = picture();
        const auto first = view().licTexture();
        auto* comb = find<QAction>("tool.comb");
        QVERIFY(comb);
        comb->trigger();
        testing::drag(view(), {at(0.4, 0.4), at(0.6, 0.4)}, {}, Qt::LeftButton, false);
        // The stroke is not over.
        QVERIFY(document().previewing());
        QTRY_VERIFY(view().licTexture() != first);
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, at(0.6, 0.4));
        QVERIFY(differing(picture(), before) > 200);
    }
};

QTEST_MAIN(LicViewTest)
#include "lic_view_test.moc"
