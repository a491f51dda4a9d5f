// SPDX-License-Identifier: Apache-2.0
// Strokes in a script, and guides grown along them.
#include "core/brushes/constraints.h"
#include "core/commands/command.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace whorl;

class FieldCommandsTest : public QObject {
    Q_OBJECT

    CommandContext m_context;

    Result<std::string> say(const std::string& line) {
        Progress progress;
        const std::vector<Command> commands = coreCommands();
        return runScript(commands, m_context, line, "test", progress);
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
