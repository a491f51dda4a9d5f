// SPDX-License-Identifier: Apache-2.0
// A constant field on a plane has a texture that is known: how alike it is to itself, near and far, along and across.
#include "core/base/parallel.h"
#include "core/lic/reference.h"
#include "tests/support/lic_scene.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

using namespace whorl;
using namespace whorl::testing;

namespace {

using glm::dvec2;
constexpr double pi = std::numbers::pi;

/// Light at places of a grid, row by row; lags count in its steps.
struct Grid {
    int columns = 0, rows = 0;
    dvec2 right{0.0}, down{0.0};  ///< from one to the next, metres
    std::vector<double> light;

    dvec2 metres(glm::ivec2 lag) const {
        return right * static_cast<double>(lag.x) + down * static_cast<double>(lag.y);
    }
    double alike(glm::ivec2 lag) const {
        std::vector<double> a, b;
        for (int y = std::max(0, -lag.y); y < std::min(rows, rows - lag.y); ++y) {
            for (int x = std::max(0, -lag.x); x < std::min(columns, columns - lag.x); ++x) {
                a.push_back(light[static_cast<std::size_t>(y * columns + x)]);
                b.push_back(light[static_cast<std::size_t>((y + lag.y) * columns + x + lag.x)]);
            }
        }
        return correlation(a, b);
    }
};

/// The law: light is the mean of noise by the kernel's weights at `places` along the field, and noise is all or nothing
/// by cells of a grid that lies anywhere. `samples` by `samples` places of a texel count for one where noise is kept by
/// texels.
class Law {
public:
    Law(const std::vector<dvec2>& places, const std::vector<double>& weights, double grain, double texel, int samples)
        : m_grain(grain), m_texel(texel), m_samples(samples) {
        // The kernel convolved with itself: places that are as far apart count together.
        std::map<std::pair<long long, long long>, double> sums;
        const auto key = [&](double x) { return std::llround(x / grain * 4096.0); };
        for (std::size_t i = 0; i < places.size(); ++i) {
            for (std::size_t j = 0; j < places.size(); ++j) {
                const dvec2 apart = places[i] - places[j];
                sums[{key(apart.x), key(apart.y)}] += weights[i] * weights[j];
                m_reach = std::max(m_reach, glm::length(apart));
            }
        }
        for (const auto& [at, weight] : sums)
            m_pairs.push_back({dvec2(at.first, at.second) * (grain / 4096.0), weight});
        m_variance = covariance(dvec2(0.0));
    }

    /// Correlation of two places that are `lag` metres apart.
    double at(dvec2 lag) const { return covariance(lag) / m_variance; }

    /// Standard deviation of the correlation found over a grid: Bartlett's, from what it is at all other lags, and no
    /// less than that of pairs without anything in common, of which there are as many as the texture has of its own.
    double deviation(const Grid& grid, glm::ivec2 lag) const {
        const double most = m_reach + 1.5 * m_grain + 1.5 * m_texel;
        glm::ivec2 range(0);
        for (int axis = 0; axis < 2; ++axis)
            range[axis] = static_cast<int>(most / glm::length(axis == 0 ? grid.right : grid.down)) + 1;
        const int width = 2 * range.x + 1, height = 2 * range.y + 1;
        if (m_table.size() != static_cast<std::size_t>(width * height)) {
            m_table.clear();
            for (int y = -range.y; y <= range.y; ++y)
                for (int x = -range.x; x <= range.x; ++x) m_table.push_back(at(grid.metres({x, y})));
        }
        const auto known = [&](int x, int y) {
            return std::abs(x) > range.x || std::abs(y) > range.y
                       ? 0.0
                       : m_table[static_cast<std::size_t>((y + range.y) * width + x + range.x)];
        };
        const double here = at(grid.metres(lag));
        double sum = 0.0, squares = 0.0;
        for (int y = -range.y - std::abs(lag.y); y <= range.y + std::abs(lag.y); ++y) {
            for (int x = -range.x - std::abs(lag.x); x <= range.x + std::abs(lag.x); ++x) {
                const double r = known(x, y), before = known(x - lag.x, y - lag.y);
                sum +=
                    r * r * (1.0 + 2.0 * here * here) + before * known(x + lag.x, y + lag.y) - 4.0 * here * r * before;
            }
        }
        const double pairs = (grid.columns - std::abs(lag.x)) * (grid.rows - std::abs(lag.y));
        return std::sqrt(std::max(sum, squares * (1.0 - here * here) * (1.0 - here * here)) / pairs);
    }

private:
    double covariance(dvec2 lag) const {
        double sum = 0.0;
        for (const auto& [apart, weight] : m_pairs) sum += weight * noise(lag + apart);
        return sum;
    }
    double noise(dvec2 apart) const {
        const double most = m_grain + m_texel;
        if (std::abs(apart.x) > most || std::abs(apart.y) > most) return 0.0;
        const auto same = [&](double x) { return std::max(1.0 - std::abs(x) / m_grain, 0.0); };
        const int n = m_samples;
        dvec2 sum(0.0);
        for (int k = 1 - n; k < n; ++k) {
            const double share = static_cast<double>(n - std::abs(k)) / (n * n), off = m_texel * k / n;
            sum += share * dvec2(same(apart.x + off), same(apart.y + off));
        }
        return sum.x * sum.y;
    }

    double m_grain, m_texel;
    int m_samples;
    double m_reach = 0.0, m_variance = 1.0;
    std::vector<std::pair<dvec2, double>> m_pairs;
    mutable std::vector<double> m_table;  // of the one grid that is asked about
};

double weightAt(bool box, double along) {
    return box ? 1.0 : 0.5 + 0.5 * std::cos(pi * along);
}

/// A kernel of `length` each way over noise without grain, convolved with itself.
double closedForm(bool box, double lag, double length) {
    const double x = lag / length;
    if (x >= 2.0) return 0.0;
    const double shared = 1.0 - 0.5 * x;
    return box ? shared : shared * (2.0 + std::cos(pi * x)) / 3.0 + std::sin(pi * x) / (2.0 * pi);
}

}  // namespace

class LicAnalyticTest : public QObject {
    Q_OBJECT

    static void addRows() {
        QTest::addColumn<bool>("box");
        QTest::addColumn<double>("length");  // grains
        QTest::addColumn<double>("grain");   // of the reference: 1/1000 of the plane; of the painter: texels
        QTest::addColumn<bool>("aslant");    // to the grid of the noise, and to the texels
        for (const bool box : {false, true})
            for (const double length : {5.3, 12.0})
                for (const double grain : {2.7, 4.6})
                    for (const bool aslant : {false, true})
                        QTest::addRow("%s, length %g, grain %g%s", box ? "box" : "soft", length, grain,
                                      aslant ? ", aslant" : "")
                            << box << length << grain << aslant;
    }

    /// The correlation at lags along, which go on beyond the kernel, and at lags across is as the law says. `along` and
    /// `across`: the shortest of the grid; `end`: metres from which on places have no noise in common along the field,
    /// `edge`: across it.
    static void check(const Grid& grid, const Law& law, glm::ivec2 along, glm::ivec2 across, double end, double edge) {
        const auto one = [&](glm::ivec2 lag, bool none) {
            const double expected = law.at(grid.metres(lag)), found = grid.alike(lag);
            // Far out in the tail of a normal distribution, and what rounding to 8 bits adds.
            const double bound = 4.5 * law.deviation(grid, lag) + 0.005;
            QVERIFY2(bound < 0.16, qPrintable(QString("too few places: %1").arg(bound)));
            if (none) QCOMPARE(expected, 0.0);
            QVERIFY2(std::abs(found - expected) < bound, qPrintable(QString("%1, %2: %3 for %4, at most %5 off")
                                                                        .arg(lag.x)
                                                                        .arg(lag.y)
                                                                        .arg(found)
                                                                        .arg(expected)
                                                                        .arg(bound)));
        };
        const double shortest = glm::length(grid.metres(along)), side = glm::length(grid.metres(across));
        int last = 0, beyond = 0;
        for (const double share : {0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.75, 0.9, 1.001, 1.2, 1.5}) {
            const int steps = static_cast<int>(std::ceil(share * end / shortest));
            if (steps == std::exchange(last, steps)) continue;
            const bool none = steps * shortest >= end;
            beyond += none;
            one(along * steps, none);
            if (QTest::currentTestFailed()) return;
        }
        QVERIFY(beyond >= 2);
        last = 0;
        int white = 0;
        for (const double share : {0.3, 0.6, 1.001, 1.4, 2.0, 3.0, 5.0}) {
            const int steps = static_cast<int>(std::ceil(share * edge / side));
            if (steps == std::exchange(last, steps)) continue;
            const bool none = steps * side >= edge;
            white += none;
            one(across * steps, none);
            if (QTest::currentTestFailed()) return;
        }
        QVERIFY(white >= 4);
    }

private Q_SLOTS:
    void reference_data() { addRows(); }
    void reference() {
        QFETCH(bool, box);
        QFETCH(double, length);
        QFETCH(double, grain);
        QFETCH(bool, aslant);
        const dvec2 way = aslant ? dvec2(0.8, 0.6) : dvec2(1.0, 0.0), left(-way.y, way.x);
        const glm::vec3 ahead(glm::vec2(way).x, 0.0f, glm::vec2(way).y);
        const LicScene scene(testing::plane(10), {{-0.2f * ahead, 0.2f * ahead}});
        const LicReference lic(scene.surface, scene.field);
        const double cell = grain * 1e-3, reach = length * cell, step = 0.5 * cell;
        LicOptions options;
        options.grain = static_cast<float>(cell);
        options.length = static_cast<float>(reach);
        options.kernel = box ? LicKernel::Box : LicKernel::Hann;
        std::vector<dvec2> places;
        std::vector<double> weights;
        const int steps = static_cast<int>(reach / step * 1.0001);
        for (int k = -steps; k <= steps; ++k) {
            places.push_back(way * (k * step));
            weights.push_back(weightAt(box, std::abs(k) * step / reach));
        }
        const Law law(places, weights, cell, 0.0, 1);
        // Without the grain it is the kernel convolved with itself, whatever is put in for it.
        if (length > 10.0)
            for (double lag = 3.0 * cell; lag < 2.5 * reach; lag += cell)
                QVERIFY(std::abs(law.at(way * lag) - closedForm(box, lag, reach)) < 0.05);
        Grid grid{40, 280, way * (1.3178 * cell * length / 5.3), left * (0.5531 * cell), {}};
        grid.light.resize(static_cast<std::size_t>(grid.columns * grid.rows));
        parallelFor(grid.light.size(), 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const auto x = static_cast<int>(i) % grid.columns - grid.columns / 2;
                const auto y = static_cast<int>(i) / grid.columns - grid.rows / 2;
                const glm::vec2 at(grid.metres({x, y}));
                grid.light[i] = static_cast<double>(*lic.at(scene.placeAt({at.x, 0.0f, at.y}), options));
            }
        });
        const double diagonal = aslant ? 1.4 * cell : cell;
        check(grid, law, {1, 0}, {0, 1}, 2.0 * steps * step + diagonal, diagonal);
    }

    void painter_data() { addRows(); }
    void painter() {
        QFETCH(bool, box);
        QFETCH(double, length);
        QFETCH(double, grain);
        QFETCH(bool, aslant);
        constexpr int size = 768;
        constexpr double texel = 0.2 / size;
        // Rows of texels go against z.
        const glm::vec3 ahead = aslant ? glm::vec3(0.8f, 0.0f, -0.6f) : glm::vec3(1.0f, 0.0f, 0.0f);
        LicScene scene(testing::plane(6, 0.2f), {{-0.05f * ahead, 0.05f * ahead}});
        const LicPainter painter = painterFor(scene, size);
        QVERIFY(std::abs(static_cast<double>(painter.atlas().usualTexel()) - texel) < 1e-7);
        const int steps = static_cast<int>(std::lround(length * grain));  // of a texel
        scene.lic().length.value = static_cast<float>(steps * texel);
        scene.lic().grain.value = static_cast<float>(grain * texel);
        scene.lic().kernel.index = box ? 1 : 0;
        const LicTexture texture = painted(painter, scene);
        // A step of one texel's length leads from the middle of a texel to the next place; noise is that of its texel.
        std::vector<dvec2> places;
        std::vector<double> weights;
        const dvec2 way(aslant ? 0.8 : 1.0, aslant ? 0.6 : 0.0);
        for (int k = -steps; k <= steps; ++k) {
            places.push_back(glm::floor(way * static_cast<double>(k) + 0.5) * texel);
            weights.push_back(weightAt(box, std::abs(k) / static_cast<double>(steps)));
        }
        const Law law(places, weights, grain * texel, texel, 2);
        const int from = steps + 4, count = size - 2 * from;
        Grid grid{count, count, {texel, 0.0}, {0.0, texel}, {}};
        for (int y = from; y < size - from; ++y)
            for (int x = from; x < size - from; ++x)
                grid.light.push_back((*texture.light)[static_cast<std::size_t>(y * size + x)]);
        const double diagonal = ((aslant ? 1.4 : 1.0) * grain + (aslant ? 3.0 : 1.0)) * texel;
        const glm::ivec2 along = aslant ? glm::ivec2(4, 3) : glm::ivec2(1, 0);
        check(grid, law, along, {-along.y, along.x}, 2.0 * steps * texel + diagonal, diagonal);
    }
};

QTEST_GUILESS_MAIN(LicAnalyticTest)
#include "lic_analytic_test.moc"
