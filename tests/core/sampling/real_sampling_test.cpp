// SPDX-License-Identifier: Apache-2.0
// The laws of surface and sampling on scanned and modelled meshes instead of balls.
#include "core/base/random.h"
#include "core/io/image.h"
#include "core/io/mesh_import.h"
#include "core/sampling/sub_triangle_sampler.h"
#include "core/surface/surface.h"
#include "tests/support/distribution.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <cmath>

using namespace whorl;
using testing::Paint;

class RealSamplingTest : public QObject {
    Q_OBJECT

    static void addMeshes() {
        QTest::addColumn<QString>("file");
        QTest::newRow("head, quads") << "heads/makehuman_derived/head_neutral.obj";
        QTest::newRow("head, 33,600 triangles") << "heads/makehuman_derived/head_caucasian_female_young_sub1.glb";
        QTest::newRow("bunny with box UVs") << "stanford/paper_sizes/bunny_69451_boxuv.glb";
        QTest::newRow("spot") << "animals/crane/spot/spot.obj";
    }

    static std::optional<SurfaceMesh> load(const QString& file) {
        const auto path = testing::realData(file.toStdString());
        if (!path) return std::nullopt;
        Progress progress;
        auto imported = importMesh(*path, progress);
        if (!imported) qFatal("%s", imported.error().message.c_str());
        return std::move(imported->mesh);
    }

    static Groom withDensity(SurfaceMesh mesh, Map map) {
        Groom groom = makeGroom(std::move(mesh));
        groom.maps.set("density", std::move(map));
        groom.groups.edit()[0].params.general.density = {1.0f, "density"};
        return groom;
    }

    static void checkDistribution(const Groom& groom) {
        Progress progress;
        const DensityLookup density(groom);
        const auto sampler = SubTriangleSampler::build(*groom.mesh, density, {}, progress);
        QVERIFY(sampler.ok());
        testing::FineBins bins(groom);
        const std::uint64_t count = 400000;
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t inside = randomBits(5, i, 1);
            bins.add(sampler->sample(unitDouble(randomBits(5, i, 0)), unitFloat(inside), unitFloat(inside << 24)));
        }
        QVERIFY(std::abs(sampler->total() - bins.total()) < 1e-4 * bins.total());
        const double excess = bins.chiSquareExcess();
        QVERIFY2(std::abs(excess) < 4.5, qPrintable(QString::number(excess)));
    }

private Q_SLOTS:
    void rootsFollowTheDensity_data() { addMeshes(); }
    void rootsFollowTheDensity() {
        QFETCH(QString, file);
        const auto mesh = load(file);
        if (!mesh) QSKIP("The folder of real meshes is not there (WHORL_TEST_DATA).");
        for (const Paint paint : {Paint::White, Paint::Noise, Paint::Checks})
            checkDistribution(withDensity(*mesh, testing::painted(paint, 256)));
    }

    void rootsFollowAScalpMap() {
        const auto mesh = load("heads/makehuman_derived/head_neutral.obj");
        const auto image = testing::realData("heads/makehuman_derived/scalp_density_512_8bit.png");
        if (!mesh || !image) QSKIP("The folder of real meshes is not there (WHORL_TEST_DATA).");
        auto map = readImage(*image, ImageUse::Data);
        QVERIFY(map.ok());
        const Groom groom = withDensity(*mesh, std::move(*map));
        checkDistribution(groom);
        // And the roots that the generator takes lie on texels with hair.
        Progress progress;
        const DensityLookup density(groom);
        const auto sampler = SubTriangleSampler::build(*groom.mesh, density, {}, progress);
        std::size_t grown = 0;
        for (std::uint64_t i = 0; i < 20000; ++i) {
            const SurfacePoint root = sampler->stratifiedRoot(i, 20000, 1);
            grown += density.growsAt(*groom.mesh, root) ? 1 : 0;
            QCOMPARE(density.growsAt(*groom.mesh, root), density.at(root.triangle, uvAt(*groom.mesh, root)) > 0.0f);
        }
        QVERIFY(grown > 19800);
    }

    void skinIsWhereTheNearestTriangleSays_data() { addMeshes(); }
    void skinIsWhereTheNearestTriangleSays() {
        QFETCH(QString, file);
        auto mesh = load(file);
        if (!mesh) QSKIP("The folder of real meshes is not there (WHORL_TEST_DATA).");
        const Surface surface{Cow<SurfaceMesh>(std::move(*mesh))};
        const DistanceField& skin = surface.skin();
        const glm::vec3 size = surface.bounds.size();
        int near = 0;
        for (std::uint64_t i = 0; i < 4000; ++i) {
            // Close to the skin, where hair is.
            const auto triangle = static_cast<std::uint32_t>(i * surface.mesh().triangleCount() / 4000);
            const glm::vec3 step(randomFloat(1, i, 0) - 0.5f, randomFloat(1, i, 1) - 0.5f, randomFloat(1, i, 2) - 0.5f);
            const glm::vec3 p = positionAt(surface.mesh(), {triangle, 0.3f, 0.3f}) + 6.0f * skin.spacing() * step;
            const auto hit = surface.query.nearest(p);
            QVERIFY(hit);
            const float found = skin.distance(p);
            // Trilinear mixing of exact distances is off by the bend of the skin within a cell, never more than a cell.
            QVERIFY(std::abs(std::abs(found) - hit->distance) < 1.8f * skin.spacing());
            near += std::abs(std::abs(found) - hit->distance) < 0.3f * skin.spacing() ? 1 : 0;
        }
        QVERIFY2(near > 3600, qPrintable(QString::number(near)));
        QCOMPARE(skin.distance(surface.bounds.max + size), skin.band());
    }

    void raysFromOutsideHitTheOutside_data() { addMeshes(); }
    void raysFromOutsideHitTheOutside() {
        QFETCH(QString, file);
        auto mesh = load(file);
        if (!mesh) QSKIP("The folder of real meshes is not there (WHORL_TEST_DATA).");
        const Surface surface{Cow<SurfaceMesh>(std::move(*mesh))};
        const glm::vec3 size = surface.bounds.size();
        const float reach = glm::length(size);
        int hits = 0;
        int outside = 0;
        for (std::uint64_t i = 0; i < 3000; ++i) {
            const glm::vec3 away =
                glm::normalize(glm::vec3(randomFloat(2, i, 0), randomFloat(2, i, 1), randomFloat(2, i, 2)) - 0.5f);
            const glm::vec3 target = surface.bounds.centre() + 0.3f * size * glm::vec3(away.y, away.z, away.x);
            const auto hit = surface.query.raycast(target + 2.0f * reach * away, -away);
            if (!hit) continue;
            // Through the open neck of a head, rays meet the skin from behind.
            if (glm::dot(away, triangleNormal(surface.mesh(), hit->point.triangle)) < 0.3f) continue;
            ++hits;
            // What a ray hits is on the mesh, and just before it there is air.
            const auto nearest = surface.query.nearest(hit->position);
            QVERIFY(nearest && nearest->distance < 1e-5f * reach);
            outside += surface.skin().distance(hit->position + 1.5f * surface.skin().spacing() * away) > 0.0f ? 1 : 0;
        }
        QVERIFY(hits > 1000);
        QVERIFY2(outside > hits * 97 / 100, qPrintable(QString::number(outside) + " of " + QString::number(hits)));
    }
};

QTEST_APPLESS_MAIN(RealSamplingTest)
#include "real_sampling_test.moc"
