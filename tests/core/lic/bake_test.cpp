// SPDX-License-Identifier: Apache-2.0
// Laws of baked hair texture: what it holds at seams, in margins, on mirrored charts, and in files.
#include "core/io/bake_files.h"
#include "core/io/image.h"
#include "core/surface/adjacency.h"
#include "tests/support/lic_scene.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;
using namespace whorl::testing;

namespace {

struct Scene : LicScene {
    Scene(SurfaceMesh mesh, const Lines& strokes) : LicScene(std::move(mesh), strokes) { lic().border = 0.0f; }
    LicBake bake(const BakeOptions& options) const {
        Progress progress;
        return *bakeLic(groom, surface, field, options, progress);
    }
    std::vector<SurfacePoint> places(int size) const { return placesOfTexels(*groom.mesh, size); }
};

/// A ball whose right half is unrolled as the left one's mirror image, beside it, with room between.
SurfaceMesh mirroredBall() {
    SurfaceMesh mesh = testing::sphere(48, 64, 0.1f);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        float middle = 0.0f;
        for (std::uint32_t k = 0; k < 3; ++k) middle += mesh.cornerUvs[t * 3 + k].x / 3.0f;
        for (std::uint32_t k = 0; k < 3; ++k) {
            glm::vec2& uv = mesh.cornerUvs[t * 3 + k];
            uv.x = middle < 0.5f ? 0.05f + 0.8f * uv.x : 0.95f - 0.8f * (uv.x - 0.5f);
            uv.y = 0.05f + 0.9f * uv.y;
        }
    }
    return mesh;
}

/// The direction in space that a flow stands for, from how the triangle lies in its UVs.
glm::vec3 directionOf(const SurfaceMesh& mesh, const SurfacePoint& point, glm::vec2 flow) {
    // Places of the triangle's plane where u, and where v, is larger.
    const glm::uvec3 c = mesh.triangles[point.triangle];
    const glm::vec2 a = mesh.cornerUvs[point.triangle * 3], b = mesh.cornerUvs[point.triangle * 3 + 1],
                    d = mesh.cornerUvs[point.triangle * 3 + 2];
    const float area = (b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x);
    const auto ahead = [&](glm::vec2 way) {
        const float u = (way.x * (d.y - a.y) - way.y * (d.x - a.x)) / area;
        const float v = ((b.x - a.x) * way.y - (b.y - a.y) * way.x) / area;
        return u * (mesh.positions[c.y] - mesh.positions[c.x]) + v * (mesh.positions[c.z] - mesh.positions[c.x]);
    };
    const glm::vec3 normal = normalAt(mesh, point);
    glm::vec3 tangent = ahead({1, 0});
    tangent = glm::normalize(tangent - normal * glm::dot(normal, tangent));
    glm::vec3 bitangent = ahead({0, 1});
    bitangent -= normal * glm::dot(normal, bitangent);
    bitangent = glm::normalize(bitangent - tangent * glm::dot(tangent, bitangent));
    return tangent * flow.x + bitangent * flow.y;
}

const Lines twoOnTheBall{{{0.1f, 0, 0}, {0.06f, 0.02f, 0.07f}, {0, 0, 0.1f}},
                         {{-0.1f, 0, 0}, {-0.05f, -0.04f, -0.07f}, {0, 0, -0.1f}}};

}  // namespace

class BakeTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void flowOnThePlane_data() {
        QTest::addColumn<bool>("mirrored");
        QTest::newRow("as it lies") << false;
        QTest::newRow("mirrored") << true;
    }
    void flowOnThePlane() {
        QFETCH(bool, mirrored);
        SurfaceMesh mesh = testing::plane(6);
        if (mirrored) {
            for (glm::vec2& uv : mesh.cornerUvs) uv.x = 1.0f - uv.x;
        }
        const glm::vec3 way = glm::normalize(glm::vec3(0.8f, 0, 0.6f));
        const Scene scene(mesh, {{-0.3f * way, 0.3f * way}});
        const LicBake bake = scene.bake({.size = 32, .margin = 0});
        for (std::size_t i = 0; i < bake.flow.size(); ++i) {
            QCOMPARE(bake.texels[i], LicBake::Texel::Inside);
            QVERIFY(glm::distance(bake.flow[i], glm::vec2(mirrored ? -0.8f : 0.8f, 0.6f)) < 1e-3f);
        }
    }

    void flowInFilesGivesTheField_data() {
        QTest::addColumn<QString>("format");
        QTest::addColumn<int>("bits");
        QTest::addColumn<float>("bound");
        QTest::newRow("png, 16 bit") << "png" << 0 << 0.5f;
        QTest::newRow("png, 8 bit") << "png" << 8 << 2.0f;
        QTest::newRow("exr") << "exr" << 0 << 0.5f;
        QTest::newRow("exr, half floats") << "exr" << 16 << 0.5f;
    }
    void flowInFilesGivesTheField() {
        QFETCH(QString, format);
        QFETCH(int, bits);
        QFETCH(float, bound);
        const Scene scene(mirroredBall(), twoOnTheBall);
        BakeRequest request;
        request.file = testing::scratchFolder("bake") / "ball";
        request.maps = {BakeMap::Flow};
        request.options = {.size = 200, .margin = 4};
        request.format = format.toStdString();
        request.bits = bits;
        Progress progress;
        const auto files = bakeToFiles(scene.groom, scene.surface, request, progress);
        QVERIFY2(files.ok(), files.ok() ? "" : files.error().message.c_str());
        QCOMPARE(files->size(), std::size_t{1});
        QCOMPARE(files->front().filename().string(), "ball_flow." + format.toStdString());
        const auto image = readImage(files->front(), ImageUse::Colour);
        QVERIFY(image.ok());
        QCOMPARE(image->format(), format == "exr" ? TexelFormat::F32 : bits == 8 ? TexelFormat::U8 : TexelFormat::U16);
        const std::vector<SurfacePoint> places = scene.places(200);
        int checked = 0, mirrored = 0;
        for (int y = 0; y < 200; ++y) {
            for (int x = 0; x < 200; ++x) {
                const SurfacePoint& place = places[static_cast<std::size_t>(y) * 200 + static_cast<std::size_t>(x)];
                if (place.triangle == noTriangle) continue;
                const glm::vec2 flow(image->texel(x, y, 0) * 2.0f - 1.0f, image->texel(x, y, 1) * 2.0f - 1.0f);
                const float off = degreesBetween(directionOf(*scene.groom.mesh, place, flow), scene.field.at(place));
                QVERIFY2(off < bound, qPrintable(QString("%1, %2: %3").arg(x).arg(y).arg(off)));
                QCOMPARE(image->texel(x, y, 2), 0.0f);
                ++checked;
                mirrored += x > 100;
            }
        }
        QVERIFY(checked > 20000 && mirrored > 10000);
    }

    void bareSkinHasNoFlow() {
        Scene scene(testing::plane(16), {{{-0.3f, 0, 0}, {0.3f, 0, 0}}});
        Map map(2, 1, 1, TexelFormat::U8, 1.0f);
        map.setTexel(1, 0, 0, 0.0f);
        scene.groom.maps.set("density", map);
        scene.groom.groups.edit()[0].params.general.density.map = "density";
        scene.solve();
        const LicBake bake = scene.bake({.size = 64, .margin = 0});
        const Map flow = imageOf(bake, BakeMap::Flow, TexelFormat::U16, true);
        int bare = 0, haired = 0;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                const std::size_t at = static_cast<std::size_t>(y) * 64 + static_cast<std::size_t>(x);
                if (bake.opacity[at] > 0.0f) {
                    ++haired;
                    continue;
                }
                ++bare;
                QVERIFY(std::abs(flow.texel(x, y, 0) - 0.5f) < 1e-4f && std::abs(flow.texel(x, y, 1) - 0.5f) < 1e-4f);
                QCOMPARE(bake.height[at], 0.0f);
            }
        }
        QVERIFY(bare > 500 && haired > 1000);
    }

    void marginsGoOnOutward() {
        SurfaceMesh mesh = testing::plane(8);
        for (glm::vec2& uv : mesh.cornerUvs) uv = glm::vec2(0.25f) + 0.5f * uv;
        const Scene scene(mesh, {{{-0.3f, 0, 0}, {0.3f, 0, 0}}});
        for (const int margin : {0, 1, 5}) {
            const LicBake bake = scene.bake({.size = 64, .margin = margin});
            for (int y = 0; y < 64; ++y) {
                for (int x = 0; x < 64; ++x) {
                    const std::size_t at = static_cast<std::size_t>(y) * 64 + static_cast<std::size_t>(x);
                    // The chart is texels 16 to 47.
                    const int away = std::max({16 - x, x - 47, 16 - y, y - 47, 0});
                    const auto expected = away == 0        ? LicBake::Texel::Inside
                                          : away <= margin ? LicBake::Texel::Margin
                                                           : LicBake::Texel::Outside;
                    QCOMPARE(bake.texels[at], expected);
                    const std::size_t nearest = static_cast<std::size_t>(std::clamp(y, 16, 47)) * 64 +
                                                static_cast<std::size_t>(std::clamp(x, 16, 47));
                    if (expected == LicBake::Texel::Outside) {
                        QCOMPARE(bake.opacity[at], 0.0f);
                        continue;
                    }
                    QVERIFY(bake.opacity[at] > 0.9f);
                    // Sideways the very neighbour; in corners one of those near.
                    if (x >= 16 && x <= 47)
                        QVERIFY(away > 1 || glm::distance(bake.colour[at], bake.colour[nearest]) < 0.5f);
                    QVERIFY(glm::distance(bake.flow[at], bake.flow[nearest]) < 1e-3f);
                }
            }
        }
    }

    void seamsAreNotSeen_data() {
        QTest::addColumn<bool>("reference");
        QTest::newRow("in the texture") << false;
        QTest::newRow("place by place") << true;
    }
    void seamsAreNotSeen() {
        QFETCH(bool, reference);
        // The ball's UVs are cut from pole to pole at the back.
        Scene scene(testing::sphere(48, 64, 0.1f), {{{0.1f, 0, 0}, {0, 0, 0.1f}}, {{-0.1f, 0, 0}, {0, 0, -0.1f}}});
        LicParams& lic = scene.lic();
        lic.grain.value = 0.004f;
        lic.length.value = 0.02f;
        const int size = 256;
        const LicBake bake = scene.bake({.size = size, .margin = 4, .reference = reference});
        // Neighbours over the seam (first and last column of the texture) and inside, along the same rows.
        double over = 0.0, inside = 0.0;
        for (int y = size / 4; y < size * 3 / 4; ++y) {
            const auto value = [&](int x) {
                return static_cast<double>(
                    bake.height[static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x)]);
            };
            over += std::abs(value(0) - value(size - 1));
            for (int x = 20; x < 36; ++x) inside += std::abs(value(x) - value(x + 1)) / 16.0;
        }
        QVERIFY2(inside > 0.0 && over < 1.15 * inside, qPrintable(QString("%1 %2").arg(over).arg(inside)));
    }

    void fastAsTheReference() {
        Scene scene(testing::sphere(48, 64, 0.1f), twoOnTheBall);
        LicParams& lic = scene.lic();
        lic.grain.value = 0.005f;
        lic.length.value = 0.02f;
        const LicBake fast = scene.bake({.size = 192, .margin = 0});
        const LicBake slow = scene.bake({.size = 192, .margin = 0, .reference = true});
        std::vector<double> a, b;
        for (std::size_t i = 192 * 48; i < 192 * 144; ++i) {
            QCOMPARE(fast.texels[i], slow.texels[i]);
            QCOMPARE(fast.flow[i], slow.flow[i]);
            a.push_back(static_cast<double>(fast.height[i]));
            b.push_back(static_cast<double>(slow.height[i]));
        }
        QVERIFY2(correlation(a, b) > 0.85, qPrintable(QString::number(correlation(a, b))));
    }

    void parametersCount() {
        Scene scene(testing::plane(6), {{{-0.3f, 0, 0}, {0.3f, 0, 0}}});
        LicParams& lic = scene.lic();
        lic.grain.value = 0.02f;
        lic.length.value = 0.1f;
        lic.contrast = 0.0f;
        lic.height = 0.005f;
        ColourParams& colour = scene.groom.groups.edit()[0].params.colour;
        colour.root.value = colour.tip.value = {0.4f, 0.2f, 0.1f};
        const LicBake even = scene.bake({.size = 64, .margin = 0});
        float low = 1.0f, high = 0.0f;
        for (std::size_t i = 0; i < even.colour.size(); ++i) {
            low = std::min(low, even.height[i]);
            high = std::max(high, even.height[i]);
            QVERIFY(even.colour[i].y > 0.0f && even.colour[i].x / even.colour[i].y > 1.5f);
        }
        QVERIFY(low < 0.002f && high > 0.003f && high <= 0.005f);
        // Half white is the hair's own colour; less is darker, all of it white, as the view shows it.
        const auto mean = [](const LicBake& bake) {
            glm::vec3 sum(0.0f);
            for (const glm::vec3& texel : bake.colour) sum += texel;
            return sum / static_cast<float>(bake.colour.size());
        };
        QVERIFY(glm::distance(mean(even), glm::vec3(0.4f, 0.2f, 0.1f)) < 0.03f);
        lic.white = 0.25f;
        const glm::vec3 dark = mean(scene.bake({.size = 64, .margin = 0}));
        QVERIFY(glm::distance(dark, 0.61f * mean(even)) < 0.005f);
        lic.white = 1.0f;
        const glm::vec3 white = mean(scene.bake({.size = 64, .margin = 0}));
        QVERIFY(white.z > 0.5f && white.x < 1.2f * white.z);
        lic.white = 0.5f;
        lic.contrast = 1.0f;
        lic.opacity.value = 0.5f;
        const LicBake thin = scene.bake({.size = 64, .margin = 0});
        double covered = 0.0, spreadEven = 0.0, spread = 0.0;
        for (std::size_t i = 0; i < thin.opacity.size(); ++i) {
            covered += static_cast<double>(thin.opacity[i]) / static_cast<double>(thin.opacity.size());
            spreadEven += static_cast<double>(std::abs(even.colour[i].x - even.colour[0].x));
            spread += static_cast<double>(std::abs(thin.colour[i].x - even.colour[i].x));
        }
        QVERIFY(covered > 0.3 && covered < 0.7);
        QVERIFY(spread > 3.0 * spreadEven);
    }

    void allMapsInFiles() {
        const Scene scene(mirroredBall(), twoOnTheBall);
        const auto folder = testing::scratchFolder("bake_all");
        Progress progress;
        BakeRequest request;
        request.maps = *bakeMapsNamed(std::vector<std::string>{"height", "colour", "flow", "opacity", "colour"});
        QCOMPARE(request.maps.size(), std::size_t{4});
        QVERIFY(!bakeMapsNamed(std::vector<std::string>{"gloss"}).ok());
        request.options = {.size = 96, .margin = 3};
        request.file = folder / "coat.exr";
        const auto floats = bakeToFiles(scene.groom, scene.surface, request, progress);
        QVERIFY(floats.ok());
        request.file = folder / "coat.png";
        const auto bytes = bakeToFiles(scene.groom, scene.surface, request, progress);
        QVERIFY(bytes.ok());
        QCOMPARE((*floats)[1].filename().string(), std::string("coat_colour.exr"));
        QCOMPARE((*bytes)[0].filename().string(), std::string("coat_height.png"));
        const LicBake bake = scene.bake(request.options);
        for (std::size_t k = 0; k < 4; ++k) {
            const bool three = request.maps[k] == BakeMap::Colour || request.maps[k] == BakeMap::Flow;
            const auto exact = readImage((*floats)[k], three ? ImageUse::Colour : ImageUse::Data);
            const auto rounded = readImage((*bytes)[k], three ? ImageUse::Colour : ImageUse::Data);
            QVERIFY(exact.ok() && rounded.ok());
            QCOMPARE(exact->width(), 96);
            for (int i = 0; i < 96; ++i) {
                const int x = i, y = (i * 37) % 96;
                const std::size_t at = static_cast<std::size_t>(y) * 96 + static_cast<std::size_t>(x);
                if (request.maps[k] == BakeMap::Colour) {
                    for (int c = 0; c < 3; ++c) {
                        QVERIFY(std::abs(exact->texel(x, y, c) - bake.colour[at][c]) < 1e-4f);
                        const float encoded = srgbFromLinear(std::min(bake.colour[at][c], 1.0f));
                        QVERIFY(std::abs(rounded->texel(x, y, c) - encoded) < 0.003f);
                    }
                } else if (request.maps[k] == BakeMap::Opacity) {
                    QVERIFY(std::abs(exact->texel(x, y) - bake.opacity[at]) < 1e-4f);
                    QVERIFY(std::abs(rounded->texel(x, y) - bake.opacity[at]) < 0.003f);
                } else {
                    for (int c = 0; c < exact->channels(); ++c)
                        QVERIFY(std::abs(exact->texel(x, y, c) - rounded->texel(x, y, c)) < 1e-4f);
                }
            }
        }
        // Half floats: what they can hold of the floats, and no more.
        request.bits = 16;
        request.file = folder / "half.exr";
        const auto halves = bakeToFiles(scene.groom, scene.surface, request, progress);
        QVERIFY(halves.ok());
        for (std::size_t k = 0; k < 4; ++k) {
            const bool three = request.maps[k] == BakeMap::Colour || request.maps[k] == BakeMap::Flow;
            const auto exact = readImage((*floats)[k], three ? ImageUse::Colour : ImageUse::Data);
            const auto half = readImage((*halves)[k], three ? ImageUse::Colour : ImageUse::Data);
            QVERIFY(exact.ok() && half.ok());
            QVERIFY(std::filesystem::file_size((*halves)[k]) < std::filesystem::file_size((*floats)[k]));
            int rounded = 0;
            for (int y = 0; y < 96; ++y) {
                for (int x = 0; x < 96; ++x) {
                    for (int c = 0; c < half->channels(); ++c) {
                        const float value = half->texel(x, y, c), whole = exact->texel(x, y, c);
                        // Eleven binary digits, fewer below the smallest normal number.
                        QVERIFY(std::abs(value - whole) <= std::ldexp(std::max(whole, 6.104e-5f), -11));
                        int exponent = 0;
                        std::frexp(value, &exponent);
                        const float steps = std::ldexp(value, 11 - std::max(exponent, -13));
                        QCOMPARE(steps, std::round(steps));
                        rounded += value != whole ? 1 : 0;
                    }
                }
            }
            QVERIFY(rounded > 100 || request.maps[k] == BakeMap::Opacity);
        }
        // Of the two formats each has bits of its own.
        request.bits = 8;
        QVERIFY(!bakeToFiles(scene.groom, scene.surface, request, progress).ok());
        request.file = folder / "none.png";
        request.bits = 32;
        QVERIFY(!bakeToFiles(scene.groom, scene.surface, request, progress).ok());
        QVERIFY(!std::filesystem::exists(folder / "none_colour.png"));
        // Alone: colour and opacity together.
        request.bits = 0;
        request.maps.clear();
        request.file = folder / "together.png";
        QVERIFY(bakeToFiles(scene.groom, scene.surface, request, progress).ok());
        QVERIFY(readImage(request.file, ImageUse::Colour).ok());
        for (const int bits : {0, 16}) {
            request.bits = bits;
            request.file = folder / "together.exr";
            QVERIFY(bakeToFiles(scene.groom, scene.surface, request, progress).ok());
            const auto together = readImage(request.file, ImageUse::Colour);
            QVERIFY(together.ok());
            // Linear, as in the file of its own.
            const auto alone = readImage((*(bits == 0 ? floats : halves))[1], ImageUse::Colour);
            for (int i = 0; i < 96; ++i)
                for (int c = 0; c < 3; ++c) QCOMPARE(together->texel(i, i, c), alone->texel(i, i, c));
        }
        request.bits = 0;
        request.file = folder / "no" / "such" / "folder.png";
        QVERIFY(!bakeToFiles(scene.groom, scene.surface, request, progress).ok());
        progress.cancel();
        request.file = folder / "cancelled.png";
        QVERIFY(!bakeToFiles(scene.groom, scene.surface, request, progress).ok());
        QVERIFY(!std::filesystem::exists(request.file));
    }
};

QTEST_GUILESS_MAIN(BakeTest)
#include "bake_test.moc"
