// SPDX-License-Identifier: Apache-2.0
// The laws of the document: preview, commit, revert, merge, undo exact, history limited in bytes.
#include "core/param/path.h"
#include "editor/app/document.h"
#include "tests/support/shapes.h"

#include <QSignalSpy>
#include <QTest>
#include <random>
#include <vector>

using namespace whorl;

namespace {

Groom start() {
    return testing::groomOn(testing::sphere(8, 12), 40);
}

/// One random edit of another part of the groom each time.
Groom edited(Groom groom, std::mt19937& random) {
    const auto upTo = [&](std::size_t n) { return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1)); };
    switch (random() % 6) {
        case 0:
            groom.counts.edit().hairs = static_cast<int>(random() % 100000);
            break;
        case 1:
            groom.groups.edit().front().params.frizz.tip.value = static_cast<float>(random() % 1000) * 1e-5f;
            break;
        case 2:
            if (!groom.guides.empty()) {
                groom.guides.editPoints(upTo(groom.guides.count())).back().y += 0.001f;
            }
            break;
        case 3:
            if (groom.guides.count() > 3) {
                const std::size_t gone[] = {upTo(groom.guides.count())};
                groom.guides.erase(gone);
            }
            break;
        case 4:
            if (!groom.maps.find("paint")) groom.maps.set("paint", Map(256, 256, 1, TexelFormat::U8, 0.0f));
            groom.maps.edit("paint")->setTexel(static_cast<int>(upTo(256)), static_cast<int>(upTo(256)), 0, 1.0f);
            break;
        default:
            groom.partSettings.edit().front().growsHair = !groom.partSettings->front().growsHair;
    }
    return groom;
}

}  // namespace

class EditorDocumentTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void previewIsNoStep() {
        Document document;
        document.reset(start(), {});
        const std::uint64_t before = testing::groomDigest(document.groom());
        std::mt19937 random(1);
        document.preview(edited(document.committed(), random));
        QVERIFY(document.previewing());
        QCOMPARE(document.history().count(), 0);
        document.revert();
        QVERIFY(!document.previewing());
        QCOMPARE(testing::groomDigest(document.groom()), before);
        QVERIFY(document.clean());
    }

    void commitOfNothingIsNoStep() {
        Document document;
        document.reset(start(), {});
        document.edit(document.committed(), "Nothing");
        QCOMPARE(document.history().count(), 0);
        document.commit("Without a preview");
        QCOMPARE(document.history().count(), 0);
    }

    void everyChangeIsSaid() {
        Document document;
        document.reset(start(), {});
        QSignalSpy changed(&document, &Document::changed);
        std::mt19937 random(2);
        document.preview(edited(document.committed(), random));
        QCOMPARE(changed.count(), 1);
        document.commit("Edit");
        QVERIFY(changed.count() >= 2);
        const auto count = changed.count();
        document.undo();
        QVERIFY(changed.count() > count);
    }

    void sameKeyMerges() {
        Document document;
        document.reset(start(), {});
        const std::uint64_t before = testing::groomDigest(document.groom());
        for (int i = 1; i <= 5; ++i) {
            Groom next = document.committed();
            next.counts.edit().seed = i + 10;
            document.edit(std::move(next), "Seed", "seed#1");
        }
        QCOMPARE(document.history().count(), 1);
        Groom next = document.committed();
        next.counts.edit().seed = 99;
        document.edit(std::move(next), "Seed", "seed#2");
        QCOMPARE(document.history().count(), 2);
        document.undo();
        document.undo();
        QCOMPARE(testing::groomDigest(document.groom()), before);
    }

    void savedStateDoesNotMergeAway() {
        Document document;
        document.reset(start(), {});
        Groom next = document.committed();
        next.counts.edit().seed = 5;
        document.edit(next, "Seed", "seed");
        document.markSaved("/x/y.whorl");
        QVERIFY(document.clean());
        next.counts.edit().seed = 6;
        document.edit(next, "Seed", "seed");
        QVERIFY(!document.clean());
        document.undo();
        QVERIFY(document.clean());
        QCOMPARE(document.committed().counts->seed, 5);
    }

    void undoDropsThePreview() {
        Document document;
        document.reset(start(), {});
        std::mt19937 random(3);
        document.edit(edited(document.committed(), random), "One");
        document.preview(edited(document.committed(), random));
        document.undo();
        QVERIFY(!document.previewing());
        QCOMPARE(document.history().index(), 0);
    }

    void randomEditsUndoAndRedoExactly() {
        // 2,000 edits with undo and redo in between; every state that comes back has the digest that it had.
        Document document;
        document.reset(start(), {});
        document.setUndoBytes(std::size_t{1} << 40);
        std::mt19937 random(20240);
        std::vector<std::uint64_t> digests{testing::groomDigest(document.groom())};
        for (int i = 0; i < 2000; ++i) {
            const auto dice = random() % 10;
            if (dice == 0 && document.history().canUndo()) {
                document.undo();
            } else if (dice == 1 && document.history().canRedo()) {
                document.redo();
            } else {
                Groom next = edited(document.committed(), random);
                document.preview(next);
                if (dice == 2) {
                    document.revert();
                } else {
                    const int index = document.history().index();
                    document.commit("Edit");
                    if (document.history().index() == index) continue;
                    digests.resize(static_cast<std::size_t>(index) + 1);
                    digests.push_back(testing::groomDigest(document.groom()));
                }
            }
            QCOMPARE(testing::groomDigest(document.groom()),
                     digests[static_cast<std::size_t>(document.history().index())]);
        }
        while (document.history().canUndo()) {
            document.undo();
            QCOMPARE(testing::groomDigest(document.groom()),
                     digests[static_cast<std::size_t>(document.history().index())]);
        }
        while (document.history().canRedo()) {
            document.redo();
            QCOMPARE(testing::groomDigest(document.groom()),
                     digests[static_cast<std::size_t>(document.history().index())]);
        }
    }

    void historyIsLimitedInBytes() {
        Document document;
        document.reset(start(), {});
        constexpr std::size_t limit = std::size_t{4} << 20;
        document.setUndoBytes(limit);
        std::vector<std::uint64_t> digests{testing::groomDigest(document.groom())};
        for (int i = 0; i < 60; ++i) {
            Groom next = document.committed();
            next.maps.set("big", Map(512, 512, 1, TexelFormat::U8, static_cast<float>(i % 2)));
            document.edit(std::move(next), "Fill");
            digests.push_back(testing::groomDigest(document.groom()));
            QVERIFY(document.bytesInHistory() <= limit);
            QVERIFY(!document.clean());
        }
        const int kept = document.history().count();
        QVERIFY2(kept >= 8 && kept < 60, qPrintable(QString::number(kept)));
        for (int i = 0; i < kept; ++i) {
            document.undo();
            QCOMPARE(testing::groomDigest(document.groom()), digests[static_cast<std::size_t>(60 - i - 1)]);
        }
        QVERIFY(!document.history().canUndo());
        QVERIFY(!document.clean());  // the saved state was forgotten
    }

    void trimmingKeepsTheSavedState() {
        Document document;
        document.reset(start(), {});
        document.setUndoBytes(std::size_t{2} << 20);
        for (int i = 0; i < 30; ++i) {
            Groom next = document.committed();
            next.maps.set("big", Map(512, 512, 1, TexelFormat::U8, static_cast<float>(i % 2)));
            document.edit(std::move(next), "Fill");
            document.markSaved("/x/y.whorl");
            QVERIFY(document.clean());
        }
        document.undo();
        QVERIFY(!document.clean());
        document.redo();
        QVERIFY(document.clean());
    }

    void oneHugeStepStays() {
        Document document;
        document.reset(start(), {});
        document.setUndoBytes(1);
        Groom next = document.committed();
        next.maps.set("big", Map(512, 512, 1, TexelFormat::U8, 1.0f));
        document.edit(std::move(next), "Fill");
        QVERIFY(document.history().canUndo());
    }

    void pathsSurviveText() {
        for (const char* name : {"/tmp/a b.whorl", "/tmp/hår\xE2\x80\xA6.whorl", "/tmp/\xFF\xFE.bin"}) {
            QCOMPARE(pathOf(textOf(std::filesystem::path("/tmp/a b.whorl"))), std::filesystem::path("/tmp/a b.whorl"));
            if (QByteArray(name).contains('\xFF')) continue;  // not text in any encoding; Qt has no name for it
            QCOMPARE(pathOf(textOf(std::filesystem::path(name))).string(), std::string(name));
        }
    }
};

QTEST_GUILESS_MAIN(EditorDocumentTest)
#include "editor_document_test.moc"
