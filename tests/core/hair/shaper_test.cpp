// SPDX-License-Identifier: Apache-2.0
#include "core/hair/shaper.h"

#include "core/base/plain_vector.h"
#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/hair/curves.kernel.h"
#include "core/hair/strand_members.kernel.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <vector>

using namespace whorl;

namespace {

constexpr std::size_t lanes = Shaper::lanes;

float dice(std::uint64_t i, std::uint32_t channel) {
    return 2.0f * randomFloat(11, i, channel) - 1.0f;
}

glm::vec3 direction(std::uint64_t i, std::uint32_t channel) {
    return glm::normalize(glm::vec3(dice(i, channel), dice(i, channel + 1), dice(i, channel + 2)));
}

template <class Work>
void atEachLevel(Work&& work) {
    for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
        setSimdLevel(level);
        work();
    }
    setSimdLevel(bestSimdLevel());
}

}  // namespace

class ShaperTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void guidesAreTurnedAndWeighted() {
        // Forty guides with any normals; hairs with any normals, one opposite to its guide and one nearly so.
        constexpr std::size_t stride = 32, perHair = 3, guideCount = 40;
        GuideShapes guides;
        for (std::size_t g = 0; g < guideCount; ++g) {
            guides.first.push_back(static_cast<std::uint32_t>(guides.x.size()));
            const glm::vec3 normal = direction(g, 0);
            guides.normals.insert(guides.normals.end(), {normal.x, normal.y, normal.z});
            for (std::size_t v = 0; v < stride; ++v) {
                guides.x.push_back(0.1f * dice(g * 64 + v, 3));
                guides.y.push_back(0.1f * dice(g * 64 + v, 4));
                guides.z.push_back(0.1f * dice(g * 64 + v, 5));
            }
        }
        Bindings bindings;
        bindings.perHair = perHair;
        std::vector<HairRoot> roots(100);
        std::vector<HairTraits> traits(roots.size());
        for (std::size_t i = 0; i < roots.size(); ++i) {
            bindings.counts.push_back(static_cast<std::uint8_t>(1 + i % perHair));
            for (std::size_t j = 0; j < perHair; ++j) {
                bindings.guides.push_back(static_cast<std::uint32_t>((i * 7 + j * 13) % guideCount));
                bindings.weights.push_back(randomFloat(12, i, static_cast<std::uint32_t>(j)));
            }
            roots[i].position = 0.1f * direction(i, 6);
            roots[i].normal = direction(i, 9);
            traits[i] = HairTraits{};
            traits[i].scale = 0.5f + randomFloat(13, i, 0);
            traits[i].displacement = 0.01f * dice(i, 12);
        }
        const auto normalOf = [&](std::size_t g) {
            return glm::vec3(guides.normals[3 * g], guides.normals[3 * g + 1], guides.normals[3 * g + 2]);
        };
        roots[20].normal = -normalOf(bindings.guides[20 * perHair]);
        roots[21].normal = glm::normalize(-normalOf(bindings.guides[21 * perHair]) + 0.05f * direction(0, 15));
        const std::vector<float> along(stride, 0.5f), ease(stride, 1.0f);
        for (const bool turned : {true, false}) {
            atEachLevel([&] {
                Shaper shaper;
                std::vector<float> x(lanes * stride), y(lanes * stride), z(lanes * stride);
                for (std::uint32_t first = 0; first < roots.size(); first += lanes) {
                    // The last time there are fewer than lanes.
                    const std::size_t count = std::min<std::size_t>(lanes, roots.size() - first);
                    std::uint32_t which[lanes] = {};
                    for (std::size_t l = 0; l < count; ++l) {
                        which[l] = first + static_cast<std::uint32_t>(l);
                        shaper.set(l, roots[which[l]], traits[which[l]]);
                    }
                    const ShapeSpace space{turned, stride, along.data(), ease.data(), glm::vec3(0.0f)};
                    shaper.shape(space, guides, bindings, which, count, x.data(), y.data(), z.data());
                    for (std::size_t l = 0; l < count; ++l) {
                        const HairRoot& root = roots[which[l]];
                        for (std::size_t v = 0; v < stride; ++v) {
                            glm::vec3 sum(0.0f);
                            for (std::size_t j = 0; j < bindings.counts[which[l]]; ++j) {
                                const std::size_t place = which[l] * perHair + j;
                                const std::size_t at = guides.first[bindings.guides[place]] + v;
                                const glm::mat3 turn =
                                    turned ? minimalRotation(normalOf(bindings.guides[place]), root.normal)
                                           : glm::mat3(1.0f);
                                sum += bindings.weights[place] *
                                       (turn * glm::vec3(guides.x[at], guides.y[at], guides.z[at]));
                            }
                            const glm::vec3 expected = root.position + root.normal * traits[which[l]].displacement +
                                                       traits[which[l]].scale * sum;
                            const std::size_t at = l * stride + v;
                            QVERIFY(glm::distance(glm::vec3(x[at], y[at], z[at]), expected) < 1e-6f);
                        }
                    }
                }
            });
        }
    }

    void vectorsLeaveTheLanesWhole() {
        // Any number of vertices, anywhere in memory, past the caches or not; nothing beyond a hair is touched.
        constexpr std::size_t rows = 24;
        std::vector<float> lane[3];
        for (int axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < rows * lanes; ++i) lane[axis].push_back(static_cast<float>(i * 3) + dice(i, 1));
        std::uint32_t vertices[lanes];
        for (std::uint32_t l = 0; l < lanes; ++l) vertices[l] = 2 + l % 19;
        atEachLevel([&] {
            for (const bool past : {false, true}) {
                for (std::size_t count = 1; count <= lanes; ++count) {
                    std::vector<std::vector<float>> memory(count);
                    float* out[lanes] = {};
                    for (std::size_t l = 0; l < count; ++l) {
                        memory[l].assign(3 * rows + 8, -1.0f);
                        out[l] = memory[l].data() + l % 5;
                    }
                    const auto store = WHORL_PICK(storeVectors);
                    store({count, {lane[0].data(), lane[1].data(), lane[2].data()}, vertices, out, past});
                    for (std::size_t l = 0; l < count; ++l) {
                        const std::size_t first = l % 5;
                        for (std::size_t i = 0; i < memory[l].size(); ++i) {
                            const bool inside = i >= first && i < first + 3 * vertices[l];
                            const std::size_t v = (i - first) / 3, axis = (i - first) % 3;
                            QCOMPARE(memory[l][i], inside ? lane[axis][v * lanes + l] : -1.0f);
                        }
                    }
                }
            }
        });
    }

    void membersLeaveTheirLaneWhole() {
        // Any number of vertices and members, past the caches or not; nothing beyond the strand is touched. Some
        // vertices coincide, and some normals run along the hair.
        constexpr std::size_t stride = 32;
        std::vector<float> lane[15];
        for (std::uint32_t row = 0; row < 15; ++row) {
            const std::uint32_t of = row / 3;
            for (std::size_t i = 0; i < (stride + 4) * lanes; ++i) {
                const float along = static_cast<float>(i / lanes) * 0.01f;
                lane[row].push_back(of == 0   ? (row == 1 ? along : 0.0f) + 0.003f * dice(i, row)
                                    : of == 4 ? direction(i, 40)[static_cast<int>(row % 3)]
                                              : 0.001f * dice(i, row));
            }
        }
        for (std::uint32_t row = 0; row < 12; ++row) {
            for (std::size_t v = 4; v < 7; ++v) lane[row][v * lanes + 2] = row == 1 ? 1e-9f * static_cast<float>(v) : 0;
            for (std::size_t v = 0; v < stride + 4; ++v)
                lane[row][v * lanes + 3] = row == 1 ? 0.01f * static_cast<float>(v) : 0.0f;
        }
        for (std::size_t v = 0; v < stride; ++v)
            for (std::uint32_t axis = 0; axis < 3; ++axis) lane[12 + axis][v * lanes + 3] = axis == 1 ? 1.0f : 0.0f;
        const float across[] = {0.5f, -0.25f, 1.0f}, up[] = {0.0f, 0.75f, -1.0f}, lift[] = {0.25f, 0.5f, 1.0f};
        std::vector<float> widths, colours;
        for (std::size_t v = 0; v < stride; ++v) widths.push_back(dice(v, 50));
        for (std::size_t i = 0; i < 4 * stride; ++i) colours.push_back(dice(i, 51));
        std::vector<LineVector> first;
        atEachLevel([&] {
            std::vector<LineVector> all;
            for (std::size_t l = 0; l < lanes; ++l) {
                std::vector<float> rows(RowArrays::hairs * StrandRows::size(stride));
                RowArrays from{stride, l / 4 * 4, {}, rows.data()};
                for (std::size_t row = 0; row < 15; ++row) from.in[row] = lane[row].data();
                WHORL_PICK(strandRows)(from);
                for (std::size_t vertices = 2; vertices <= stride; ++vertices) {
                    const std::size_t members = 1 + vertices % 3, count = members * vertices;
                    LineVector points(3 * count + 2, -1.0f), normals = points, wide(count + 2, -1.0f),
                                                             tints(4 * count + 2, -1.0f);
                    WHORL_PICK(strandMembers)
                    ({vertices, &rows[l % 4 * StrandRows::size(stride)], members, across, up, lift, widths.data(),
                      colours.data(), points.data(), normals.data(), wide.data(), tints.data(), l % 2 == 0});
                    QVERIFY(points[3 * count] == -1.0f && normals[3 * count] == -1.0f && wide[count] == -1.0f &&
                            tints[4 * count] == -1.0f);
                    const auto memberAt = [&](std::size_t member, std::size_t v) {
                        glm::vec3 p(0.0f);
                        for (std::uint32_t axis = 0; axis < 3; ++axis) {
                            const auto at = [&](std::uint32_t of) { return lane[3 * of + axis][v * lanes + l]; };
                            p[static_cast<int>(axis)] =
                                at(0) + across[member] * at(1) + up[member] * at(2) + lift[member] * at(3);
                        }
                        return p;
                    };
                    for (std::size_t i = 0; i < count; ++i) {
                        const std::size_t member = i / vertices, v = i % vertices;
                        QVERIFY(wide[i] == widths[v] && tints[4 * i] == colours[4 * v] &&
                                tints[4 * i + 3] == colours[4 * v + 3]);
                        QCOMPARE(glm::vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]), memberAt(member, v));
                        const glm::vec3 normal(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
                        const glm::vec3 way = memberAt(member, v + 1) - memberAt(member, v > 0 ? v - 1 : 0);
                        QVERIFY(std::abs(glm::length(normal) - 1.0f) < 2e-6f);
                        if (glm::length(way) > 1e-6f) QVERIFY(std::abs(glm::dot(normal, glm::normalize(way))) < 1e-3f);
                    }
                    for (LineVector* values : {&points, &normals, &wide, &tints}) all.push_back(std::move(*values));
                }
            }
            if (first.empty()) first = all;
            QVERIFY(all == first);
        });
    }

    void looksGoFromRootToTip() {
        std::vector<float> along;
        for (int v = 0; v < 32; ++v) along.push_back(std::min(1.0f, static_cast<float>(v) / 20.0f));
        HairTraits traits{};
        traits.rootWidth = 3.0f;
        traits.tipWidth = 1.0f;
        for (int i = 0; i < 4; ++i) {
            traits.rootColour[i] = static_cast<float>(i);
            traits.tipColour[i] = static_cast<float>(i) * 2.0f + 1.0f;
        }
        atEachLevel([&] {
            for (std::uint32_t vertices = 2; vertices <= 21; ++vertices) {
                const std::uint32_t members = 1 + vertices % 3, all = members * vertices;
                const float last = (static_cast<float>(vertices) - 1.25f) / 20.0f;
                std::vector<float> widths(all + 2, -1.0f), colours(4 * all + 2, -1.0f);
                float* const wide = widths.data();
                float* const tint = colours.data();
                const HairTraits* const which = &traits;
                const auto look = WHORL_PICK(lookHairs);
                look({1, members, &which, &vertices, &last, along.data(), &wide, &tint, vertices % 2 == 0});
                // Members of a strand are alike and follow each other.
                for (std::uint32_t place = 0; place < all; ++place) {
                    const std::uint32_t v = place % vertices;
                    const float at = v + 1 < vertices ? along[v] : last;
                    QVERIFY(std::abs(widths[place] - (3.0f - 2.0f * at)) < 1e-6f);
                    for (std::uint32_t i = 0; i < 4; ++i) {
                        const float root = static_cast<float>(i);
                        QVERIFY(std::abs(colours[4 * place + i] - (root + (root + 1.0f) * at)) < 1e-6f);
                    }
                }
                QVERIFY(widths[all] == -1.0f && colours[4 * all] == -1.0f);
            }
        });
    }
};

QTEST_APPLESS_MAIN(ShaperTest)
#include "shaper_test.moc"
