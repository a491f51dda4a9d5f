// SPDX-License-Identifier: Apache-2.0
// Laws of the C interface: the document's hair for any part, order, block and number of threads; sentences otherwise.
#include "core/hair/generate.h"
#include "core/io/document.h"
#include "tests/core/procedural/procedural_hair.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <cstring>
#include <limits>
#include <thread>

using namespace whorl;
using namespace whorl::testing;
namespace fs = std::filesystem;

namespace {

Groom animatedGroom() {
    Groom groom = groomOn(sphere(8, 12), 30, 9);
    groom.counts.edit().hairs = 400;
    HairParams& params = groom.groups.edit()[0].params;
    params.general.keepOutside = false;
    params.general.randomScale.value = 0.5f;
    params.frizz.root.value = 0.002f;
    params.frizz.tip.value = 0.02f;
    params.frizz.animation.value = 1.0f;
    params.frizz.speed.value = 1.0f;
    params.strands.hairs = 3;
    params.strands.tipSplay.value = 0.004f;
    return groom;
}

}  // namespace

class ProceduralTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theHairIsThatOfTheDocument() {
        const fs::path folder = scratchFolder("procedural-same");
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const Groom groom = randomGroom(seed);
            Progress progress;
            const std::uint64_t digest = *hairDigest(groom, 1, std::nullopt, progress);
            const fs::path package = exported(groom, folder / (std::to_string(seed) + ".groom"), 1 + seed);
            const fs::path document = folder / (std::to_string(seed) + ".whorl");
            QVERIFY(saveDocument(groom, document, progress).ok());
            const auto bytes = documentBytes(groom);
            const Opened ofPackage(package), ofDocument(document), ofMemory(bytes.data(), bytes.size());
            QCOMPARE(whorl_part_count(ofPackage), 1 + seed);
            QCOMPARE(whorl_hairs_asked(ofPackage), std::uint64_t(groom.counts->hairs));
            QCOMPARE(whorl_group_count(ofPackage), std::uint32_t(groom.groups->size()));
            QCOMPARE(std::string(whorl_group_name(ofPackage, 0)), groom.groups->front().name);
            QVERIFY(!whorl_group_name(ofPackage, 1000) && !whorl_warning(ofPackage, 0));
            for (const Opened* opened : {&ofPackage, &ofDocument, &ofMemory}) {
                QVERIFY2(*opened, opened->error.text);
                WhorlRequest request = WHORL_REQUEST_INIT;
                request.part_count = 1;
                std::uint64_t made = 0;
                QCOMPARE(whorl_digest(*opened, &request, &made, nullptr), WHORL_OK);
                QCOMPARE(made, digest);
            }
        }
    }

    void partsInAnyOrderAreTheWhole() {
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const Groom groom = randomGroom(seed);
            Progress progress;
            const Strands all = *Generator().generate(groom, {}, progress);
            const Opened opened(exported(groom, scratchFolder("procedural-parts") / "a.groom", 5));
            for (const std::uint32_t partCount : {0u, 1u, 3u, 64u}) {
                WhorlRequest request = WHORL_REQUEST_INIT;
                request.part_count = partCount;
                const std::uint32_t parts = partCount ? partCount : 5;
                std::vector<Filled> filled(parts);
                for (std::uint32_t i = parts; i-- > 0;) {
                    request.part = i;
                    request.flags = i % 2 ? WHORL_ONE_THREAD : 0u;
                    filled[i] = fill(opened, request);
                    QVERIFY2(filled[i].status == WHORL_OK, filled[i].error.text);
                }
                Filled whole;
                for (const Filled& part : filled) whole.append(part);
                QVERIFY(whole.equals(all));
            }
        }
    }

    void blocksOfAnySizeAreTheSame() {
        for (std::uint32_t seed = 4; seed < 7; ++seed) {
            const Opened opened(exported(randomGroom(seed), scratchFolder("procedural-blocks") / "a.groom", 2));
            WhorlRequest request = WHORL_REQUEST_INIT;
            const Filled whole = fill(opened, request);
            for (const std::uint32_t block : {1u, 7u, 100u, 100000u, 0xffffffffu}) {
                request.block_hairs = block;
                Filled streamed;
                const auto add = [](const WhorlHair* hair, void* to) {
                    static_cast<Filled*>(to)->append(*hair, 1);
                    return 0;
                };
                QCOMPARE(whorl_stream(opened, &request, add, &streamed, nullptr), WHORL_OK);
                QVERIFY(streamed == whole);
            }
        }
    }

    void manyThreadsAtOnce() {
        const Opened opened(exported(animatedGroom(), scratchFolder("procedural-threads") / "a.groom", 4));
        const float times[] = {0.0f, 0.05f};
        const auto requestOf = [&](std::uint32_t i) {
            WhorlRequest request = WHORL_REQUEST_INIT;
            request.part = i % 4;
            request.flags = i & 4 ? WHORL_ONE_THREAD : 0u;
            request.times = times;
            request.time_count = i & 8 ? 2 : 1;
            return request;
        };
        constexpr std::uint32_t calls = 16;
        std::vector<Filled> alone(calls), together(calls);
        std::vector<std::array<float, 6>> boxes(calls), boxesTogether(calls);
        for (std::uint32_t i = 0; i < calls; ++i) {
            const WhorlRequest request = requestOf(i);
            alone[i] = fill(opened, request);
            whorl_box(opened, &request, boxes[i].data(), nullptr);
        }
        std::vector<std::thread> threads;
        for (std::uint32_t i = 0; i < calls; ++i) {
            threads.emplace_back([&, i] {
                const WhorlRequest request = requestOf(i);
                together[i] = fill(opened, request);
                whorl_box(opened, &request, boxesTogether[i].data(), nullptr);
            });
        }
        for (std::thread& thread : threads) thread.join();
        for (std::uint32_t i = 0; i < calls; ++i) {
            QVERIFY(together[i].status == WHORL_OK && together[i].ids.size() > 20);
            QVERIFY(together[i] == alone[i]);
            QVERIFY(boxes[i] == boxesTogether[i]);
        }
    }

    void fewerHairsAreAmongMore() {
        const Opened opened(exported(animatedGroom(), scratchFolder("procedural-share") / "a.groom", 1));
        WhorlRequest request = WHORL_REQUEST_INIT;
        Filled more = fill(opened, request);
        for (const float share : {0.7f, 0.3f, 0.05f, 0.0f}) {
            request.share = share;
            const Filled fewer = fill(opened, request);
            QCOMPARE(fewer.status, WHORL_OK);
            QVERIFY(std::ranges::includes(sorted(more.ids), sorted(fewer.ids)));
            const double expected = 400.0 * 3.0 * static_cast<double>(share);
            QVERIFY(std::abs(static_cast<double>(fewer.ids.size()) - expected) <= 0.15 * expected + 6.0);
            if (!fewer.ids.empty()) QVERIFY(fewer.widths[0] > more.widths[0]);
            more = fewer;
        }
        QCOMPARE(whorl_share_for_count(opened, 100), 0.25f);
        QCOMPARE(whorl_share_for_count(opened, 1000), 1.0f);
        // An eighth of a pixel wide: 0.06 mm at 500 pixels a metre are 0.03 pixels.
        QVERIFY(std::abs(whorl_share_for_scale(opened, 500.0f) - 0.24f) < 1e-4f);
        QCOMPARE(whorl_share_for_scale(opened, 1e9f), 1.0f);
        const float infinite = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
        for (const float number : {infinite, none, -1.0f, 0.0f}) QCOMPARE(whorl_share_for_scale(opened, number), 1.0f);
        const float cube[6] = {0, 0.1f, 0, 0.1f, 0, 0.1f};
        // A cube of 0.1 m shows 0.015 square metres on average: 3750 pixels at 500 a metre.
        QVERIFY(std::abs(whorl_share_for_pixels(opened, cube, 3750.0f) - 0.24f) < 1e-4f);
        QCOMPARE(whorl_share_for_pixels(opened, cube, infinite), 1.0f);
        QCOMPARE(whorl_share_for_pixels(opened, nullptr, 1.0f), 1.0f);
    }

    void motionSamplesHaveTheSameVertices_data() {
        QTest::addColumn<double>("skip");
        QTest::newRow("all") << 0.0;
        QTest::newRow("skipped") << 0.03;
    }
    void motionSamplesHaveTheSameVertices() {
        QFETCH(double, skip);
        Groom groom = animatedGroom();
        groom.groups.edit()[0].params.general.skipThreshold = static_cast<float>(skip);
        const Opened opened(exported(groom, scratchFolder("procedural-motion") / "a.groom", 2));
        QCOMPARE(whorl_is_animated(opened), 1);
        const float times[] = {0.0f, 0.3f, 1.1f};
        WhorlRequest request = WHORL_REQUEST_INIT;
        request.times = times;
        request.time_count = 3;
        const Filled moving = fill(opened, request, 3);
        QVERIFY2(moving.status == WHORL_OK, moving.error.text);
        const std::size_t vertices = moving.widths.size();
        float box[6];
        QCOMPARE(whorl_box(opened, &request, box, nullptr), WHORL_OK);
        float moved = 0.0f;
        for (std::size_t s = 0; s < 3; ++s) {
            request.times = &times[s];
            request.time_count = 1;
            const Filled still = fill(opened, request);
            QVERIFY(still.ids == moving.ids && still.members == moving.members && still.rootUvs == moving.rootUvs);
            if (skip > 0.0) QVERIFY(still.widths.size() < 1200 * 10 && vertices >= still.widths.size());
            for (std::size_t i = 0, at = 0, from = 0; i < still.ids.size(); ++i) {
                // Ends stay the same; without skipping every vertex does.
                const float* ours = &moving.positions[3 * (s * vertices + at)];
                const float* theirs = &still.positions[3 * from];
                const std::size_t n = moving.counts[i], m = still.counts[i];
                QVERIFY(std::equal(ours, ours + 3, theirs));
                QVERIFY(std::equal(ours + 3 * (n - 1), ours + 3 * n, theirs + 3 * (m - 1)));
                if (skip == 0.0) QVERIFY(n == m && std::equal(ours, ours + 3 * n, theirs));
                moved = std::max(moved, std::abs(ours[3 * n - 3] - moving.positions[3 * (at + n) - 3]));
                at += n;
                from += m;
            }
            for (std::size_t v = 0; v < vertices; ++v) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const float x = moving.positions[3 * (s * vertices + v) + axis];
                    QVERIFY(x >= box[2 * axis] && x <= box[2 * axis + 1]);
                }
            }
        }
        QVERIFY(moved > 0.005f);
    }

    void overridesChangeParameters() {
        Groom groom = animatedGroom();
        const fs::path package = exported(groom, scratchFolder("procedural-override") / "a.groom", 2);
        const Opened opened(package, R"({"counts/hairs": 150, "groups/hair/colour/root": [0.5, 0.25, 1],
                                         "groups/hair/strands/hairs": 0, "counts/parts": 7})");
        QVERIFY2(opened, opened.error.text);
        groom.counts.edit().hairs = 150;
        groom.groups.edit()[0].params.strands.hairs = 0;
        groom.groups.edit()[0].params.colour.root.value = {0.5f, 0.25f, 1.0f};
        Progress progress;
        WhorlRequest request = WHORL_REQUEST_INIT;
        QCOMPARE(whorl_part_count(opened), 7u);
        request.part_count = 1;
        QVERIFY(fill(opened, request).equals(*Generator().generate(groom, {}, progress)));
        float box[6];
        QCOMPARE(whorl_box(opened, &request, box, nullptr), WHORL_OK);
        const Bounds bounds = Generator().generate(groom, {}, progress)->bounds();
        QVERIFY(box[0] == bounds.min.x && box[5] == bounds.max.z);
        for (const char* bad :
             {"{", "[]", "7", R"({"counts/hair": 1})", R"({"counts/hairs": -5})", R"({"counts/hairs": {}})",
              R"({"groups/none/frizz/tip": 1})", R"({"counts/hairs": 1e300})",
              R"({"groups/hair/general/density/map": "none"})", "{\"counts/hairs\": nan}"}) {
            const Opened refused(package, bad);
            QVERIFY(!refused && std::string(refused.error.text).starts_with("overrides"));
            QCOMPARE(refused.status, WHORL_BAD_ARGUMENT);
        }
        const std::string deep(100000, '[');
        QVERIFY(!Opened(package, deep.c_str()));
    }

    void buffersOfTheWrongSizeAreRefused() {
        const Opened opened(exported(animatedGroom(), scratchFolder("procedural-sizes") / "a.groom", 2));
        WhorlRequest request = WHORL_REQUEST_INIT;
        std::uint64_t hairs = 0, vertices = 0;
        QCOMPARE(whorl_count(opened, &request, &hairs, &vertices, nullptr), WHORL_OK);
        // The guards behind the arrays stay.
        std::vector<std::uint32_t> ids(hairs + 1, 77u);
        std::vector<float> positions(3 * vertices + 1, 77.0f);
        const auto tried = [&](std::uint64_t h, std::uint64_t v) {
            WhorlHair hair = WHORL_HAIR_INIT;
            hair.hairs = h;
            hair.vertices = v;
            hair.ids = ids.data();
            hair.positions = positions.data();
            WhorlError error;
            const WhorlStatus status = whorl_fill(opened, &request, &hair, &error);
            return status == WHORL_BAD_SIZE && !std::strstr(error.text, "whorl_count") ? WHORL_OK : status;
        };
        QCOMPARE(tried(hairs, vertices), WHORL_OK);
        for (const auto& [h, v] : std::vector<std::pair<std::uint64_t, std::uint64_t>>{
                 {0, 0}, {hairs - 1, vertices}, {hairs, vertices - 1}, {hairs + 1, vertices}, {hairs, vertices + 1}})
            QCOMPARE(tried(h, v), WHORL_BAD_SIZE);
        QVERIFY(ids.back() == 77u && positions.back() == 77.0f);
        WhorlHair nothing = WHORL_HAIR_INIT;
        nothing.hairs = hairs;
        nothing.vertices = vertices;
        QCOMPARE(whorl_fill(opened, &request, &nothing, nullptr), WHORL_OK);
        nothing.struct_size = 8;
        QCOMPARE(whorl_fill(opened, &request, &nothing, nullptr), WHORL_BAD_ARGUMENT);
    }

    void callsWithoutSenseAreRefused() {
        const Opened opened(exported(animatedGroom(), scratchFolder("procedural-calls") / "a.groom", 2));
        const auto refused = [&](auto&& change) {
            WhorlRequest request = WHORL_REQUEST_INIT;
            change(request);
            float box[6];
            WhorlError error{"untouched"};
            return whorl_box(opened, &request, box, &error) == WHORL_BAD_ARGUMENT && std::strlen(error.text) > 10;
        };
        const float bad[] = {std::numeric_limits<float>::quiet_NaN()};
        QVERIFY(!refused([](WhorlRequest&) {}));
        QVERIFY(refused([](WhorlRequest& r) { r.part = 2; }));
        QVERIFY(refused([](WhorlRequest& r) { r.part_count = 4097; }));
        QVERIFY(refused([](WhorlRequest& r) { r.part = 0xffffffffu, r.part_count = 0xffffffffu; }));
        QVERIFY(refused([](WhorlRequest& r) { r.share = 1.1f; }));
        QVERIFY(refused([&](WhorlRequest& r) { r.share = bad[0]; }));
        QVERIFY(refused([&](WhorlRequest& r) { r.times = bad, r.time_count = 1; }));
        QVERIFY(refused([](WhorlRequest& r) { r.time_count = 1; }));
        QVERIFY(refused([&](WhorlRequest& r) { r.times = bad, r.time_count = 65; }));
        QVERIFY(refused([](WhorlRequest& r) { r.struct_size = 0; }));
        WhorlRequest request = WHORL_REQUEST_INIT;
        WhorlGroom* groom = nullptr;
        std::uint64_t digest = 0;
        QCOMPARE(whorl_box(opened, &request, nullptr, nullptr), WHORL_BAD_ARGUMENT);
        QCOMPARE(whorl_box(opened, nullptr, nullptr, nullptr), WHORL_BAD_ARGUMENT);
        QCOMPARE(whorl_count(nullptr, &request, nullptr, nullptr, nullptr), WHORL_BAD_ARGUMENT);
        QCOMPARE(whorl_fill(opened, &request, nullptr, nullptr), WHORL_BAD_ARGUMENT);
        QCOMPARE(whorl_stream(opened, &request, nullptr, nullptr, nullptr), WHORL_BAD_ARGUMENT);
        QCOMPARE(whorl_digest(opened, &request, nullptr, nullptr), WHORL_BAD_ARGUMENT);
        QCOMPARE(whorl_digest(nullptr, &request, &digest, nullptr), WHORL_BAD_ARGUMENT);
        QCOMPARE(whorl_open(nullptr, nullptr, &groom, nullptr), WHORL_BAD_ARGUMENT);
        QCOMPARE(whorl_open("x", nullptr, nullptr, nullptr), WHORL_BAD_ARGUMENT);
        QCOMPARE(whorl_open_memory(nullptr, 5, nullptr, &groom, nullptr), WHORL_BAD_ARGUMENT);
        whorl_close(nullptr);
        QCOMPARE(whorl_part_count(nullptr), 0u);
        QVERIFY(whorl_version() / 65536 == WHORL_API_MAJOR && std::strlen(whorl_version_text()) > 0);
    }

    void framesKeepTheirBoxes() {
        const Groom groom = animatedGroom();
        const fs::path package = scratchFolder("procedural-frames") / "a.groom";
        Progress progress;
        const PackageFrames frames{-1, 3, 23.976};
        QVERIFY(exportPackage(groom, package, 2, progress, nullptr, frames).ok());
        const auto read = openPackage(package, progress);
        QVERIFY(read.ok() && read->frames == frames && read->parts[1].frameBounds.size() == 5);
        const Opened opened(package);
        QVERIFY2(opened, opened.error.text);
        std::int32_t first = 0, last = 0;
        double perSecond = 0.0;
        QVERIFY(whorl_frames(opened, &first, &last, &perSecond) == 1 &&
                whorl_frames(opened, nullptr, nullptr, nullptr) == 1);
        QVERIFY(first == -1 && last == 3 && perSecond == 23.976);
        std::vector<glm::vec3> corners;
        for (int frame = -1; frame <= 3; ++frame) {
            const float time = static_cast<float>(frame / perSecond);
            const Bounds hair =
                Generator().generate(groom, {.part = 1, .partCount = 2, .time = time}, progress)->bounds();
            const Bounds stored = read->parts[1].frameBounds[static_cast<std::size_t>(frame + 1)];
            QVERIFY(hair.min == stored.min && hair.max == stored.max);
            WhorlRequest request = WHORL_REQUEST_INIT;
            request.part = 1;
            request.times = &time;
            request.time_count = 1;
            float box[6];
            QCOMPARE(whorl_box(opened, &request, box, nullptr), WHORL_OK);
            QVERIFY(box[0] == hair.min.x && box[3] == hair.max.y && box[5] == hair.max.z);
            corners.push_back(hair.min);
        }
        QVERIFY(corners[0] != corners[4]);
        for (const PackageFrames& bad :
             {PackageFrames{0, 10000, 24.0}, PackageFrames{0, 1, 0.0}, PackageFrames{0, 1, std::nan("")}})
            QVERIFY(!exportPackage(groom, package, 2, progress, nullptr, bad).ok());
        QVERIFY(!whorl_frames(Opened(exported(groom, package, 2)), &first, &last, &perSecond));
    }

    void theCallbackStops() {
        const Opened opened(exported(animatedGroom(), scratchFolder("procedural-stop") / "a.groom", 1));
        WhorlRequest request = WHORL_REQUEST_INIT;
        request.block_hairs = 50;
        int blocks = 0;
        WhorlError error{""};
        const auto stop = [](const WhorlHair* hair, void* count) {
            // Calls from inside are allowed.
            return hair->hairs <= 50 && whorl_version() > 0 && ++*static_cast<int*>(count) < 3 ? 0 : 1;
        };
        QCOMPARE(whorl_stream(opened, &request, stop, &blocks, &error), WHORL_STOPPED);
        QCOMPARE(blocks, 3);
        QVERIFY(std::strlen(error.text) > 0);
    }

    void theSentenceIsCutBetweenCharacters() {
        const std::string longName = "/none/" + [] {
            std::string name;
            for (int i = 0; i < 400; ++i) name += "髪";
            return name;
        }();
        for (const std::string& name : {longName, "a" + longName, "ab" + longName}) {
            WhorlGroom* groom = nullptr;
            WhorlError error;
            QCOMPARE(whorl_open(name.c_str(), nullptr, &groom, &error), WHORL_BAD_FILE);
            QVERIFY(!groom && std::strlen(error.text) > 500);
            QCOMPARE(QString::fromUtf8(error.text).toUtf8(), QByteArray(error.text));
        }
    }
};

QTEST_APPLESS_MAIN(ProceduralTest)
#include "procedural_test.moc"
