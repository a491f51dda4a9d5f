// SPDX-License-Identifier: Apache-2.0
#include "render/passes/hair_order.h"

#include "core/base/parallel.h"
#include "core/base/random.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <numeric>

namespace whorl {
namespace {

Strands randomStrands(int hairs) {
    Strands strands;
    for (int i = 0; i < hairs; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        const int vertices = 1 + static_cast<int>(randomFloat(5, index, 0) * 20.0f);
        for (int j = 0; j < vertices; ++j) {
            const auto channel = static_cast<std::uint32_t>(10 + 3 * j);
            strands.positions.push_back(glm::vec3(randomFloat(5, index, channel), randomFloat(5, index, channel + 1),
                                                  randomFloat(5, index, channel + 2)));
            strands.normals.push_back(glm::vec3(0, 1, 0));
            strands.widths.push_back(0.0001f);
            strands.colours.push_back(glm::vec4(1.0f));
        }
        strands.firstVertex.push_back(static_cast<std::uint32_t>(strands.positions.size()));
        strands.ids.push_back(static_cast<std::uint32_t>(i));
        strands.roots.push_back({});
        strands.rootUvs.push_back(glm::vec2(0));
        strands.groups.push_back(0);
    }
    return strands;
}

}  // namespace

class HairOrderTest : public QObject {
    Q_OBJECT

    const glm::vec3 m_eye{0.2f, 0.3f, 4.0f};
    const glm::vec3 m_forward = glm::normalize(glm::vec3(0.1f, -0.05f, -1.0f));

private Q_SLOTS:
    void everySegmentOnce() {
        const Strands strands = randomStrands(700);
        for (const HairDetail detail : {HairDetail{1, 16}, HairDetail{3, 5}, HairDetail{1, 2}, HairDetail{7, 9}}) {
            HairOrder order;
            QVERIFY(order.update(strands, detail, m_eye, m_forward));
            std::vector<std::uint32_t> sorted = order.order();
            const std::size_t each = detail.pointsPerHair - 1;
            QCOMPARE(sorted.size(), std::size_t{detail.hairs(strands)} * each);
            std::sort(sorted.begin(), sorted.end());
            for (std::size_t i = 0; i < sorted.size(); ++i) QCOMPARE(std::size_t{sorted[i]}, i);
        }
    }

    void farBeforeNear() {
        Strands strands = randomStrands(0);
        // Two vertices each, at known depths.
        for (int i = 0; i < 500; ++i) {
            const float depth = randomFloat(9, static_cast<std::uint64_t>(i), 0);
            for (int j = 0; j < 2; ++j) strands.positions.push_back(glm::vec3(0.1f * static_cast<float>(j), 0, -depth));
            strands.firstVertex.push_back(static_cast<std::uint32_t>(strands.positions.size()));
            strands.ids.push_back(static_cast<std::uint32_t>(i));
        }
        HairOrder order;
        order.update(strands, HairDetail{1, 2}, glm::vec3(0, 0, 1), glm::vec3(0, 0, -1));
        float nearest = 2.0f;
        for (const std::uint32_t segment : order.order()) {
            const float depth = -strands.positions[std::size_t{segment} * 2].z;
            QVERIFY(depth <= nearest + 1.0f / 2000.0f);
            nearest = std::min(nearest, depth);
        }
        QVERIFY(nearest < 0.02f);
    }

    void sameForAnyThreads() {
        const Strands strands = randomStrands(3000);
        HairOrder many;
        many.update(strands, HairDetail{1, 16}, m_eye, m_forward);
        const ThreadLimit one(1);
        HairOrder single;
        single.update(strands, HairDetail{1, 16}, m_eye, m_forward);
        QVERIFY(many.order() == single.order());
    }

    void keptWhileNothingChanges() {
        const Strands strands = randomStrands(50);
        HairOrder order;
        QVERIFY(order.update(strands, HairDetail{1, 4}, m_eye, m_forward));
        QVERIFY(!order.update(strands, HairDetail{1, 4}, m_eye, m_forward));
        QVERIFY(order.update(strands, HairDetail{1, 4}, m_eye + 0.1f, m_forward));
        QVERIFY(order.update(strands, HairDetail{2, 4}, m_eye + 0.1f, m_forward));
    }

    void noHair() {
        const Strands none;
        HairOrder order;
        order.update(none, HairDetail{}, m_eye, m_forward);
        QVERIFY(order.order().empty());
    }
};

}  // namespace whorl

QTEST_APPLESS_MAIN(whorl::HairOrderTest)
#include "hair_order_test.moc"
