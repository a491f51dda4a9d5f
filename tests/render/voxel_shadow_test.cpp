// SPDX-License-Identifier: Apache-2.0
#include "render/passes/voxel_shadow.h"

#include "core/base/parallel.h"
#include "core/base/random.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <cmath>

namespace whorl {
namespace {

void addHair(Strands& strands, glm::vec3 from, glm::vec3 to, float width = 0.001f) {
    constexpr int vertices = 16;
    for (int j = 0; j < vertices; ++j) {
        strands.positions.push_back(from + (to - from) * (static_cast<float>(j) / (vertices - 1)));
        strands.normals.push_back(glm::vec3(0, 1, 0));
        strands.widths.push_back(width);
        strands.colours.push_back(glm::vec4(1.0f));
    }
    strands.firstVertex.push_back(static_cast<std::uint32_t>(strands.positions.size()));
    strands.ids.push_back(static_cast<std::uint32_t>(strands.ids.size()));
    strands.roots.push_back({});
    strands.rootUvs.push_back(glm::vec2(0));
    strands.groups.push_back(0);
}

Strands tuft(int hairs) {
    Strands strands;
    for (int i = 0; i < hairs; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        const glm::vec3 from(randomFloat(3, index, 0), randomFloat(3, index, 1), randomFloat(3, index, 2));
        const glm::vec3 way(randomFloat(3, index, 3), randomFloat(3, index, 4), randomFloat(3, index, 5));
        addHair(strands, from * 0.1f, from * 0.1f + way * 0.05f);
    }
    return strands;
}

// Layers of hair between the light and a place, as the shader finds them (nearest texel).
float layersAt(const VoxelShadow& shadow, glm::vec3 p) {
    const glm::vec4 place = shadow.voxelFromGroom() * glm::vec4(p, 1.0f);
    const auto index = [](float x) {
        return static_cast<std::size_t>(std::min(std::max(x, 0.0f), 0.9999f) * VoxelShadow::size);
    };
    const std::size_t at = (index(place.z) * VoxelShadow::size + index(place.y)) * VoxelShadow::size + index(place.x);
    return static_cast<float>(shadow.texels()[at]) / 65535.0f * VoxelShadow::fullLayers;
}

glm::vec4 surroundingsAt(const AmbientVolume& ambient, glm::vec3 p) {
    constexpr std::size_t n = AmbientVolume::size;
    const glm::vec3 place = (p * ambient.scale() + ambient.offset()) * static_cast<float>(n);
    return ambient.texels()[(static_cast<std::size_t>(place.z) * n + static_cast<std::size_t>(place.y)) * n +
                            static_cast<std::size_t>(place.x)];
}

}  // namespace

class VoxelShadowTest : public QObject {
    Q_OBJECT

    const glm::vec3 m_light = glm::normalize(glm::vec3(0.4f, 0.8f, 0.3f));
    const HairDetail m_all{};

private Q_SLOTS:
    void sameAsPlainLoopsAndForAnyThreads() {
        const Strands strands = tuft(2000);
        VoxelShadow fast;
        fast.build(strands, m_all, m_light);
        VoxelShadow plain;
        plain.buildReference(strands, m_all, m_light);
        QVERIFY(fast.texels() == plain.texels());
        const ThreadLimit one(1);
        VoxelShadow single;
        single.build(strands, m_all, m_light);
        QVERIFY(fast.texels() == single.texels());
    }

    void growsAlongTheLight() {
        VoxelShadow shadow;
        shadow.build(tuft(500), m_all, m_light);
        constexpr std::size_t n = VoxelShadow::size;
        bool any = false;
        for (std::size_t i = 0; i < n * n; ++i) {
            for (std::size_t z = 1; z < n; ++z) {
                const std::uint16_t before = shadow.texels()[(z - 1) * n * n + i];
                const std::uint16_t here = shadow.texels()[z * n * n + i];
                QVERIFY(here >= before);
                any = any || here > before;
            }
        }
        QVERIFY(any);
    }

    void shadowFallsAwayFromTheLight() {
        // A mat of hair in the plane y = 0 under a lamp from above.
        Strands mat;
        for (int i = 0; i < 400; ++i) {
            const float x = -0.05f + 0.1f * static_cast<float>(i) / 399.0f;
            addHair(mat, glm::vec3(x, 0, -0.05f), glm::vec3(x, 0, 0.05f));
        }
        addHair(mat, glm::vec3(0, -0.05f, 0), glm::vec3(0, 0.05f, 0), 1e-6f);
        VoxelShadow shadow;
        shadow.build(mat, m_all, glm::vec3(0, 1, 0));
        // Three or four hairs fall into one voxel: the mean over many places counts.
        float below = 0.0f;
        for (int i = 0; i < 10000; ++i) {
            const glm::vec2 place = glm::vec2(i % 100, i / 100) * 0.0008f - 0.04f;
            below += layersAt(shadow, glm::vec3(place.x, -0.03f, place.y)) * 0.0001f;
        }
        QVERIFY(layersAt(shadow, glm::vec3(0.01f, 0.03f, 0.01f)) < 0.01f);
        // 400 hairs of 1 mm on 100 mm cover the plane four times: sixteen layers.
        QVERIFY2(std::abs(below - 16.0f) < 0.8f, qPrintable(QString::number(static_cast<double>(below))));
        // The lamp from below: the other way round.
        shadow.build(mat, m_all, glm::vec3(0, -1, 0));
        QVERIFY(layersAt(shadow, glm::vec3(0.01f, -0.03f, 0.01f)) < 0.01f);
        QVERIFY(layersAt(shadow, glm::vec3(0.01f, 0.03f, 0.01f)) > 10.0f);
    }

    void everySecondHairTwiceAsWideIsTheSameOnTheWhole() {
        const Strands strands = tuft(4000);
        const auto sum = [&](const HairDetail& detail) {
            VoxelShadow shadow;
            shadow.build(strands, detail, m_light);
            double total = 0;
            for (const std::uint16_t texel : shadow.texels()) total += texel;
            return total;
        };
        const double all = sum(HairDetail{1, 2, 1.0f});
        QVERIFY(std::abs(sum(HairDetail{2, 2, 2.0f}) / all - 1.0) < 0.05);
    }

    // However dense the coat, its surface is lit and its depth is dark, under lamps from above and from the side.
    void denseCoatsDoNotShadowTheirSurface() {
        constexpr float depth = 0.03f;
        for (const float width : {0.001f, 0.003f, 0.01f}) {
            Strands coat;
            for (int i = 0; i < 20000; ++i) {
                const auto index = static_cast<std::uint64_t>(i);
                const glm::vec3 root(randomFloat(5, index, 0) * 0.1f, 0.0f, randomFloat(5, index, 1) * 0.1f);
                addHair(coat, root, root + glm::vec3(0, depth, 0), width);
            }
            for (const glm::vec3 lamp : {glm::vec3(0, 1, 0), glm::vec3(1, 1, 0.3f), glm::vec3(-0.5f, 1, 1)}) {
                VoxelShadow shadow;
                shadow.build(coat, m_all, glm::normalize(lamp));
                float surface = 0.0f;
                float deep = 1e9f;
                for (int i = 0; i < 2500; ++i) {
                    const glm::vec2 place = glm::vec2(i % 50, i / 50) * 0.001f + 0.025f;
                    surface = std::max(surface, layersAt(shadow, glm::vec3(place.x, depth, place.y)));
                    deep = std::min(deep, layersAt(shadow, glm::vec3(place.x, 0.4f * depth, place.y)));
                }
                QVERIFY2(surface <= VoxelShadow::nearLayers, qPrintable(QString::number(static_cast<double>(surface))));
                QVERIFY2(deep > 2.0f * VoxelShadow::nearLayers, qPrintable(QString::number(static_cast<double>(deep))));
            }
            AmbientVolume ambient;
            ambient.build(coat, m_all);
            QVERIFY2(surroundingsAt(ambient, glm::vec3(0.05f, depth - 0.002f, 0.05f)).w > 0.06f,
                     qPrintable(QString::number(static_cast<double>(width))));
            QVERIFY(surroundingsAt(ambient, glm::vec3(0.05f, 0.4f * depth, 0.05f)).w < 0.05f);
        }
    }

    void bordersAreEmpty() {
        VoxelShadow shadow;
        shadow.build(tuft(300), m_all, m_light);
        constexpr std::size_t n = VoxelShadow::size;
        for (std::size_t z = 0; z < n; ++z) {
            for (std::size_t i = 0; i < n; ++i) {
                QCOMPARE(shadow.texels()[z * n * n + i], std::uint16_t{0});
                QCOMPARE(shadow.texels()[z * n * n + i * n], std::uint16_t{0});
                QCOMPARE(shadow.texels()[z * n * n + i * n + n - 1], std::uint16_t{0});
            }
        }
    }

    void noHairNoShadow() {
        VoxelShadow shadow;
        shadow.build(Strands{}, m_all, m_light);
        QVERIFY(shadow.empty());
        for (const std::uint16_t texel : shadow.texels()) QCOMPARE(texel, std::uint16_t{0});
        AmbientVolume ambient;
        ambient.build(Strands{}, m_all);
        for (const glm::vec4& texel : ambient.texels()) QCOMPARE(texel.w, 1.0f);
    }

    void hairInTheMiddleSeesLess() {
        const Strands strands = tuft(3000);
        AmbientVolume ambient;
        ambient.build(strands, m_all);
        const Bounds box = vertexBounds(strands);
        const glm::vec4 middle = surroundingsAt(ambient, box.centre());
        const glm::vec4 top = surroundingsAt(ambient, glm::vec3(box.centre().x, box.max.y, box.centre().z));
        QVERIFY(middle.w < top.w * 0.7f);
        QVERIFY(top.y > 0.5f);  // the open side is up
        const ThreadLimit one(1);
        AmbientVolume single;
        single.build(strands, m_all);
        QVERIFY(single.texels() == ambient.texels());
    }
};

}  // namespace whorl

QTEST_APPLESS_MAIN(whorl::VoxelShadowTest)
#include "voxel_shadow_test.moc"
