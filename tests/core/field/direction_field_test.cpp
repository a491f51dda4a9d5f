// SPDX-License-Identifier: Apache-2.0
// Laws of the direction field: tangent, smooth, true to strokes, and nothing crosses a parting or the border.
#include "core/base/random.h"
#include "core/field/grow_guides.h"
#include "core/io/mesh_import.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;

namespace {

float degreesBetween(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29578f;
}

/// A stroke over the skin through the places nearest to `points`.
FieldStroke strokeOn(const Surface& surface, const std::vector<glm::vec3>& points, float weight = 1.0f) {
    auto line = tracedParting(surface, points);
    FieldStroke stroke;
    stroke.weight = weight;
    if (line.ok()) stroke.points = *line;
    return stroke;
}

struct Scene {
    std::shared_ptr<const Surface> surface;
    std::vector<std::uint8_t> grows;
    std::vector<Parting> partings;

    explicit Scene(SurfaceMesh mesh) {
        surface = std::make_shared<const Surface>(Cow<SurfaceMesh>(std::move(mesh)));
        grows.assign(surface->mesh().triangleCount(), 1);
    }
    FieldSolver solver() const {
        Progress progress;
        auto made = FieldSolver::make(surface, grows, partings, progress);
        return *made;
    }
    DirectionField solve(const std::vector<FieldStroke>& strokes, const FieldParams& options = {}) const {
        Progress progress;
        return *solver().solve(strokes, options, progress);
    }
    void part(const std::vector<glm::vec3>& points) {
        auto line = tracedParting(*surface, points);
        partings.push_back({static_cast<std::uint32_t>(partings.size() + 1), {}, *line});
    }
};

/// Greatest angle between the field and a stroke's own direction, over `window` points of it each way: flat triangles
/// put kinks into lines on them.
float worstAlong(const Scene& scene, const DirectionField& field, const FieldStroke& stroke, std::size_t window) {
    const SurfaceMesh& mesh = scene.surface->mesh();
    const std::size_t last = stroke.points.size() - 1;
    float worst = 0.0f;
    for (std::size_t i = 0; i <= last; ++i) {
        const glm::vec3 a = positionAt(mesh, stroke.points[i > window ? i - window : 0]);
        const glm::vec3 b = positionAt(mesh, stroke.points[std::min(i + window, last)]);
        const glm::vec3 normal = normalAt(mesh, stroke.points[i]);
        const glm::vec3 way = (b - a) - normal * glm::dot(normal, b - a);
        worst = std::max(worst, degreesBetween(field.at(stroke.points[i]), way));
    }
    return worst;
}

std::vector<FieldStroke> randomStrokes(const Surface& surface, std::uint32_t seed, int count) {
    std::vector<FieldStroke> strokes;
    const float size = glm::length(surface.bounds.size());
    for (int i = 0; i < count; ++i) {
        const auto number = [&](std::uint32_t k) {
            return randomFloat(seed, static_cast<std::uint32_t>(i), k) * 2.0f - 1.0f;
        };
        const glm::vec3 start = surface.bounds.centre() + 0.5f * size * glm::vec3(number(0), number(1), number(2));
        const glm::vec3 way = 0.15f * size * glm::vec3(number(3), number(4), number(5));
        const FieldStroke stroke = strokeOn(surface, {start, start + way, start + 2.0f * way});
        if (stroke.points.size() >= 2) strokes.push_back(stroke);
    }
    return strokes;
}

}  // namespace

class DirectionFieldTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void oneStrokeCombsThePlane() {
        const Scene scene(testing::plane(12));
        const glm::vec3 way = glm::normalize(glm::vec3(0.6f, 0.0f, -0.3f));
        const DirectionField field = scene.solve({strokeOn(*scene.surface, {-0.2f * way, 0.2f * way})});
        for (const glm::vec3& direction : field.vertices()) QVERIFY(degreesBetween(direction, way) < 0.05f);
        QVERIFY(field.singularities().empty());
    }

    void directionsLieOnTheSkin() {
        const Scene scene(testing::sphere(24, 32));
        const DirectionField field = scene.solve(randomStrokes(*scene.surface, 3, 6));
        for (std::uint32_t t = 0; t < scene.surface->mesh().triangleCount(); ++t) {
            const SurfacePoint point{t, 0.3f, 0.3f};
            const glm::vec3 direction = field.at(point);
            QVERIFY(std::abs(glm::dot(direction, normalAt(scene.surface->mesh(), point))) < 1e-5f);
            const float length = glm::length(direction);
            QVERIFY(length == 0.0f || std::abs(length - 1.0f) < 1e-4f);
        }
        for (std::size_t i = 0; i < field.vertices().size(); ++i) {
            QVERIFY(std::abs(glm::dot(field.vertices()[i], scene.surface->mesh().normals[i])) < 1e-5f);
        }
    }

    void strokesAreMet_data() {
        QTest::addColumn<float>("reach");
        QTest::newRow("without a default") << 0.0f;
        QTest::newRow("against the default") << 0.05f;
    }
    void strokesAreMet() {
        QFETCH(float, reach);
        const Scene scene(testing::sphere(96, 128));
        FieldParams options;
        options.reach = reach;
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            for (const FieldStroke& stroke : randomStrokes(*scene.surface, seed, 1)) {
                const DirectionField field = scene.solve({stroke}, options);
                const float worst = worstAlong(scene, field, stroke, 4);
                QVERIFY2(worst < 2.0f, qPrintable(QString("seed %1: %2 degrees").arg(seed).arg(worst)));
            }
        }
        // Many of them, apart from each other.
        std::vector<FieldStroke> ring;
        for (int i = 0; i < 8; ++i) {
            const float a = 0.7854f * static_cast<float>(i);
            const glm::vec3 out(std::cos(a), 0.0f, std::sin(a)), up(0, 1, 0);
            const glm::vec3 slanted = i % 2 ? 0.03f * up : -0.02f * up + 0.02f * glm::cross(out, up);
            ring.push_back(strokeOn(*scene.surface, {0.1f * out - slanted, 0.1f * out + slanted}));
        }
        const DirectionField field = scene.solve(ring, options);
        for (const FieldStroke& stroke : ring) {
            const float worst = worstAlong(scene, field, stroke, 4);
            QVERIFY2(worst < 2.0f, qPrintable(QString::number(worst)));
        }
    }

    void nothingCrossesAParting() {
        Scene scene(testing::plane(16));
        scene.part({{0.01f, 0, -0.5f}, {0.01f, 0, 0.5f}});
        // The parting ends outside the growing area: no way leads round it.
        for (std::uint32_t t = 0; t < scene.grows.size(); ++t) {
            scene.grows[t] = std::abs(positionAt(scene.surface->mesh(), {t, 0.33f, 0.33f}).z) < 0.4f;
        }
        const FieldStroke left = strokeOn(*scene.surface, {{-0.1f, 0, 0}, {-0.4f, 0, 0}});
        const auto right = [&](float z) { return strokeOn(*scene.surface, {{0.1f, 0, 0}, {0.4f, 0, z}}); };
        const DirectionField a = scene.solve({left, right(0.0f)});
        const DirectionField b = scene.solve({left, right(0.25f)});
        const auto& positions = scene.surface->mesh().positions;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const float x = positions[i].x;
            if (std::abs(positions[i].z) > 0.37f) continue;
            const glm::vec3 expected = x < 0.01f ? glm::vec3(-1, 0, 0) : glm::vec3(1, 0, 0);
            QVERIFY(degreesBetween(a.vertices()[i], expected) < 0.1f);
            const bool same = degreesBetween(a.vertices()[i], b.vertices()[i]) < 1e-3f;
            QCOMPARE(same, x < 0.01f);
        }
        // Nor does reading it: right up to the line there are two directions and nothing between.
        for (float x = -0.2f; x < 0.2f; x += 0.003f) {
            if (std::abs(x - 0.01f) < 1e-3f) continue;
            const auto hit = scene.surface->query.nearest({x, 0, 0.013f});
            const glm::vec3 expected = x < 0.01f ? glm::vec3(-1, 0, 0) : glm::vec3(1, 0, 0);
            QVERIFY2(degreesBetween(a.at(hit->point), expected) < 0.1f, qPrintable(QString::number(x)));
        }
    }

    // The middle vertices of a symmetric mesh lie in a middle parting, and rounding has them now on one side of its
    // line and now on the other.
    void nothingCrossesAPartingThroughVertices() {
        for (const float away : {0.0f, 8.0f, 100.0f}) {
            SurfaceMesh mesh = testing::sphere(16, 16, 1.0f);
            for (glm::vec3& p : mesh.positions) {
                if (std::abs(p.x) < 1e-5f) p.x = 0.0f;
                p += glm::vec3(0, away, 0.3f * away);
            }
            const glm::vec3 middle(0, away, 0.3f * away);
            Scene scene(std::move(mesh));
            for (std::uint32_t t = 0; t < scene.grows.size(); ++t)
                scene.grows[t] = positionAt(scene.surface->mesh(), {t, 0.33f, 0.33f}).y - away > 0.5f;
            std::vector<glm::vec3> line;
            for (float up = 0.2f; up < 2.95f; up += 0.01f)
                line.push_back(middle + glm::vec3(0, std::sin(up), std::cos(up)));
            scene.part(line);
            const auto aside = [&](float side, float turn) {
                return strokeOn(*scene.surface, {middle + glm::vec3(0.3f * side, 0.95f, -turn),
                                                 middle + glm::vec3(0.6f * side, 0.8f, turn)});
            };
            const DirectionField a = scene.solve({aside(-1, 0), aside(1, 0)}),
                                 b = scene.solve({aside(-1, 0), aside(1, 0.3f)});
            int turned = 0;
            for (std::uint32_t t = 0; t < scene.grows.size(); ++t) {
                if (!scene.grows[t]) continue;
                const SurfacePoint place{t, 0.2f + 0.5f * randomFloat(4, t, 0), 0.2f * randomFloat(4, t, 1)};
                const float off = degreesBetween(a.at(place), b.at(place));
                turned += off > 10.0f;
                if (positionAt(scene.surface->mesh(), place).x < 0.0f)
                    QVERIFY2(off < 1e-3f, qPrintable(QString("%1 degrees, %2 away").arg(off).arg(away)));
            }
            QVERIFY(turned > 20);
        }
    }

    void nothingCrossesTheBorder() {
        Scene scene(testing::plane(16));
        // A bald stripe between two growing halves.
        for (std::uint32_t t = 0; t < scene.grows.size(); ++t) {
            const float x = positionAt(scene.surface->mesh(), {t, 0.33f, 0.33f}).x;
            scene.grows[t] = std::abs(x) > 0.1f;
        }
        const DirectionField field = scene.solve({strokeOn(*scene.surface, {{-0.2f, 0, 0}, {-0.4f, 0, 0}}),
                                                  strokeOn(*scene.surface, {{0.2f, 0, 0.0f}, {0.2f, 0, 0.3f}})});
        for (std::uint32_t t = 0; t < scene.grows.size(); ++t) {
            const SurfacePoint point{t, 0.33f, 0.33f};
            const float x = positionAt(scene.surface->mesh(), point).x;
            const glm::vec3 direction = field.at(point);
            if (!scene.grows[t]) {
                QCOMPARE(glm::length(direction), 0.0f);
            } else {
                QVERIFY(degreesBetween(direction, x < 0 ? glm::vec3(-1, 0, 0) : glm::vec3(0, 0, 1)) < 0.1f);
            }
        }
    }

    void turningEverythingTurnsTheField() {
        const glm::quat turn = glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.33f));
        SurfaceMesh mesh = testing::sphere(20, 24);
        const Scene before(mesh);
        for (glm::vec3& p : mesh.positions) p = turn * p;
        for (glm::vec3& n : mesh.normals) n = turn * n;
        const Scene after(mesh);
        const std::vector<FieldStroke> strokes = randomStrokes(*before.surface, 9, 5);
        const DirectionField a = before.solve(strokes), b = after.solve(strokes);
        int compared = 0;
        for (std::size_t i = 0; i < a.vertices().size(); ++i) {
            if (degreesBetween(turn * a.vertices()[i], b.vertices()[i]) < 0.5f) ++compared;
        }
        // Around a singularity a rounding error turns directions by much.
        QVERIFY2(compared > static_cast<int>(a.vertices().size()) * 98 / 100, qPrintable(QString::number(compared)));
    }

    void aBallCanNotBeCombedFlat() {
        // Poincare and Hopf: the indices of a field on a ball sum to two.
        const Scene scene(testing::sphere(24, 32));
        for (std::uint32_t seed = 1; seed <= 5; ++seed) {
            const DirectionField field = scene.solve(randomStrokes(*scene.surface, seed, 4));
            int sum = 0;
            for (const FieldSingularity& s : field.singularities()) sum += s.index;
            QCOMPARE(sum, 2);
        }
    }

    void withoutStrokesHairHangsAndFallsFromTheParting() {
        Scene scene(testing::sphere(48, 64));
        FieldParams options;
        const DirectionField plain = scene.solve({}, options);
        const auto& mesh = scene.surface->mesh();
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3 n = mesh.normals[i];
            if (std::abs(n.y) > 0.8f) continue;
            const glm::vec3 down = glm::vec3(0, -1, 0) + n * n.y;
            QVERIFY(degreesBetween(plain.vertices()[i], down) < 3.0f);
        }
        scene.part({{0, 0.1f, -0.03f}, {0, 0.1f, 0.03f}});
        const DirectionField parted = scene.solve({}, options);
        for (const float side : {-1.0f, 1.0f}) {
            const auto hit = scene.surface->query.nearest({side * 0.006f, 0.1f, 0.0f});
            QVERIFY(degreesBetween(parted.at(hit->point), {side, 0, 0}) < 15.0f);
        }
    }

    void heavierStrokesWin() {
        const Scene scene(testing::plane(12));
        const auto across = [&](float weight) {
            return strokeOn(*scene.surface, {{-0.2f, 0, 0}, {0.2f, 0, 0}}, weight);
        };
        const auto along = [&](float weight) {
            return strokeOn(*scene.surface, {{0, 0, -0.2f}, {0, 0, 0.2f}}, weight);
        };
        const auto middle = scene.surface->query.nearest({0.3f, 0, 0.3f});
        const glm::vec3 even = scene.solve({across(1), along(1)}).at(middle->point);
        QVERIFY(degreesBetween(even, {1, 0, 1}) < 5.0f);
        QVERIFY(scene.solve({across(50), along(0.02f)}).at(scene.surface->query.nearest({0, 0, 0})->point).x > 0.98f);
    }

    void guidesLieAlongTheField() {
        Groom groom = testing::groomOn(testing::sphere(48, 64), 200, 12, 0.04f);
        const Scene scene(*groom.mesh);
        const std::vector<FieldStroke> strokes = randomStrokes(*scene.surface, 5, 4);
        const DirectionField field = scene.solve(strokes);
        const Groom before = groom;
        Progress progress;
        QVERIFY(growGuidesAlong(groom, *scene.surface, field, {.lift = 0.2f}, progress).ok());
        double sum = 0.0;
        int pieces = 0;
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const auto points = groom.guides.points(i);
            QCOMPARE(points.size(), before.guides.points(i).size());
            QCOMPARE(points[0], before.guides.points(i)[0]);
            for (std::size_t k = 1; k < points.size(); ++k) {
                const float step = glm::distance(points[k - 1], points[k]);
                QVERIFY(std::abs(step - 0.04f / 12.0f) < 1e-5f);
                // A ball of flat triangles lies a little inside of the ball.
                QVERIFY(glm::length(points[k]) > 0.0998f);
                const auto skin = scene.surface->query.nearest((points[k - 1] + points[k]) * 0.5f);
                const glm::vec3 normal = normalAt(scene.surface->mesh(), skin->point);
                const glm::vec3 way = points[k] - points[k - 1];
                sum += static_cast<double>(degreesBetween(way - normal * glm::dot(normal, way), field.at(skin->point)));
                ++pieces;
            }
        }
        QVERIFY2(sum / pieces < 5.0, qPrintable(QString::number(sum / pieces)));
        // Another length, and straight up.
        QVERIFY(growGuidesAlong(groom, *scene.surface, field, {.length = 0.01f, .lift = 0.0f}, progress).ok());
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            for (const glm::vec3& p : groom.guides.points(i)) QVERIFY(glm::length(p) < 0.1015f);
        }
        // Without directions nothing happens; cancelled neither.
        const std::uint64_t digest = testing::groomDigest(groom);
        QVERIFY(growGuidesAlong(groom, *scene.surface, DirectionField(), {}, progress).ok());
        progress.cancel();
        QVERIFY(!growGuidesAlong(groom, *scene.surface, field, {}, progress).ok());
        QCOMPARE(testing::groomDigest(groom), digest);
    }

    void strangeInputIsTaken() {
        Scene scene(testing::plane(4));
        const FieldStroke good = strokeOn(*scene.surface, {{-0.2f, 0, 0}, {0.2f, 0, 0}});
        FieldStroke bad, nothing, weightless = good;
        bad.points = {{99999, 0.2f, 0.2f}, {0, 0.2f, 0.2f}, {0, 0.2f, 0.2f}};
        weightless.weight = 0.0f;
        const DirectionField field = scene.solve({bad, nothing, weightless, good});
        for (const glm::vec3& direction : field.vertices()) QVERIFY(degreesBetween(direction, {1, 0, 0}) < 0.1f);
        QCOMPARE(field.at({99999, 0.2f, 0.2f}), glm::vec3(0.0f));
        QCOMPARE(DirectionField().at({0, 0.2f, 0.2f}), glm::vec3(0.0f));
        std::ranges::fill(scene.grows, std::uint8_t{0});
        const DirectionField bald = scene.solve({good});
        for (const glm::vec3& direction : bald.vertices()) QCOMPARE(direction, glm::vec3(0.0f));
        Progress cancelled;
        cancelled.cancel();
        QVERIFY(!FieldSolver::make(scene.surface, scene.grows, {}, cancelled).ok());
    }

    void aRealHead() {
        const auto file = testing::realData("heads/makehuman_derived/head_neutral_sub1.glb");
        if (!file) QSKIP("The folder of real data is not here.");
        Progress progress;
        auto imported = importMesh(*file, progress);
        QVERIFY(imported.ok());
        const Scene scene(std::move(imported->mesh));
        FieldParams options;
        const Bounds bounds = scene.surface->bounds;
        options.reach = 0.3f * glm::length(bounds.size());
        // Over the skull, from above, as an artist draws.
        const glm::vec3 middle(bounds.centre().x, glm::mix(bounds.min.y, bounds.max.y, 0.75f), bounds.centre().z);
        std::vector<FieldStroke> strokes;
        for (int i = 0; i < 6; ++i) {
            std::vector<glm::vec3> places;
            for (int k = 0; k <= 32; ++k) {
                const float around = 1.047f * static_cast<float>(i) + 0.015f * static_cast<float>(k);
                const float up = 1.25f - 0.02f * static_cast<float>(k);
                const glm::vec3 out(std::cos(up) * std::cos(around), std::sin(up), std::cos(up) * std::sin(around));
                const glm::vec3 start = middle + out * glm::length(bounds.size());
                if (const auto hit = scene.surface->query.raycast(start, -out)) places.push_back(hit->position);
            }
            strokes.push_back(strokeOn(*scene.surface, places));
            QVERIFY(strokes.back().points.size() > 5);
        }
        const DirectionField field = scene.solve(strokes, options);
        for (const FieldStroke& stroke : strokes) {
            const float worst = worstAlong(scene, field, stroke, 2);
            QVERIFY2(worst < 2.0f, qPrintable(QString::number(worst)));
        }
    }
};

QTEST_GUILESS_MAIN(DirectionFieldTest)
#include "direction_field_test.moc"
