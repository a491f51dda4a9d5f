// SPDX-License-Identifier: Apache-2.0
// Laws of strokes that attract, repel and make whorls.
#include "core/base/random.h"
#include "core/field/direction_field.h"
#include "core/io/mesh_import.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;

namespace {

struct Scene {
    std::shared_ptr<const Surface> surface;
    std::vector<std::uint8_t> grows;
    std::vector<Parting> partings;

    explicit Scene(SurfaceMesh mesh)
        : surface(std::make_shared<const Surface>(Cow<SurfaceMesh>(std::move(mesh)))),
          grows(surface->mesh().triangleCount(), 1) {}
    DirectionField solve(const std::vector<FieldStroke>& strokes, const FieldParams& params = {}) const {
        Progress progress;
        const auto solver = FieldSolver::make(surface, grows, partings, progress);
        return *solver->solve(strokes, params, progress);
    }
    SurfacePoint at(const glm::vec3& place) const { return surface->query.nearest(place)->point; }
    FieldStroke stroke(StrokeKind kind, float radius, const std::vector<glm::vec3>& places) const {
        FieldStroke made;
        made.kind = kind;
        made.radius = radius;
        if (places.size() == 1) {
            made.points = {at(places.front())};
        } else {
            made.points = *tracedParting(*surface, places);
        }
        return made;
    }
    glm::vec3 normal(const SurfacePoint& point) const { return normalAt(surface->mesh(), point); }
};

float degreesBetween(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29578f;
}

/// What a stroke of a kind asks for where the way over the skin to it is `to`.
glm::vec3 asked(StrokeKind kind, const glm::vec3& to, const glm::vec3& normal) {
    const glm::vec3 along = to - normal * glm::dot(normal, to);
    if (kind == StrokeKind::Attract) return along;
    if (kind == StrokeKind::Repel) return -along;
    return glm::cross(normal, kind == StrokeKind::Whorl ? -along : along);
}

constexpr StrokeKind aroundPoints[] = {StrokeKind::Attract, StrokeKind::Repel, StrokeKind::Whorl,
                                       StrokeKind::ClockwiseWhorl};

}  // namespace

class StrokeKindsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aroundAPointOfThePlane() {
        const Scene scene(testing::plane(40));
        const glm::vec3 centre(0.07f, 0.0f, -0.04f);
        const FieldStroke along = scene.stroke(StrokeKind::Along, 0.0f, {{-0.45f, 0, 0.4f}, {0.45f, 0, 0.4f}});
        for (const StrokeKind kind : aroundPoints) {
            const DirectionField field = scene.solve({along, scene.stroke(kind, 0.25f, {centre})});
            for (std::uint32_t i = 0; i < 400; ++i) {
                const float angle = randomFloat(1, i, 0) * 6.2832f, far = 0.01f + 0.19f * randomFloat(1, i, 1);
                const glm::vec3 place = centre + far * glm::vec3(std::cos(angle), 0, std::sin(angle));
                // Between vertices of cells of 2.5 cm a direction that turns is only as good as they are dense.
                const float bound = far < 0.05f ? 10.0f : 4.0f;
                const float off = degreesBetween(field.at(scene.at(place)), asked(kind, centre - place, {0, 1, 0}));
                QVERIFY2(
                    far < 0.025f || off < bound,
                    qPrintable(QString("kind %1 at %2 m: %3 degrees").arg(static_cast<int>(kind)).arg(far).arg(off)));
            }
            int inside = 0;
            for (const FieldSingularity& s : field.singularities()) {
                const glm::vec3 place = positionAt(scene.surface->mesh(), {s.triangle, 0.33f, 0.33f});
                if (glm::distance(place, centre) < 0.2f) inside += s.index;
                if (glm::distance(place, centre) < 0.2f) QVERIFY(glm::distance(place, centre) < 0.03f);
            }
            QCOMPARE(inside, 1);
            // The stroke beyond is met as if the other one were not there.
            for (float x = -0.4f; x < 0.41f; x += 0.05f)
                QVERIFY(degreesBetween(field.at(scene.at({x, 0, 0.4f})), {1, 0, 0}) < 2.0f);
        }
    }

    void toALineAndFromIt() {
        const Scene scene(testing::plane(40));
        const FieldStroke along = scene.stroke(StrokeKind::Along, 0.0f, {{-0.45f, 0, 0.4f}, {0.45f, 0, 0.4f}});
        for (const StrokeKind kind : {StrokeKind::Attract, StrokeKind::Repel}) {
            // A corner in the line.
            const DirectionField field =
                scene.solve({along, scene.stroke(kind, 0.2f, {{-0.3f, 0, 0.02f}, {0, 0, 0.02f}, {0, 0, -0.3f}})});
            const auto check = [&](const glm::vec3& place, const glm::vec3& to) {
                const float off = degreesBetween(field.at(scene.at(place)), asked(kind, to, {0, 1, 0}));
                QVERIFY2(off < 6.0f, qPrintable(QString("%1 %2: %3").arg(place.x).arg(place.z).arg(off)));
            };
            for (float far = 0.03f; far < 0.13f; far += 0.02f) {
                check({-0.2f, 0, 0.02f + far}, {0, 0, -1});
                check({-0.2f, 0, 0.02f - far}, {0, 0, 1});
                check({far, 0, -0.2f}, {-1, 0, 0});
                check({-far, 0, -0.2f}, {1, 0, 0});
                check({0.7071f * far, 0, 0.02f + 0.7071f * far}, {-1, 0, -1});
            }
        }
    }

    void overTheSkinNotThroughIt() {
        // Two sheets a millimetre apart: what is near in space is far over the skin.
        SurfaceMesh mesh = testing::plane(20);
        const SurfaceMesh other = mesh;
        const auto count = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::size_t i = 0; i < count; ++i) {
            mesh.positions.push_back(other.positions[i] - glm::vec3(0, 0.001f, 0));
            mesh.normals.push_back(-other.normals[i]);
        }
        for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back(glm::uvec3(t.x, t.z, t.y) + count);
        mesh.cornerUvs.insert(mesh.cornerUvs.end(), other.cornerUvs.begin(), other.cornerUvs.end());
        mesh.parts.front().triangleCount = mesh.triangleCount();
        const Scene scene(mesh);
        FieldParams params;
        params.gravity.value = {1, 0, 0};
        const DirectionField field = scene.solve({scene.stroke(StrokeKind::Whorl, 0.2f, {{0, 0.01f, 0}})}, params);
        for (std::size_t i = count; i < mesh.positions.size(); ++i)
            QVERIFY(degreesBetween(field.vertices()[i], {1, 0, 0}) < 0.1f);
        QVERIFY(field.at(scene.at({0.1f, 0.01f, 0})).z < -0.98f);
    }

    void notBeyondAParting() {
        Scene scene(testing::plane(40));
        scene.partings.push_back(
            {1, {}, *tracedParting(*scene.surface, std::vector<glm::vec3>{{0.05f, 0, -0.5f}, {0.05f, 0, 0.5f}})});
        // The parting ends outside the growing area: no way leads round it.
        for (std::uint32_t t = 0; t < scene.grows.size(); ++t)
            scene.grows[t] = std::abs(positionAt(scene.surface->mesh(), {t, 0.33f, 0.33f}).z) < 0.4f;
        FieldParams params;
        params.gravity.value = {1, 0, 0};
        params.partingWidth = 0.0f;
        const DirectionField field = scene.solve({scene.stroke(StrokeKind::Attract, 0.3f, {{0, 0, 0}})}, params);
        for (float z = -0.2f; z < 0.21f; z += 0.04f) {
            QVERIFY(degreesBetween(field.at(scene.at({0.07f, 0, z})), {1, 0, 0}) < 0.5f);
            const glm::vec3 place(-0.1f, 0, z);
            QVERIFY(degreesBetween(field.at(scene.at(place)), -place) < 6.0f);
        }
    }

    void weightFallsToNothingAtTheRadius() {
        const Scene scene(testing::plane(60));
        std::vector<FieldStroke> strokes;
        for (const float z : {-0.45f, 0.45f})
            strokes.push_back(scene.stroke(StrokeKind::Along, 0.0f, {{-0.45f, 0, z}, {0.45f, 0, z}}));
        FieldParams params;
        params.reach = 0.05f;
        params.gravity.value = {1, 0, 0};
        strokes.push_back(scene.stroke(StrokeKind::Repel, 0.2f, {{0, 0, 0}}));
        const DirectionField field = scene.solve(strokes, params);
        // From the core outward the angle to what is around falls, without a jump.
        float before = 90.0f;
        for (float far = 0.05f; far < 0.4f; far += 0.005f) {
            const float angle = degreesBetween(field.at(scene.at({0, 0, far})), {1, 0, 0});
            QVERIFY2(angle < before + 1.0f && angle > before - 20.0f,
                     qPrintable(QString("%1: %2 after %3").arg(far).arg(angle).arg(before)));
            before = angle;
        }
        QVERIFY(before < 3.0f);
        // A light stroke gives way sooner.
        strokes.back().weight = 0.02f;
        const DirectionField light = scene.solve(strokes, params);
        QVERIFY(degreesBetween(light.at(scene.at({0, 0, 0.15f})), {1, 0, 0}) <
                degreesBetween(field.at(scene.at({0, 0, 0.15f})), {1, 0, 0}) - 10.0f);
    }

    void aWhorlAtTheCrownOfARealHead() {
        const auto file = testing::realData("heads/makehuman_derived/head_neutral_sub2.glb");
        if (!file) QSKIP("The folder of real data is not here.");
        Progress progress;
        auto imported = importMesh(*file, progress);
        QVERIFY(imported.ok());
        const Scene scene(std::move(imported->mesh));
        const auto solver = FieldSolver::make(scene.surface, scene.grows, {}, progress);
        const Bounds bounds = scene.surface->bounds;
        const float size = bounds.size().y;
        for (const StrokeKind kind : aroundPoints) {
            for (int place = 0; place < 3; ++place) {
                // Crown, side of the skull and back of the head.
                const glm::vec3 out = glm::normalize(place == 0   ? glm::vec3(0.1f, 1.0f, -0.4f)
                                                     : place == 1 ? glm::vec3(1.0f, 0.8f, 0.0f)
                                                                  : glm::vec3(0.2f, 0.2f, -1.0f));
                const glm::vec3 middle(bounds.centre().x, bounds.max.y - 0.35f * size, bounds.centre().z);
                const auto hit = scene.surface->query.raycast(middle + out * (2.0f * size), -out);
                QVERIFY(hit.has_value());
                // The scalp is coarse: edges of 4 % of the height.
                const float radius = 0.25f * size;
                FieldStroke stroke;
                stroke.kind = kind;
                stroke.radius = radius;
                stroke.points = {hit->point};
                const DirectionField field = *solver->solve(std::vector{stroke}, {}, progress);
                int checked = 0, inside = 0;
                const SurfaceMesh& mesh = scene.surface->mesh();
                const glm::vec3 side = glm::normalize(glm::cross(out, glm::vec3(0.3f, 0.1f, 1.0f)));
                for (std::uint32_t i = 0; i < 300; ++i) {
                    const float angle = randomFloat(2, i, 0) * 6.2832f;
                    const float away = radius * (0.3f + 0.3f * randomFloat(2, i, 1));
                    const glm::vec3 over =
                        hit->position + away * (side * std::cos(angle) + glm::cross(out, side) * std::sin(angle));
                    const auto under = scene.surface->query.raycast(over + out * radius, -out, 2.0f * radius);
                    if (!under) continue;
                    const glm::vec3 normal = scene.normal(under->point), to = hit->position - under->position;
                    // The straight way in space, laid on the skin, is near that over it where the skin is smooth.
                    if (glm::length(to) > 0.6f * radius || glm::dot(normal, out) < 0.6f) continue;
                    const float off = degreesBetween(field.at(under->point), asked(kind, to, normal));
                    QVERIFY2(off < 10.0f, qPrintable(QString("%1 at place %2: %3 of the radius, %4 degrees")
                                                         .arg(static_cast<int>(kind))
                                                         .arg(place)
                                                         .arg(glm::length(to) / radius)
                                                         .arg(off)));
                    ++checked;
                }
                QVERIFY2(checked > 100, qPrintable(QString("%1 at place %2").arg(checked).arg(place)));
                for (const FieldSingularity& s : field.singularities()) {
                    const float far = glm::distance(positionAt(mesh, {s.triangle, 0.33f, 0.33f}), hit->position);
                    if (far < 0.4f * radius) inside += s.index;
                }
                QCOMPARE(inside, 1);
            }
        }
    }

    void strangeInputIsTaken() {
        const Scene scene(testing::plane(6));
        const DirectionField plain = scene.solve({});
        for (const StrokeKind kind : aroundPoints) {
            FieldStroke none, off, flat = scene.stroke(kind, 0.0f, {{0, 0, 0}});
            none.kind = off.kind = kind;
            none.radius = off.radius = 0.3f;
            off.points = {{99999, 0.2f, 0.2f}};
            const DirectionField field = scene.solve({none, off, flat});
            for (std::size_t i = 0; i < plain.vertices().size(); ++i)
                QCOMPARE(field.vertices()[i], plain.vertices()[i]);
            // More radius than there is mesh.
            const DirectionField wide = scene.solve({scene.stroke(kind, 100.0f, {{0.02f, 0, 0.03f}})});
            for (const glm::vec3& direction : wide.vertices()) QVERIFY(std::abs(glm::length(direction) - 1.0f) < 1e-4f);
        }
    }
};

QTEST_GUILESS_MAIN(StrokeKindsTest)
#include "stroke_kinds_test.moc"
