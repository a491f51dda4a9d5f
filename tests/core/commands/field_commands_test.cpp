// SPDX-License-Identifier: Apache-2.0
// comb-along: guides combed by lines in a script.
#include "core/commands/command.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>

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

    void guidesFollowTheLine() {
        QVERIFY(say("comb-along lift 0 -0.2,0,0 0.2,0,0.2").ok());
        const glm::vec3 way = glm::normalize(glm::vec3(0.4f, 0.0f, 0.2f));
        for (std::size_t i = 0; i < m_context.groom.guides.count(); ++i) {
            const auto points = m_context.groom.guides.points(i);
            QVERIFY(glm::dot(glm::normalize(points.back() - points.front()), way) > 0.99f);
        }
    }

    void twoLinesKeptApartByAParting() {
        QVERIFY(say("add-parting 0,0,-0.5 0,0,0.5").ok());
        QVERIFY(say("comb-along lift 0 -0.1,0,0 -0.4,0,0 / 0.1,0,0 0.4,0,0").ok());
        for (std::size_t i = 0; i < m_context.groom.guides.count(); ++i) {
            const auto points = m_context.groom.guides.points(i);
            const glm::vec3 way = points.back() - points.front();
            // Around the ends of the parting, at the border, directions meet.
            if (std::abs(points[0].x) < 0.01f || std::abs(points[0].z) > 0.3f) continue;
            QVERIFY(way.x * points[0].x > 0.0f);
        }
    }

    void onlyTheGroupAndTheLengthThatAreNamed() {
        QVERIFY(say("add-group other").ok());
        m_context.groom.guides.setGroup(0, 1);
        m_context.groom.guides.setPoints(0, resampled(m_context.groom.guides.points(0), 15));
        const Groom before = m_context.groom;
        QVERIFY(say("comb-along group hair length 0.02 lift 0.5 -0.2,0,0 0.2,0,0").ok());
        const auto same = m_context.groom.guides.points(0), old = before.guides.points(0);
        QVERIFY(std::equal(same.begin(), same.end(), old.begin(), old.end()));
        for (std::size_t i = 1; i < m_context.groom.guides.count(); ++i) {
            const auto points = m_context.groom.guides.points(i);
            float length = 0.0f;
            for (std::size_t k = 1; k < points.size(); ++k) length += glm::distance(points[k - 1], points[k]);
            QVERIFY(std::abs(length - 0.02f) < 1e-4f);
        }
    }

    void wrongWordsAreExplained() {
        for (const char* line :
             {"comb-along lift 2 0,0,0 1,0,0", "comb-along length x 0,0,0 1,0,0", "comb-along group nobody 0,0,0 1,0,0",
              "comb-along 1,2", "comb-along sideways 3", "comb-along 0,0,0", "comb-along 0,0,0 /"}) {
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
