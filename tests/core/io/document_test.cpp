// SPDX-License-Identifier: Apache-2.0
// Laws: what is saved opens equal and saves to the same bytes; what is damaged is refused, never half believed.
#include "core/io/document.h"

#include "core/base/hash.h"
#include "core/base/parallel.h"
#include "core/io/container.h"
#include "core/io/groom_codec.h"
#include "core/io/json_text.h"
#include "core/io/safe_file.h"
#include "tests/support/shapes.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <QElapsedTimer>
#include <QTest>
#include <cerrno>
#include <cmath>
#include <limits>

using namespace whorl;
using nlohmann::json;
namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

namespace {

constexpr ContainerKind kind{"WHORLDOC", 1, "a Whorl document"};

/// A document whose manifest went through `change`: right checksums, wrong contents.
template <class Change>
Bytes withManifest(const Groom& groom, Change&& change) {
    ContainerWriter writer;
    json manifest = encodeGroom(groom, writer);
    change(manifest);
    Progress progress;
    return *writer.finish(kind, jsonText(manifest), progress);
}

bool mentions(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

bool mentions(const Problems& problems, const std::string& words) {
    return std::any_of(problems.begin(), problems.end(), [&](const std::string& p) { return mentions(p, words); });
}

/// Laws that an opened groom obeys whatever was in the file; maps that are not there are told, not mended.
bool obeysLaws(const Groom& groom) {
    for (const std::string& problem : checkGroom(groom)) {
        if (!mentions(problem, "which is not there") && !mentions(problem, "has no triangles")) return false;
    }
    return true;
}

long peakKilobytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

/// Puts the right checksum into a header that was changed.
void reseal(Bytes& bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 12, 4);
    Hasher hasher;
    hasher.add(bytes.data(), 32);
    hasher.add(bytes.data() + 40, std::min<std::size_t>(std::size_t{count} * 32, bytes.size() - 40));
    const std::uint64_t digest = hasher.digest();
    std::memcpy(bytes.data() + 32, &digest, 8);
}

Groom smallGroom() {
    Groom groom = testing::groomOn(testing::plane(2), 3, 4);
    groom.maps.set("density", Map(70, 40, 1, TexelFormat::U8, 1.0f));
    groom.maps.edit("density")->setTexel(3, 4, 0, 0.5f);
    return groom;
}

}  // namespace

class DocumentTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void cleanup() { setFileFault({}); }

    void saveLoadSaveIsEqual() {
        for (std::uint32_t seed = 0; seed < 50; ++seed) {
            const Groom groom = testing::randomGroom(seed);
            const Bytes bytes = documentBytes(groom);
            QVERIFY(!bytes.empty());
            const auto opened = documentFromBytes(bytes, "a.whorl");
            QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
            QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(groom));
            QVERIFY2(opened->problems.empty(), opened->problems.empty() ? "" : opened->problems[0].c_str());
            QVERIFY(documentBytes(opened->groom) == bytes);
        }
    }

    void sameBytesOnAnyThreads() {
        Groom groom = testing::randomGroom(7);
        groom.maps.set("big", Map(1000, 900, 3, TexelFormat::F32, 0.25f));
        for (int i = 0; i < 900; ++i) groom.maps.edit("big")->setTexel(i, i, 1, std::sin(static_cast<float>(i)));
        const Bytes bytes = documentBytes(groom);
        for (const unsigned threads : {1u, 2u, 5u}) {
            const ThreadLimit limit(threads);
            QVERIFY(documentBytes(groom) == bytes);
        }
    }

    void emptyThings() {
        for (const Groom& groom : {Groom(), makeGroom(testing::plane(1))}) {
            const auto opened = documentFromBytes(documentBytes(groom), "a");
            QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
            QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(groom));
        }
        Groom groom = makeGroom(testing::plane(1));
        groom.maps.set("", Map());
        const auto opened = documentFromBytes(documentBytes(groom), "a");
        QVERIFY(opened.ok());
        QVERIFY(opened->groom.maps.find("") && opened->groom.maps.find("")->empty());
    }

    void namesOfAnyBytes() {
        SurfaceMesh mesh = testing::plane(1);
        mesh.parts[0].name = std::string("latin \xe9\xff and \0 zero", 18);
        mesh.parts[0].texture = "\xf4\x8f\x9e\x80 private";
        Groom groom = makeGroom(mesh);
        for (const char* name : {"\xf4\x8f\x9e\x80 private", "caf\xe9", "髪", "quote\" \\ \n", "\xed\xa0\x80"})
            groom.maps.set(name, Map(3, 3, 1, TexelFormat::U8, 0.0f));
        groom.groups.edit()[0].params.general.density.map = "caf\xe9";
        const auto opened = documentFromBytes(documentBytes(groom), "a");
        QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
        QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(groom));
    }

    void idsAndNextIdStay() {
        Groom groom = testing::groomOn(testing::plane(3), 9, 4);
        const std::vector<std::size_t> gone{0, 4, 8};
        groom.guides.erase(gone);
        const auto opened = documentFromBytes(documentBytes(groom), "a");
        QVERIFY(opened.ok());
        QCOMPARE(opened->groom.guides.nextId(), groom.guides.nextId());
        for (std::size_t i = 0; i < groom.guides.count(); ++i) QCOMPARE(opened->groom.guides.id(i), groom.guides.id(i));
    }

    void cutShortAtEveryLengthIsRefused() {
        const Bytes bytes = documentBytes(smallGroom());
        for (std::size_t length = 0; length < bytes.size(); ++length) {
            const auto opened = documentFromBytes(std::span(bytes).first(length), "cut.whorl");
            QVERIFY(!opened.ok());
            QVERIFY(mentions(opened.error().message, "cut.whorl"));
        }
        Bytes longer = bytes;
        longer.push_back(0);
        QVERIFY(!documentFromBytes(longer, "a").ok());
    }

    void anyChangedBitIsRefused() {
        Bytes bytes = documentBytes(smallGroom());
        for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
            bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
            QVERIFY2(!documentFromBytes(bytes, "a").ok(), std::to_string(bit).c_str());
            bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
        }
        QVERIFY(documentFromBytes(bytes, "a").ok());
    }

    void randomBytesUnderRightChecksums() {
        // Everything behind the header's checksum meets damaged tables too.
        const Bytes good = documentBytes(smallGroom());
        for (std::uint64_t round = 0; round < 3000; ++round) {
            Bytes bytes = good;
            const std::uint64_t dice = randomBits(1, round, 0);
            std::size_t at = 8 + dice % (bytes.size() - 8);
            if (round % 2) at = 8 + dice % 400;
            bytes[std::min(at, bytes.size() - 1)] = static_cast<std::uint8_t>(dice >> 32);
            reseal(bytes);
            const auto opened = documentFromBytes(bytes, "a");
            if (opened) QVERIFY(obeysLaws(opened->groom));
        }
    }

    void newerVersionsAreRefused() {
        Bytes bytes = documentBytes(smallGroom());
        bytes[8] = 2;
        for (int sealed = 0; sealed < 2; ++sealed) {
            const auto opened = documentFromBytes(bytes, "new.whorl");
            QVERIFY(!opened.ok());
            QVERIFY2(mentions(opened.error().message, "newer Whorl"), opened.error().message.c_str());
            reseal(bytes);
        }
        bytes[8] = 0;
        reseal(bytes);
        QVERIFY(!documentFromBytes(bytes, "a").ok());
    }

    void unknownKeysAreTold() {
        const Groom groom = smallGroom();
        const std::vector<std::string> places{"",        "/mesh",     "/guides",          "/maps/0",
                                              "/counts", "/groups/0", "/groups/0/params", "/groups/0/params/frizz"};
        for (const std::string& place : places) {
            const Bytes bytes =
                withManifest(groom, [&](json& manifest) { manifest[json::json_pointer(place)]["surprise"] = 5; });
            const auto opened = documentFromBytes(bytes, "a");
            QVERIFY2(opened.ok(), place.c_str());
            QVERIFY2(mentions(opened->problems, "surprise"), place.c_str());
            QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(groom));
        }
    }

    void wrongManifestsNeverCrash() {
        const std::vector<json> values{nullptr,
                                       true,
                                       -1,
                                       0,
                                       1,
                                       3,
                                       70,
                                       1e300,
                                       4294967295u,
                                       1.5,
                                       "u16",
                                       "",
                                       18446744073709551615u,
                                       json::array(),
                                       json::object(),
                                       json::array({0, 1, 1}),
                                       json::array({0, 0, 0}),
                                       json::array({1, 4294967295u, 99999999999u})};
        int refused = 0;
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const Groom groom = testing::randomGroom(seed);
            std::vector<json::json_pointer> places;
            (void)withManifest(groom, [&](json& manifest) {
                const json flat = manifest.flatten();
                for (const auto& [place, value] : flat.items()) {
                    json::json_pointer pointer(place);
                    for (int up = 0; up < 2 && !pointer.empty(); ++up, pointer.pop_back()) places.push_back(pointer);
                }
            });
            for (std::size_t i = 0; i < places.size(); ++i) {
                const json& value = values[(i * 7 + seed) % values.size()];
                const auto opened =
                    documentFromBytes(withManifest(groom, [&](json& manifest) { manifest[places[i]] = value; }), "a");
                if (!opened) ++refused;
                if (opened) QVERIFY2(obeysLaws(opened->groom), places[i].to_string().c_str());
            }
        }
        QVERIFY(refused > 50);
    }

    void missingEntriesAreRefused() {
        for (const char* key : {"mesh", "guides", "maps", "groups", "counts"}) {
            const auto opened =
                documentFromBytes(withManifest(smallGroom(), [&](json& manifest) { manifest.erase(key); }), "a");
            QVERIFY(!opened.ok());
            QVERIFY2(mentions(opened.error().message, key), opened.error().message.c_str());
        }
    }

    void hugeClaimsAreRefusedQuickly() {
        const Bytes good = documentBytes(smallGroom());
        std::vector<Bytes> claims;
        for (const std::size_t field : {12u, 16u, 24u, 40u, 48u, 72u, 80u}) {
            for (const std::uint64_t value :
                 {std::uint64_t{0xffffffff}, std::uint64_t{1} << 62, std::uint64_t{1} << 20}) {
                Bytes bytes = good;
                const std::size_t size = field < 24 ? 4 : 8;
                std::memcpy(bytes.data() + field, &value, size);
                reseal(bytes);
                claims.push_back(bytes);
            }
        }
        claims.push_back(withManifest(smallGroom(), [](json& m) {
            m["maps"][0]["width"] = 16384;
            m["maps"][0]["height"] = 16384;
        }));
        // One piece named by many arrays would multiply itself.
        claims.push_back(withManifest(smallGroom(), [](json& m) {
            for (int i = 1; i < 2000; ++i) {
                m["maps"][static_cast<std::size_t>(i)] = m["maps"][0];
                m["maps"][static_cast<std::size_t>(i)]["name"] = std::to_string(i);
            }
        }));
        const long before = peakKilobytes();
        QElapsedTimer timer;
        timer.start();
        for (const Bytes& bytes : claims) QVERIFY(!documentFromBytes(bytes, "a").ok());
        QVERIFY(timer.elapsed() < 1000);
        QVERIFY(peakKilobytes() - before < 64 * 1024);
    }

    void deepManifestsAreRefused() {
        ContainerWriter writer;
        Progress progress;
        const Bytes bytes = *writer.finish(kind, std::string(100000, '[') + std::string(100000, ']'), progress);
        const auto opened = documentFromBytes(bytes, "deep.whorl");
        QVERIFY(!opened.ok());
        QVERIFY2(mentions(opened.error().message, "deep"), opened.error().message.c_str());
        QVERIFY(!documentFromBytes(*ContainerWriter().finish(kind, "{\"mesh\":", progress), "a").ok());
        QVERIFY(!documentFromBytes(*ContainerWriter().finish(kind, "[]", progress), "a").ok());
    }

    void badNumbersAreRepairedAndTold() {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const float inf = std::numeric_limits<float>::infinity();
        Groom groom = testing::groomOn(testing::plane(3), 8, 4);
        groom.guides.editPoints(0)[2] = glm::vec3(nan, 0.0f, inf);
        groom.guides.setRoot(1, {5, -3.0f, nan});
        groom.guides.setRoot(2, {999, 0.0f, 0.0f});
        groom.guides.setGroup(3, 17);
        groom.guides.setPoints(4, std::vector<glm::vec3>(9, glm::vec3(1.0f)));
        groom.mesh.edit().normals[0].x = nan;
        groom.mesh.edit().cornerUvs[0].y = inf;
        groom.mesh.edit().parts[0].triangleCount = 3;
        groom.partSettings.edit().resize(5);
        groom.groups.edit().push_back({"hair"});
        groom.groups.edit().push_back({"a/b"});
        Map map(80, 80, 1, TexelFormat::F32, inf);
        map.setTexel(70, 70, 0, nan);
        map.setTexel(71, 70, 0, 0.5f);
        groom.maps.set("m", map);
        const auto opened = documentFromBytes(documentBytes(groom), "a");
        QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
        QVERIFY(obeysLaws(opened->groom));
        QCOMPARE(opened->groom.guides.count(), groom.guides.count() - 1);
        QCOMPARE(opened->groom.maps.find("m")->texel(70, 70), 0.0f);
        QCOMPARE(opened->groom.maps.find("m")->texel(71, 70), 0.5f);
        QCOMPARE(opened->groom.maps.find("m")->texel(0, 0), 0.0f);
        for (const char* words :
             {"1 guides had points", "outside their triangles", "did not stand", "first one now", "resampled",
              "normals", "texture coordinates", "one part now", "settings for", "hair-2", "a_b", "texels", "filled"})
            QVERIFY2(mentions(opened->problems, words), words);
    }

    void badMeshesAreRefused() {
        Groom groom = smallGroom();
        groom.mesh.edit().triangles[1].y = 1000;
        QVERIFY(!documentFromBytes(documentBytes(groom), "a").ok());
        groom = smallGroom();
        groom.mesh.edit().positions[1].y = std::numeric_limits<float>::infinity();
        QVERIFY(!documentFromBytes(documentBytes(groom), "a").ok());
        groom = smallGroom();
        groom.mesh.edit().normals.pop_back();
        QVERIFY(!documentFromBytes(documentBytes(groom), "a").ok());
        groom = smallGroom();
        groom.groups.edit().resize(31, Group{"x"});
        QVERIFY(!documentFromBytes(documentBytes(groom), "a").ok());
    }

    void everyFaultKeepsTheOldDocument() {
        const fs::path file = testing::scratchFolder("doc-fault") / "a.whorl";
        const Groom first = smallGroom();
        const Groom second = testing::randomGroom(3);
        Progress progress;
        QVERIFY(saveDocument(first, file, progress).ok());
        for (int k = 0; k < 100; ++k) {
            int step = 0;
            setFileFault([&](FileStep) { return step++ == k ? ENOSPC : 0; });
            const auto saved = saveDocument(second, file, progress);
            setFileFault({});
            const auto opened = openDocument(file, progress);
            QVERIFY(opened.ok());
            QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(saved ? second : first));
            if (saved) {
                QVERIFY(k >= 5);
                return;
            }
            QVERIFY(mentions(saved.error().message, "no space left"));
        }
        QFAIL("never saved");
    }

    void cancelledSavesChangeNothing() {
        const fs::path file = testing::scratchFolder("doc-cancel") / "a.whorl";
        Progress progress;
        QVERIFY(saveDocument(smallGroom(), file, progress).ok());
        Progress cancelled;
        cancelled.cancel();
        const auto saved = saveDocument(testing::randomGroom(1), file, cancelled);
        QVERIFY(!saved.ok() && saved.error().cancelled);
        QCOMPARE(testing::groomDigest(openDocument(file, progress)->groom), testing::groomDigest(smallGroom()));
        const auto opened = openDocument(file, cancelled);
        QVERIFY(!opened.ok() && opened.error().cancelled);
    }

    void otherFilesAreNoDocuments() {
        const fs::path folder = testing::scratchFolder("doc-other");
        Progress progress;
        QVERIFY(!openDocument(folder, progress).ok());
        QVERIFY(!openDocument(folder / "none", progress).ok());
        QVERIFY(!isDocument(folder) && !isDocument(folder / "none") && !isDocument("/dev/zero"));
        auto safe = SafeFile::create(folder / "text");
        QVERIFY(safe->write("WHORLDO", 7).ok() && safe->commit().ok());
        QVERIFY(!isDocument(folder / "text"));
        const auto opened = openDocument(folder / "text", progress);
        QVERIFY(!opened.ok() && mentions(opened.error().message, "not a Whorl document"));
    }

    void mapsOfOneValueStaySmall() {
        Groom groom = smallGroom();
        groom.maps.set("huge", Map(Map::maxSize, Map::maxSize, 1, TexelFormat::F32, 0.75f));
        groom.maps.edit("huge")->setTexel(16000, 9000, 0, -0.0f);
        const Bytes bytes = documentBytes(groom);
        QVERIFY(bytes.size() < 50000);
        const long before = peakKilobytes();
        const auto opened = documentFromBytes(bytes, "a");
        QVERIFY(opened.ok());
        QVERIFY(peakKilobytes() - before < 64 * 1024);
        const Map& map = *opened->groom.maps.find("huge");
        QCOMPARE(map.texel(16383, 16383), 0.75f);
        QVERIFY(std::signbit(map.texel(16000, 9000)));
        QVERIFY(documentBytes(opened->groom) == bytes);
    }

    void speed() {
        Groom groom = testing::groomOn(testing::sphere(160, 320), 10000);
        for (int i = 0; i < 4; ++i) {
            Map map(2048, 2048, 1, TexelFormat::U8, 1.0f);
            for (int y = 0; y < 2048; ++y) {
                for (int x = 0; x < 2048; ++x)
                    map.setTexel(x, y, 0,
                                 0.5f + 0.4f * std::sin(static_cast<float>(x * (i + 1)) * 0.01f) *
                                            std::cos(static_cast<float>(y) * 0.013f));
            }
            groom.maps.set("map" + std::to_string(i), std::move(map));
        }
        const fs::path file = testing::scratchFolder("doc-speed") / "a.whorl";
        Progress progress;
        QElapsedTimer timer;
        timer.start();
        QVERIFY(saveDocument(groom, file, progress).ok());
        const qint64 saving = timer.restart();
        const auto opened = openDocument(file, progress);
        const qint64 opening = timer.elapsed();
        QVERIFY(opened.ok());
        QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(groom));
        qInfo("10,000 guides, 4 maps of 2048: %lld bytes, saved in %lld ms, opened in %lld ms",
              static_cast<long long>(fs::file_size(file)), static_cast<long long>(saving),
              static_cast<long long>(opening));
        QVERIFY2(saving < 5000 && opening < 5000, "ten times the promise: sanitizers and busy machines");
    }
};

QTEST_APPLESS_MAIN(DocumentTest)
#include "document_test.moc"
