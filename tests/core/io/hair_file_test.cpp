// SPDX-License-Identifier: Apache-2.0
#include "core/io/hair_file.h"

#include "core/hair/thin.h"
#include "core/io/safe_file.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

using namespace whorl;

namespace {

Groom hairy() {
    Groom groom = testing::groomOn(testing::sphere(12, 24), 60, 8);
    groom.groups.edit()[0].params.general.segments = 8;
    groom.groups.edit()[0].params.general.keepOutside = false;
    groom.groups.edit()[0].params.frizz.tip.value = 0.01f;
    return groom;
}

constexpr std::uint32_t hairs = 40000;  // more than two blocks

const Strands& expected() {
    static const Strands strands = [] {
        Generator generator;
        Progress progress;
        return *generator.generate(hairy(), {hairs}, progress);
    }();
    return strands;
}

std::string bytesOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

std::filesystem::path written(const std::string& name) {
    const std::filesystem::path file = testing::scratchFolder("hair-file") / name;
    Progress progress;
    const Result<std::uint64_t> count = writeHair(hairy(), {hairs}, file, progress);
    if (!count || *count != expected().count()) return {};
    return file;
}

// A .hair file with two strands of three points, to be damaged.
std::string smallHair() {
    std::string bytes(128 + 2 * 2 + 6 * 12, '\0');
    const std::uint32_t header[5] = {0x52494148, 2, 6, 3, 0};
    std::memcpy(bytes.data(), header, sizeof header);
    const std::uint16_t segments[2] = {2, 2};
    std::memcpy(bytes.data() + 128, segments, sizeof segments);
    for (int i = 0; i < 18; ++i) {
        const float value = static_cast<float>(i);
        std::memcpy(bytes.data() + 132 + i * 4, &value, 4);
    }
    return bytes;
}

template <class T>
std::string with(std::string bytes, std::size_t offset, T value) {
    return bytes.replace(offset, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

class HairFileTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aDotHairFileReadsBackEqual() {
        const auto file = written("a.HAIR");
        QVERIFY(!file.empty());
        const auto curves = readHairFile(file);
        QVERIFY(curves);
        QCOMPARE(curves->size(), expected().count());
        for (std::size_t i = 0; i < curves->size(); ++i) {
            const std::size_t first = expected().firstVertex[i];
            QCOMPARE((*curves)[i].size(), static_cast<std::size_t>(expected().firstVertex[i + 1]) - first);
            for (std::size_t v = 0; v < (*curves)[i].size(); ++v)
                QCOMPARE((*curves)[i][v], expected().positions[first + v]);
        }
        QCOMPARE(std::filesystem::file_size(file), 128 + expected().count() * 2 + expected().vertexCount() * 32);
    }

    void aRibFileHoldsCurvesThatReadBackEqual() {
        // Number by number: each list in brackets, in the order of the calls.
        const std::string text = bytesOf(written("a.rib"));
        QVERIFY(text.starts_with("##RenderMan RIB") && text.ends_with("AttributeEnd\n"));
        QVERIFY(text.find("Basis \"catmull-rom\" 1 \"catmull-rom\" 1\n") != std::string::npos);
        QVERIFY(text.find("Curves \"cubic\" [") != std::string::npos &&
                text.find("] \"nonperiodic\"") != std::string::npos);
        const auto all = [&](const std::string& name) {
            std::vector<float> numbers;
            for (std::size_t at = text.find(name + " ["); at != std::string::npos;
                 at = text.find(name + " [", at + 1)) {
                const char* from = text.data() + at + name.size() + 2;
                for (char* end = nullptr; *from != ']'; from = end) numbers.push_back(std::strtof(from, &end));
            }
            return numbers;
        };
        const auto counts = all("\"cubic\""), positions = all("\"vertex point P\""),
                   widths = all("\"vertex float width\"");
        const auto normals = all("\"varying normal N\""), colours = all("\"varying color Cs\"");
        const auto opacities = all("\"varying color Os\""), s = all("\"uniform float s\""),
                   t = all("\"uniform float t\"");
        const auto ids = all("\"uniform int hair_id\"");
        const std::size_t count = expected().count(), vertices = expected().vertexCount();
        QVERIFY(counts.size() == count && ids.size() == count && s.size() == count && t.size() == count);
        QVERIFY(positions.size() == 3 * (vertices + 2 * count) && widths.size() == vertices + 2 * count);
        QVERIFY(normals.size() == 3 * vertices && colours.size() == 3 * vertices && opacities.size() == 3 * vertices);
        std::size_t at = 0;
        const auto three = [](const std::vector<float>& a, std::size_t i) {
            return glm::vec3(a[3 * i], a[3 * i + 1], a[3 * i + 2]);
        };
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t first = expected().firstVertex[i], end = expected().firstVertex[i + 1];
            QVERIFY(counts[i] == static_cast<float>(end - first + 2) &&
                    ids[i] == static_cast<float>(expected().ids[i]));
            QVERIFY(glm::vec2(s[i], t[i]) == expected().rootUvs[i]);
            for (std::uint32_t k = 0; k < end - first + 2; ++k, ++at) {
                const std::uint32_t v = std::clamp(first + k, first + 1, end) - 1;
                QVERIFY(three(positions, at) == expected().positions[v] && widths[at] == expected().widths[v]);
            }
        }
        for (std::size_t v = 0; v < vertices; ++v) {
            QVERIFY(three(normals, v) == expected().normals[v]);
            QVERIFY(three(colours, v) == glm::vec3(expected().colours[v]) &&
                    opacities[3 * v] == expected().colours[v].w);
        }
    }

    void aPlyFileHoldsVerticesAndEdges() {
        const std::string bytes = bytesOf(written("a.ply"));
        const std::size_t end = bytes.find("end_header\n");
        QVERIFY(end != std::string::npos);
        const std::string header = bytes.substr(0, end);
        const std::size_t vertices = expected().vertexCount(), edges = vertices - expected().count();
        QVERIFY(header.find("element vertex " + std::to_string(vertices) + "\n") != std::string::npos);
        QVERIFY(header.find("element edge " + std::to_string(edges) + "\n") != std::string::npos);
        const std::size_t body = end + 11;
        QCOMPARE(bytes.size(), body + vertices * 32 + edges * 8);
        std::size_t edge = 0;
        for (std::size_t i = 0; i < expected().count(); ++i) {
            for (std::uint32_t v = expected().firstVertex[i]; v < expected().firstVertex[i + 1]; ++v) {
                glm::vec3 position;
                std::memcpy(&position, bytes.data() + body + v * 32, 12);
                QCOMPARE(position, expected().positions[v]);
                if (v + 1 == expected().firstVertex[i + 1]) continue;
                std::int32_t ends[2];
                std::memcpy(ends, bytes.data() + body + vertices * 32 + edge++ * 8, 8);
                QCOMPARE(ends[0], static_cast<std::int32_t>(v));
                QCOMPARE(ends[1], static_cast<std::int32_t>(v) + 1);
            }
        }
    }

    void normalsAreLeftOutWhereNoGroupAsksForThem() {
        Groom groom = hairy();
        groom.groups.edit()[0].params.general.writeNormals = false;
        const std::filesystem::path folder = testing::scratchFolder("hair-normals");
        Progress progress;
        for (const char* name : {"a.rib", "a.ply"}) QVERIFY(writeHair(groom, {hairs}, folder / name, progress));
        const std::string rib = bytesOf(folder / "a.rib"), ply = bytesOf(folder / "a.ply");
        QVERIFY(rib.find("normal") == std::string::npos &&
                rib.find("\"uniform int hair_member\"") != std::string::npos);
        const std::size_t body = ply.find("end_header\n") + 11, vertices = expected().vertexCount();
        QVERIFY(ply.substr(0, body).find("nx") == std::string::npos);
        QCOMPARE(ply.size(), body + vertices * 20 + (vertices - expected().count()) * 8);
        for (std::size_t v = 0; v < vertices; ++v) {
            glm::vec3 position;
            float width = 0.0f;
            std::memcpy(&position, ply.data() + body + v * 20, 12);
            std::memcpy(&width, ply.data() + body + v * 20 + 12, 4);
            QVERIFY(position == expected().positions[v] && width == expected().widths[v]);
        }
        // One group that asks is enough.
        groom.groups.edit().push_back((*groom.groups)[0]);
        QVERIFY(!wantsNormals(groom));
        groom.groups.edit()[1].params.general.writeNormals = true;
        QVERIFY(wantsNormals(groom));
    }

    void anObjFileHoldsLinesOfTwo() {
        std::istringstream text(bytesOf(written("a.obj")));
        std::string word, line;
        std::size_t vertices = 0, lines = 0;
        while (text >> word) {
            if (word == "v") {
                glm::vec3 p;
                text >> p.x >> p.y >> p.z;
                QCOMPARE(p, expected().positions[vertices]);
                ++vertices;
            } else if (word == "l") {
                std::size_t from = 0, to = 0;
                text >> from >> to;
                QCOMPARE(to, from + 1);
                QVERIFY(from >= 1 && to <= expected().vertexCount());
                ++lines;
            } else {
                std::getline(text, line);
            }
        }
        QCOMPARE(vertices, expected().vertexCount());
        QCOMPARE(lines, expected().vertexCount() - expected().count());
    }

    void noHairGivesAFileWithoutHair() {
        Groom groom = hairy();
        groom.groups.edit()[0].params.general.cut.value = 0.0f;
        for (const HairFormat& format : hairFormats()) {
            const auto file = testing::scratchFolder("hair-none") / ("a." + std::string(format.suffix));
            Progress progress;
            const auto count = writeHair(groom, {10u}, file, progress);
            QVERIFY(count);
            QCOMPARE(*count, std::uint64_t{0});
            QVERIFY(std::filesystem::exists(file));
        }
    }

    void anUnknownFormatIsRefused() {
        Progress progress;
        const auto result = writeHair(hairy(), {10u}, "a.xyz", progress);
        QVERIFY(!result);
        QVERIFY(result.error().message.find(".ply, .obj, .hair") != std::string::npos);
        QVERIFY(hairFormatFor("a") == nullptr);
        QVERIFY(hairFormatFor("b.PLY") == &hairFormats()[0]);
    }

    void faultsAndCancellingLeaveTheOldFile() {
        for (const HairFormat& format : hairFormats()) {
            const auto folder = testing::scratchFolder("hair-fault");
            const auto file = folder / ("a." + std::string(format.suffix));
            write(file, "old");
            int writes = 0;
            for (int failing = 0; failing < 3; ++failing) {
                writes = 0;
                setFileFault(
                    [&](FileStep step) { return step == FileStep::Write && writes++ == failing ? ENOSPC : 0; });
                Progress progress;
                const auto result = writeHair(hairy(), {hairs}, file, progress);
                setFileFault({});
                QVERIFY(!result && !result.error().cancelled);
                QCOMPARE(bytesOf(file), std::string("old"));
            }
            Progress progress;
            progress.cancel();
            const auto result = writeHair(hairy(), {hairs}, file, progress);
            QVERIFY(!result && result.error().cancelled);
            QCOMPARE(bytesOf(file), std::string("old"));
            QCOMPARE(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
        }
    }

    void lyingDotHairFilesAreRefused() {
        const auto folder = testing::scratchFolder("hair-lies");
        const std::string good = smallHair();
        write(folder / "good.hair", good);
        const auto curves = readHairFile(folder / "good.hair");
        QVERIFY(curves);
        QCOMPARE(curves->size(), std::size_t{2});
        QCOMPARE((*curves)[1][2], glm::vec3(15, 16, 17));

        const float nan = std::numeric_limits<float>::quiet_NaN();
        const std::vector<std::string> bad{"",
                                           good.substr(0, 127),
                                           good.substr(0, good.size() - 1),
                                           "X" + good.substr(1),
                                           with(good, 4, 0xffffffffu),
                                           with(good, 4, 1u),
                                           with(good, 8, 0xffffffffu),
                                           with(good, 8, 5u),
                                           with(good, 12, 1u),
                                           with(good, 12, 0x1fu),
                                           with(with(good, 12, 2u), 16, 0xffffffffu),
                                           with(good, 128, std::uint16_t{3}),
                                           with(good, 132, nan),
                                           with(good, 136, std::numeric_limits<float>::infinity())};
        for (std::size_t i = 0; i < bad.size(); ++i) {
            const auto file = folder / (std::to_string(i) + ".hair");
            write(file, bad[i]);
            const auto result = readHairFile(file);
            QVERIFY2(!result, qPrintable(QString::number(i)));
            QVERIFY(result.error().message.find(file.filename().string()) != std::string::npos);
        }
        QVERIFY(!readHairFile(folder / "absent.hair"));
        QVERIFY(!readHairFile(folder));
    }

    void hostileFilesEndAsTheirIndexSays() {
        const auto folder = testing::realData("hostile");
        if (!folder) QSKIP("The hostile files are not here.");
        std::ifstream index(*folder / "INDEX.tsv");
        std::string line;
        int tried = 0;
        while (std::getline(index, line)) {
            if (line.rfind("hair/", 0) != 0) continue;
            const auto result = readHairFile(*folder / line.substr(0, line.find('\t')));
            QVERIFY2(result.ok() == (line.find("\tLOAD") != std::string::npos), line.c_str());
            ++tried;
        }
        QVERIFY(tried >= 4);
    }
};

QTEST_APPLESS_MAIN(HairFileTest)
#include "hair_file_test.moc"
