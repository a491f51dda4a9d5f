// SPDX-License-Identifier: Apache-2.0
// Strokes in a script, and guides grown along them.
#include "core/base/random.h"
#include "core/brushes/constraints.h"
#include "core/commands/command.h"
#include "core/field/groom_field.h"
#include "core/field/growing_area.h"
#include "core/io/open.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <sstream>

using namespace whorl;

namespace {

/// A torus, outward.
SurfaceMesh ring(std::uint32_t around, std::uint32_t across) {
    SurfaceMesh mesh;
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % around * across + j % across; };
    for (std::uint32_t i = 0; i < around; ++i) {
        const float a = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(around);
        const glm::vec3 outward(std::cos(a), 0.0f, -std::sin(a));
        for (std::uint32_t j = 0; j < across; ++j) {
            const float b = 2.0f * std::numbers::pi_v<float> * static_cast<float>(j) / static_cast<float>(across);
            mesh.normals.push_back(outward * std::cos(b) + glm::vec3(0.0f, std::sin(b), 0.0f));
            mesh.positions.push_back(outward * 0.1f + mesh.normals.back() * 0.04f);
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i, j + 1));
            mesh.triangles.emplace_back(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    mesh.cornerUvs.assign(mesh.triangles.size() * 3, glm::vec2(0.5f));
    mesh.parts.push_back({.name = "ring", .firstTriangle = 0, .triangleCount = mesh.triangleCount()});
    return mesh;
}

/// The plane with a part "middle", a square a quarter as wide.
SurfaceMesh framed(int cells) {
    SurfaceMesh mesh = testing::plane(cells);
    const auto inside = [&](const glm::uvec3& t) {
        const glm::vec3 p = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
        return std::max(std::abs(p.x), std::abs(p.z)) < 0.125f;
    };
    const auto middle = static_cast<std::uint32_t>(std::ranges::stable_partition(mesh.triangles, inside).begin() -
                                                   mesh.triangles.begin());
    for (std::size_t i = 0; i < mesh.cornerUvs.size(); ++i) {
        const glm::vec3& p = mesh.positions[mesh.triangles[i / 3][static_cast<int>(i % 3)]];
        mesh.cornerUvs[i] = glm::vec2(p.x, p.z) + 0.5f;
    }
    mesh.parts = {{.name = "middle", .firstTriangle = 0, .triangleCount = middle},
                  {.name = "frame", .firstTriangle = middle, .triangleCount = mesh.triangleCount() - middle}};
    return mesh;
}

using Edges = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Edges of the triangles that `grows` (empty: all) has, the way that they go around.
Edges edgesOf(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& grows) {
    Edges edges;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        if (!grows.empty() && !grows[t]) continue;
        for (int k = 0; k < 3; ++k) edges.emplace(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
    }
    return edges;
}

/// Vertices less edges plus triangles; nothing where the mesh has a border.
std::optional<int> characteristicOf(const SurfaceMesh& mesh) {
    const Edges edges = edgesOf(mesh, {});
    std::set<std::uint32_t> vertices;
    for (const auto& [a, b] : edges) {
        if (!edges.contains({b, a})) return std::nullopt;
        vertices.insert(a);
    }
    if (edges.size() != 3 * mesh.triangles.size()) return std::nullopt;
    return static_cast<int>(vertices.size()) - static_cast<int>(edges.size() / 2) +
           static_cast<int>(mesh.triangles.size());
}

}  // namespace

class FieldCommandsTest : public QObject {
    Q_OBJECT

    CommandContext m_context;

    Result<std::string> say(const std::string& line) {
        Progress progress;
        const std::vector<Command> commands = coreCommands();
        return runScript(commands, m_context, line, "test", progress);
    }

    Progress m_progress;
    int m_sum = 0;  // that the last list ends with

    /// What "singularities" lists, where its positions are those of its triangles.
    std::vector<FieldSingularity> list() {
        std::vector<FieldSingularity> all;
        m_sum = 1000;
        const auto said = say("singularities");
        std::istringstream lines(said ? *said : std::string());
        for (std::string line; std::getline(lines, line);) {
            FieldSingularity place;
            glm::vec3 at(0.0f);
            unsigned count = 0;
            if (std::sscanf(line.c_str(), "%d at %f,%f,%f in triangle %u", &place.index, &at.x, &at.y, &at.z,
                            &place.triangle) == 5) {
                const glm::vec3 middle = positionAt(*m_context.groom.mesh, {place.triangle, 1.0f / 3.0f, 1.0f / 3.0f});
                if (glm::distance(at, middle) > 1e-6f) return {};
                all.push_back(place);
            } else if (std::sscanf(line.c_str(), "%u in all, sum %d", &count, &m_sum) != 2 || count != all.size()) {
                m_sum = 1000;
            }
        }
        return all;
    }

    int turnsAlongTheBorder(const std::vector<std::uint8_t>& grows) {
        const auto surface = m_context.surfaces.get(m_context.groom.mesh);
        const auto field = groomField(m_context.groom, surface, m_progress);
        if (!field) return 1000;
        // Edges that one growing triangle has.
        const Edges edges = edgesOf(surface->mesh(), grows);
        double turned = 0.0;
        for (const auto& [a, b] : edges) {
            if (edges.contains({b, a})) continue;
            const glm::vec3 from = field->vertices()[a], to = field->vertices()[b];
            // From above, anticlockwise.
            turned += static_cast<double>(std::atan2(from.z * to.x - from.x * to.z, from.x * to.x + from.z * to.z));
        }
        return static_cast<int>(std::lround(turned / (2.0 * std::numbers::pi)));
    }

private Q_SLOTS:
    void init() {
        m_context.groom = testing::groomOn(testing::plane(8), 40, 6, 0.05f);
        m_context.hasGroom = true;
    }

    void guidesFollowTheStroke() {
        QVERIFY(say("add-stroke -0.2,0,0 0.2,0,0.2\nset field/lift 0\ngrow-along").ok());
        const glm::vec3 way = glm::normalize(glm::vec3(0.4f, 0.0f, 0.2f));
        for (std::size_t i = 0; i < m_context.groom.guides.count(); ++i) {
            const auto points = m_context.groom.guides.points(i);
            QVERIFY(glm::dot(glm::normalize(points.back() - points.front()), way) > 0.99f);
        }
    }

    void twoStrokesKeptApartByAParting() {
        QVERIFY(say("add-parting 0,0,-0.5 0,0,0.5\nadd-stroke -0.1,0,0 -0.4,0,0\nadd-stroke 0.1,0,0 0.4,0,0\n"
                    "set field/lift 0\ngrow-along")
                    .ok());
        for (std::size_t i = 0; i < m_context.groom.guides.count(); ++i) {
            const auto points = m_context.groom.guides.points(i);
            const glm::vec3 way = points.back() - points.front();
            // Around the ends of the parting, at the border, directions meet.
            if (std::abs(points[0].x) < 0.01f || std::abs(points[0].z) > 0.3f) continue;
            QVERIFY(way.x * points[0].x > 0.0f);
        }
    }

    void onlyTheGroupThatIsNamed() {
        QVERIFY(say("add-group other").ok());
        m_context.groom.guides.setGroup(0, 1);
        m_context.groom.guides.setPoints(0, resampled(m_context.groom.guides.points(0), 15));
        const Groom before = m_context.groom;
        QVERIFY(say("set field/length 0.02\nset field/lift 0.5\nadd-stroke -0.2,0,0 0.2,0,0\ngrow-along hair").ok());
        const auto same = m_context.groom.guides.points(0), old = before.guides.points(0);
        QVERIFY(std::equal(same.begin(), same.end(), old.begin(), old.end()));
        for (std::size_t i = 1; i < m_context.groom.guides.count(); ++i)
            QVERIFY(std::abs(curveLength(m_context.groom.guides.points(i)) - 0.02f) < 1e-4f);
    }

    void strokesAreChangedMovedAndRemoved() {
        QVERIFY(say("add-stroke weight 2 -0.2,0,0 0.2,0,0").ok());
        QVERIFY(say("add-stroke whorl radius 0.1 0.1,0,0.1").ok());
        const Groom& groom = m_context.groom;
        QCOMPARE(groom.strokes->size(), std::size_t{2});
        QCOMPARE((*groom.strokes)[0].weight, 2.0f);
        QCOMPARE((*groom.strokes)[1].points.size(), std::size_t{1});
        QVERIFY(say("set-stroke 1 weight 0.5\nset-stroke 2 radius 0.2\nset-stroke 2 kind repel").ok());
        QCOMPARE((*groom.strokes)[0].weight, 0.5f);
        QCOMPARE((*groom.strokes)[1].radius, 0.2f);
        QCOMPARE((*groom.strokes)[1].kind, StrokeKind::Repel);
        QVERIFY(say("move-stroke 2 0.1,0.3,-0.05").ok());
        const glm::vec3 moved = positionAt(*groom.mesh, (*groom.strokes)[1].points[0]);
        QVERIFY(glm::distance(moved, glm::vec3(0.2f, 0.0f, 0.05f)) < 1e-4f);
        QVERIFY(checkGroom(groom).empty());
        QVERIFY(say("info")->find("stroke") != std::string::npos);
        QVERIFY(say("remove-stroke 1").ok());
        QCOMPARE(groom.strokes->size(), std::size_t{1});
        QVERIFY(say("clear-strokes").ok());
        QVERIFY(groom.strokes->empty());
    }

    void guidesBecomeStrokes() {
        QVERIFY(say("add-stroke -0.2,0,0 0.2,0,0.2\nset field/lift 0\ngrow-along\nclear-strokes").ok());
        QVERIFY(say("set field/follow on\nstrokes-from-guides").ok());
        const Groom& groom = m_context.groom;
        QVERIFY(!groom.field->follow);  // strokes lead from now on
        QCOMPARE(groom.strokes->size(), groom.guides.count());
        QVERIFY(checkGroom(groom).empty());
        const glm::vec3 way = glm::normalize(glm::vec3(0.4f, 0.0f, 0.2f));
        for (const FieldStroke& stroke : *groom.strokes) {
            const glm::vec3 from = positionAt(*groom.mesh, stroke.points.front()),
                            to = positionAt(*groom.mesh, stroke.points.back());
            // Guides that leave the plane go on along its border.
            if (std::max(std::abs(to.x), std::abs(to.z)) > 0.49f) continue;
            QVERIFY(glm::dot(glm::normalize(to - from), way) > 0.99f);
        }
    }

    void singularitiesAreListed() {
        QVERIFY(say("add-stroke -0.2,0,0 0.2,0,0").ok());
        QCOMPARE(*say("singularities"), std::string("0 in all, sum 0\n"));
        QVERIFY(say("clear-strokes\nadd-stroke whorl radius 0.2 0.1,0,0.1").ok());
        const std::string whorl = *say("singularities");
        float x = 9.0f, y = 9.0f, z = 9.0f;
        QCOMPARE(std::sscanf(whorl.c_str(), "+1 at %f,%f,%f", &x, &y, &z), 3);
        // In one of the triangles around it.
        QVERIFY2(glm::length(glm::vec3(x - 0.1f, y, z - 0.1f)) < 0.15f, whorl.c_str());
        QVERIFY2(whorl.ends_with("1 in all, sum 1\n"), whorl.c_str());
        // A ball that is grown all over has hair that turns around twice.
        m_context.groom = makeGroom(testing::sphere(24, 32, 0.1f));
        QVERIFY(say("add-stroke 0.1,0,0 0,0,0.1").ok());
        const std::string ball = *say("singularities");
        QVERIFY2(ball.ends_with(" in all, sum 2\n"), ball.c_str());
        QVERIFY(!say("singularities all").ok());
    }

    // Poincare and Hopf: the indices on closed surfaces sum to their Euler characteristic, whatever the strokes.
    void theListSumsToTheEulerCharacteristic() {
        std::vector<SurfaceMesh> meshes{testing::sphere(24, 32), ring(24, 16)};
        std::vector<std::filesystem::path> files;
        for (const char* name : {"bob", "bust", "creature", "swatch"})
            files.push_back(std::filesystem::path(WHORL_SAMPLES) / (std::string(name) + ".whorl"));
        for (const char* name : {"animals/crane/spot/spot.obj", "animals/crane/bob/bob_tri.obj"}) {
            if (const auto file = testing::realData(name))
                files.push_back(*file);
            else
                qInfo("%s is not there: left out", name);
        }
        for (const std::filesystem::path& file : files) {
            const auto opened = openGroom(file, m_progress);
            if (!opened) qInfo("%s: %s", file.c_str(), opened.error().message.c_str());
            if (opened && characteristicOf(*opened->groom.mesh))
                meshes.push_back(*opened->groom.mesh);
            else
                qInfo("%s is open: left out", file.c_str());
        }
        std::vector<int> sums;
        for (SurfaceMesh& mesh : meshes) {
            const std::optional<int> characteristic = characteristicOf(mesh);
            QVERIFY(characteristic);
            m_context.groom = makeGroom(std::move(mesh));
            const SurfaceMesh& own = *m_context.groom.mesh;
            for (std::uint32_t seed = 1; seed <= 3; ++seed) {
                std::string script = "clear-strokes\n";
                for (std::uint32_t i = 0; i < 4; ++i) {
                    const auto word = [&](std::uint32_t end) {
                        const auto t = static_cast<std::uint32_t>(randomFloat(seed, i, end) *
                                                                  static_cast<float>(own.triangleCount() - 1));
                        const glm::vec3 p = positionAt(own, {t, 0.3f, 0.3f});
                        return " " + std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z);
                    };
                    script += i == 3 ? "add-stroke whorl" + word(0) + "\n" : "add-stroke" + word(0) + word(1) + "\n";
                }
                QVERIFY(say(script).ok());
                const auto listed = list();
                int sum = 0;
                for (const FieldSingularity& place : listed) sum += place.index;
                QCOMPARE(sum, *characteristic);
                QCOMPARE(m_sum, sum);
            }
            qInfo("%u triangles, characteristic %d", own.triangleCount(), *characteristic);
            sums.push_back(*characteristic);
        }
        QCOMPARE(sums[0], 2);
        QCOMPARE(sums[1], 0);
    }

    // On flat skin the indices sum to how often directions turn along the border of where hair grows.
    void theListFitsTheBorder() {
        bool turns = false;
        for (const bool hole : {false, true}) {
            for (const char* strokes :
                 {"add-stroke whorl radius 0.3 0,0,0", "add-stroke attract radius 0.1 0.3,0,0.3",
                  "add-stroke attract radius 0.1 0.3,0,0.3\nadd-stroke whorl radius 0.1 -0.3,0,0.3",
                  "add-stroke -0.4,0,-0.4 0.4,0,-0.4\nadd-stroke 0.4,0,-0.35 0.4,0,0.4\n"
                  "add-stroke 0.35,0,0.4 -0.4,0,0.4\nadd-stroke -0.4,0,0.35 -0.4,0,-0.3",
                  "add-stroke -0.1,0,0 -0.4,0,0\nadd-stroke 0.1,0,0 0.4,0,0\n"
                  "add-stroke 0,0,-0.4 0,0,-0.1\nadd-stroke 0,0,0.4 0,0,0.1"}) {
                m_context.groom = makeGroom(framed(24));
                if (hole) QVERIFY(say("grow middle off").ok());
                QVERIFY(say(strokes).ok());
                const auto listed = list();
                const std::vector<std::uint8_t> grows = growingTriangles(m_context.groom);
                int sum = 0;
                for (const FieldSingularity& place : listed) {
                    QVERIFY(grows[place.triangle]);
                    sum += place.index;
                }
                QCOMPARE(m_sum, sum);
                QCOMPARE(sum, turnsAlongTheBorder(grows));
                turns |= sum != 0;
            }
            // Nothing turns where nothing grows.
            QVERIFY(say("clear-strokes\nadd-stroke whorl radius 0.3 0,0,0").ok());
            QCOMPARE(list().size(), hole ? std::size_t{0} : std::size_t{1});
        }
        QVERIFY(turns);
    }

    void wrongWordsAreExplained() {
        QVERIFY(say("add-stroke -0.2,0,0 0.2,0,0").ok());
        for (const char* line :
             {"add-stroke", "add-stroke 1,2", "add-stroke 0,0,0", "add-stroke sideways 0,0,0 1,0,0",
              "add-stroke weight 0 0,0,0 1,0,0", "add-stroke repel radius -1 0,0,0", "add-stroke weight 2",
              "set-stroke 1 weight 1000", "set-stroke 7 weight 1", "set-stroke 1 size 2", "set-stroke 1 kind curly",
              "set-stroke one weight 1", "move-stroke 1 left", "move-stroke 9 0,0,0", "remove-stroke 9",
              "remove-stroke", "clear-strokes all", "grow-along nobody", "strokes-from-guides nobody"}) {
            const std::uint64_t digest = testing::groomDigest(m_context.groom);
            const auto said = say(line);
            QVERIFY2(!said.ok(), line);
            QVERIFY(said.error().message.starts_with("test:1: "));
            QCOMPARE(testing::groomDigest(m_context.groom), digest);
        }
    }
};

QTEST_GUILESS_MAIN(FieldCommandsTest)
#include "field_commands_test.moc"
