// SPDX-License-Identifier: Apache-2.0
#include "render/lic_image.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/lic/live_texture.h"
#include "core/model/map.h"
#include "tests/support/lic_scene.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {
namespace {

std::shared_ptr<const LicTexture> shared(LicTexture texture) {
    return std::make_shared<const LicTexture>(std::move(texture));
}

template <class T>
std::shared_ptr<const std::vector<T>> layer(std::vector<T> values) {
    return std::make_shared<const std::vector<T>>(std::move(values));
}

std::size_t place(int x, int y, int width) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

std::array<int, 4> texel(const LicImage& image, const LicImage::Tiles& tiles, int level, int x, int y) {
    constexpr int side = LicImage::tileSize;
    const std::uint32_t t =
        tiles[place(x / side, y / side, ChartMask::tiles(image.side(level)))]->texels[place(x % side, y % side, side)];
    return {static_cast<int>(t & 255), static_cast<int>(t >> 8 & 255), static_cast<int>(t >> 16 & 255),
            static_cast<int>(t >> 24)};
}

/// Empty when all texels of all levels are the same.
QString difference(const LicImage& a, const LicImage& b) {
    if (a.levels() != b.levels()) return "levels";
    for (int level = 0; level < a.levels(); ++level) {
        for (int y = 0; y < a.side(level); ++y) {
            for (int x = 0; x < a.side(level); ++x) {
                const bool tones = texel(a, a.tones(level), level, x, y) == texel(b, b.tones(level), level, x, y);
                const bool colours = texel(a, a.colours(level), level, x, y) == texel(b, b.colours(level), level, x, y);
                if (!tones || !colours)
                    return QString("%1 at %2, %3 of level %4").arg(tones ? "colour" : "tone").arg(x).arg(y).arg(level);
            }
        }
    }
    return {};
}

std::size_t newTiles(const LicImage& before, const LicImage& now, int level) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < now.tones(level).size(); ++i) {
        count += now.tones(level)[i] != before.tones(level)[i] ? 1 : 0;
        count += now.colours(level)[i] != before.colours(level)[i] ? 1 : 0;
    }
    return count;
}

/// Noise in all layers, two charts with a gap between them.
LicTexture noisy(int size) {
    LicTexture texture;
    texture.size = size;
    const std::size_t count = place(0, size, size);
    const auto bytes = [](std::uint64_t seed, std::size_t n) {
        std::vector<std::uint8_t> values(n);
        for (std::size_t i = 0; i < n; ++i)
            values[i] = static_cast<std::uint8_t>(255.0f * randomFloat(seed, i, 0) + 0.5f);
        return values;
    };
    texture.light = layer(bytes(1, count));
    std::vector<std::uint8_t> cover = bytes(2, count);
    for (std::size_t i = 0; i < count; i += 5) cover[i] = 0;
    texture.cover = layer(std::move(cover));
    texture.colours = layer(bytes(3, 3 * count));
    texture.sides = layer(bytes(4, count));
    texture.cornerUvs =
        layer<glm::vec2>({{0.02f, 0.03f}, {0.45f, 0.1f}, {0.2f, 0.9f}, {0.55f, 0.3f}, {0.97f, 0.2f}, {0.7f, 0.95f}});
    texture.tangents = layer(std::vector<glm::vec3>(6, glm::vec3(1, 0, 0)));
    texture.mean = 0.5f;
    texture.deviation = 0.2f;
    return texture;
}

bool anyChart(const ChartMask& mask, int level, int x, int y, int ring) {
    const int last = mask.side(level) - 1;
    for (int j = std::max(y - ring, 0); j <= std::min(y + ring, last); ++j)
        for (int i = std::max(x - ring, 0); i <= std::min(x + ring, last); ++i)
            if (mask.at(level, i, j)) return true;
    return false;
}

}  // namespace

class LicImageTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void nothingMakesNoImage() {
        QVERIFY(!LicImage::make(nullptr));
        QVERIFY(!LicImage::make(shared(LicTexture())));
    }

    void theFirstLevelIsTheTexture() {
        const LicTexture texture = noisy(100);
        const auto image = LicImage::make(shared(texture));
        for (int y = 0; y < 100; ++y) {
            for (int x = 0; x < 100; ++x) {
                const std::size_t at = place(x, y, 100);
                const auto tone = texel(*image, image->tones(0), 0, x, y);
                QCOMPARE(tone[2], int{(*texture.cover)[at]});
                QCOMPARE(tone[3], int{(*texture.sides)[at]});
                const float light = static_cast<float>((*texture.light)[at]) / 255.0f;
                const float should = tone[2] > 0 ? licTone(light, texture.mean, texture.deviation) : 0.0f;
                QVERIFY(std::abs(static_cast<float>(tone[0] - 128) / 127.0f - should) < 0.006f);
                QVERIFY(std::abs(static_cast<float>(tone[1]) / 255.0f - should * should) < 0.003f);
                const auto colour = texel(*image, image->colours(0), 0, x, y);
                for (std::size_t c = 0; c < 3; ++c) QCOMPARE(colour[c], int{(*texture.colours)[3 * at + c]});
            }
        }
    }

    // Numbers as numbers, colours as light; of texels in charts, and around charts of those beside.
    void levelsAreMeansOfWhatLiesInCharts() {
        for (const int size : {256, 300, 97, 1}) {
            const LicTexture texture = noisy(size);
            const auto image = LicImage::make(shared(texture));
            const ChartMask mask(size, *texture.cornerUvs);
            QCOMPARE(image->side(image->levels() - 1), 1);
            for (int level = 1; level < image->levels(); ++level) {
                const int own = image->side(level), finer = image->side(level - 1);
                for (int y = 0; y < own; ++y) {
                    for (int x = 0; x < own; ++x) {
                        const bool inside = mask.at(level, x, y);
                        const int ring = inside ? 0 : anyChart(mask, level, x, y, 1) ? 1 : 2;
                        if (!anyChart(mask, level, x, y, ring)) continue;
                        const int from = inside ? level - 1 : level;
                        glm::ivec2 across(x - ring, x + ring + 1), down(y - ring, y + ring + 1);
                        if (inside) {
                            across = ChartMask::children(x, own, finer);
                            down = ChartMask::children(y, own, finer);
                        }
                        std::array<double, 4> tones{};
                        std::array<double, 3> light{};
                        int count = 0;
                        const int last = image->side(from);
                        for (int j = std::max(down.x, 0); j < std::min(down.y, last); ++j) {
                            for (int i = std::max(across.x, 0); i < std::min(across.y, last); ++i) {
                                if (!mask.at(from, i, j)) continue;
                                const auto tone = texel(*image, image->tones(from), from, i, j);
                                const auto colour = texel(*image, image->colours(from), from, i, j);
                                for (std::size_t c = 0; c < 4; ++c) tones[c] += tone[c];
                                for (std::size_t c = 0; c < 3; ++c)
                                    light[c] +=
                                        static_cast<double>(linearFromSrgb(static_cast<float>(colour[c]) / 255.0f));
                                ++count;
                            }
                        }
                        QVERIFY(count > 0);
                        const auto tone = texel(*image, image->tones(level), level, x, y);
                        const auto colour = texel(*image, image->colours(level), level, x, y);
                        for (std::size_t c = 0; c < 4; ++c) QVERIFY(std::abs(tone[c] - tones[c] / count) <= 0.5);
                        for (std::size_t c = 0; c < 3; ++c) {
                            const double should =
                                static_cast<double>(srgbFromLinear(static_cast<float>(light[c] / count))) * 255.0;
                            QVERIFY2(std::abs(colour[c] - should) <= 0.6,
                                     qPrintable(QString("%1, not %2").arg(colour[c]).arg(should)));
                        }
                    }
                }
            }
        }
    }

    void sameBytesEverywhere() {
        const auto texture = shared(noisy(300));
        const auto expected = LicImage::make(texture);
        for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
            if (level > bestSimdLevel()) continue;
            setSimdLevel(level);
            for (const unsigned threads : {1u, 2u, 5u}) {
                const ThreadLimit limit(threads);
                QCOMPARE(difference(*LicImage::make(texture), *expected), QString());
            }
        }
        setSimdLevel(bestSimdLevel());
    }

    // Layers in other memory of which some texels differ, wherever those lie.
    void anImageAfterAnotherEqualsAFreshOne() {
        for (const int size : {512, 300, 97}) {
            LicTexture texture = noisy(size);
            auto image = LicImage::make(shared(texture));
            for (int step = 0; step < 24; ++step) {
                const auto random = [&](std::uint32_t what, int count) {
                    return static_cast<int>(randomFloat(9, static_cast<std::uint64_t>(step), what) *
                                            static_cast<float>(count));
                };
                const int x = random(0, size), y = random(1, size);
                const int width = 1 + random(2, std::min(40, size - x)), height = 1 + random(3, std::min(40, size - y));
                const auto dab = [&](LicTexture::Layer<std::uint8_t>& where, int channels) {
                    std::vector<std::uint8_t> values = *where;
                    for (int j = y; j < y + height; ++j)
                        std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(place(x, j, size)) * channels,
                                    width * channels, static_cast<std::uint8_t>(10 * step));
                    where = layer(std::move(values));
                };
                switch (step % 6) {
                    case 0:
                        dab(texture.light, 1);
                        break;
                    case 1:
                        dab(texture.cover, 1);
                        break;
                    case 2:
                        dab(texture.sides, 1);
                        break;
                    case 3:
                        dab(texture.colours, 3);
                        break;
                    case 4:
                        texture.sides = step < 22 ? layer(std::vector<std::uint8_t>(*texture.cover)) : nullptr;
                        break;
                    default:
                        texture.mean = 0.5f + 0.01f * static_cast<float>(step);
                        if (step > 12) texture.cornerUvs = layer(*texture.cornerUvs);
                }
                const auto next = LicImage::make(shared(texture), image);
                const QString apart = difference(*next, *LicImage::make(shared(texture)));
                QVERIFY2(apart.isEmpty(), qPrintable(QString("step %1, size %2: %3").arg(step).arg(size).arg(apart)));
                if (step % 6 < 4) QVERIFY(newTiles(*image, *next, 0) <= 4);
                image = next;
            }
            QVERIFY(LicImage::make(image->texture(), image) == image);
            const auto same = LicImage::make(shared(texture), image);
            for (int level = 0; level < same->levels(); ++level) QCOMPARE(newTiles(*image, *same, level), 0u);
        }
    }

    void whatIsPaintedIsMadeAgainWhereItChanged() {
        testing::LicScene scene(testing::sphere(24, 32), testing::aroundTheBall);
        Groom& groom = scene.groom;
        groom.maps.set("grain", Map(256, 256, 1, TexelFormat::U8, 1.0f));
        groom.maps.set("tint", Map(256, 256, 1, TexelFormat::U8, 1.0f));
        for (Group& group : groom.groups.edit()) group.params.colour.tip.map = "tint";
        scene.lic().grain = {0.002f, "grain"};
        scene.lic().length.value = 0.008f;
        LiveTexture live;
        Progress progress;
        const auto paint = [&] { return *live.update(groom, scene.surface, 512, progress); };
        auto texture = paint();
        QVERIFY(texture->mesh == groom.mesh.share());
        const auto first = LicImage::make(texture);
        auto image = first;
        int column = 60;
        for (const char* name : {"grain", "tint", "grain"}) {
            Map map = *groom.maps.find(name);
            for (int y = 100; y < 110; ++y)
                for (int x = column; x < column + 10; ++x) map.setTexel(x, y, 0, 0.3f);
            groom.maps.set(name, std::move(map));
            column += 50;
            const auto next = paint();
            QCOMPARE(next->changedSince, texture->serial);
            QVERIFY(next->serial > texture->serial);
            const auto after = LicImage::make(next, image);
            QCOMPARE(difference(*after, *LicImage::make(next)), QString());
            const std::size_t made = newTiles(*image, *after, 0);
            QVERIFY2(made > 0 && made < 20, qPrintable(QString("%1: %2").arg(name).arg(made)));
            // Not the one right before: what the texture says of changes is not for it.
            QCOMPARE(difference(*LicImage::make(next, first), *after), QString());
            texture = next;
            image = after;
        }
    }
};

}  // namespace whorl

QTEST_GUILESS_MAIN(whorl::LicImageTest)
#include "lic_image_test.moc"
