// SPDX-License-Identifier: Apache-2.0
// Laws of the direction field on meshes of artists: on the skin, true to strokes, parted, and with no more and no fewer
// whorls than the shape asks for.
#include "core/base/random.h"
#include "core/surface/adjacency.h"
#include "tests/support/real_scene.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>
#include <set>

using namespace whorl;
using namespace whorl::testing;

namespace {

/// Four places in every triangle that grows hair.
std::vector<SurfacePoint> placesOf(const CrownScene& scene) {
    std::vector<SurfacePoint> places;
    for (std::uint32_t t = 0; t < scene.grows.size(); ++t) {
        for (std::uint32_t k = 0; k < 4 && scene.grows[t]; ++k) {
            const float u = randomFloat(1, t, k), v = randomFloat(2, t, k);
            places.push_back(u + v > 1.0f ? SurfacePoint{t, 1.0f - u, 1.0f - v} : SurfacePoint{t, u, v});
        }
    }
    return places;
}

/// Triangles that hang together over edges of two.
struct Body {
    std::vector<std::uint32_t> triangles{};
    std::set<std::uint32_t> vertices{};
    bool closed = true;
    /// Vertices less edges plus triangles, where it is closed.
    int characteristic() const { return static_cast<int>(vertices.size()) - static_cast<int>(triangles.size() / 2); }
};

std::vector<Body> bodiesOf(const SurfaceMesh& mesh) {
    const auto across = trianglesAcross(mesh);
    std::vector<Body> bodies;
    std::vector<std::uint8_t> known(mesh.triangleCount(), 0);
    for (std::uint32_t start = 0; start < mesh.triangleCount(); ++start) {
        if (known[start]) continue;
        Body body;
        body.triangles.push_back(start);
        known[start] = 1;
        for (std::size_t i = 0; i < body.triangles.size(); ++i) {
            for (int k = 0; k < 3; ++k) body.vertices.insert(mesh.triangles[body.triangles[i]][k]);
            for (const std::uint32_t next : across[body.triangles[i]]) {
                body.closed = body.closed && next != noTriangle;
                if (next == noTriangle || known[next]) continue;
                known[next] = 1;
                body.triangles.push_back(next);
            }
        }
        bodies.push_back(std::move(body));
    }
    return bodies;
}

}  // namespace

class RealFieldTest : public QObject {
    Q_OBJECT

    static void addMeshes() {
        QTest::addColumn<int>("number");
        for (std::size_t i = 0; i < realMeshes().size(); ++i)
            QTest::newRow(realMeshes()[i].name) << static_cast<int>(i);
    }
    static std::optional<CrownScene> sceneOf(int number) {
        const RealMesh& real = realMeshes()[static_cast<std::size_t>(number)];
        auto mesh = meshOf(real, WHORL_SAMPLES);
        if (!mesh) return std::nullopt;
        return std::make_optional<CrownScene>(real, std::move(*mesh));
    }

private Q_SLOTS:
    void directionsLieOnTheSkin_data() { addMeshes(); }
    void directionsLieOnTheSkin() {
        QFETCH(int, number);
        const auto scene = sceneOf(number);
        if (!scene) QSKIP("The folder of real data is not here.");
        const SurfaceMesh& mesh = scene->surface->mesh();
        const auto check = [](const glm::vec3& direction, const glm::vec3& normal) {
            return std::abs(glm::dot(direction, normal)) < 1e-5f && std::abs(glm::length(direction) - 1.0f) < 1e-4f;
        };
        std::vector<std::uint8_t> grown(mesh.positions.size(), 0);
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
            for (int k = 0; k < 3 && scene->grows[t]; ++k) grown[mesh.triangles[t][k]] = 1;
        for (std::size_t i = 0; i < grown.size(); ++i) {
            const glm::vec3& direction = scene->field.vertices()[i];
            QVERIFY(grown[i] ? check(direction, mesh.normals[i]) : direction == glm::vec3(0.0f));
        }
        // Inside triangles the normal is the one between those of the corners.
        for (const SurfacePoint& place : placesOf(*scene))
            QVERIFY(check(scene->field.at(place), normalAt(mesh, place)));
    }

    void strokesAreMet_data() { addMeshes(); }
    void strokesAreMet() {
        QFETCH(int, number);
        const auto scene = sceneOf(number);
        if (!scene) QSKIP("The folder of real data is not here.");
        QCOMPARE(scene->groom.strokes->size(), std::size_t{8});
        for (const FieldStroke& stroke : *scene->groom.strokes) {
            const auto [worst, places] = worstAlong(*scene, stroke);
            QVERIFY(places > 5);
            QVERIFY2(worst < 2.0f, qPrintable(QString("stroke %1: %2 degrees").arg(stroke.id).arg(worst)));
        }
    }

    // Strokes of one side turn by 50 degrees: nothing of the other side does.
    void aPartingSeparates_data() { addMeshes(); }
    void aPartingSeparates() {
        QFETCH(int, number);
        const auto scene = sceneOf(number);
        if (!scene) QSKIP("The folder of real data is not here.");
        QVERIFY(scene->separates());
        const SurfaceMesh& mesh = scene->surface->mesh();
        const std::vector<SurfacePoint> places = placesOf(*scene);
        for (const int side : {-1, 1}) {
            CrownScene other = *scene;
            other.turnStrokes(side, 0.9f);
            other.solve();
            int turned = 0, here = 0, there = 0;
            for (const SurfacePoint& place : places) {
                const glm::vec3 position = positionAt(mesh, place);
                if (scene->onTheLine(position)) continue;
                const float off = degreesBetween(scene->field.at(place), other.field.at(place));
                if (scene->sideOf(position) == side) {
                    ++here;
                    turned += off > 10.0f;
                    continue;
                }
                ++there;
                QVERIFY2(off < 1e-3f, qPrintable(QString("%1 degrees at %2, %3, %4")
                                                     .arg(off)
                                                     .arg(position.x - scene->crown.x)
                                                     .arg(position.y)
                                                     .arg(position.z)));
            }
            QVERIFY2(there > 200 && here > 200 && turned > here / 2,
                     qPrintable(QString("%1 of %2").arg(turned).arg(here)));
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                if (scene->onTheLine(mesh.positions[i]) || scene->sideOf(mesh.positions[i]) == side) continue;
                QVERIFY(degreesBetween(scene->field.vertices()[i], other.field.vertices()[i]) < 1e-3f);
            }
        }
    }

    // Poincare and Hopf: on a closed body the indices of all whorls and saddles sum to its characteristic, 2 on a ball,
    // 0 on a ring.
    void whorlsSumToWhatTheShapeAsks_data() { addMeshes(); }
    void whorlsSumToWhatTheShapeAsks() {
        QFETCH(int, number);
        auto scene = sceneOf(number);
        if (!scene) QSKIP("The folder of real data is not here.");
        std::ranges::fill(scene->grows, std::uint8_t{1});
        scene->groom.partings.edit().clear();
        const std::vector<Body> bodies = bodiesOf(scene->surface->mesh());
        if (std::ranges::none_of(bodies, &Body::closed)) QSKIP("The mesh has openings.");
        for (const float turn : {0.0f, 1.6f}) {
            scene->turnStrokes(-1, turn);
            scene->solve();
            std::vector<int> indices(scene->grows.size(), 0);
            for (const FieldSingularity& s : scene->field.singularities()) indices[s.triangle] += s.index;
            for (const Body& body : bodies) {
                if (!body.closed) continue;
                int sum = 0;
                for (const std::uint32_t t : body.triangles) sum += indices[t];
                QCOMPARE(sum, body.characteristic());
            }
        }
    }
};

QTEST_GUILESS_MAIN(RealFieldTest)
#include "real_field_test.moc"
