// SPDX-License-Identifier: Apache-2.0
#include "tests/support/distribution.h"

#include "core/base/random.h"
#include "core/sampling/density.h"
#include "core/sampling/texel_depth.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace whorl::testing {

Map painted(Paint paint, int size) {
    Map map(size, size, 1, TexelFormat::U8, 1.0f);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float s = static_cast<float>(x) / static_cast<float>(size);
            const float t = static_cast<float>(y) / static_cast<float>(size);
            float value = 1.0f;
            if (paint == Paint::Noise)
                value = randomFloat(77, static_cast<std::uint64_t>(y) * 65536 + static_cast<std::uint64_t>(x), 0);
            if (paint == Paint::Ramp) value = s;
            if (paint == Paint::Checks) value = (x * 8 / size + y * 8 / size) % 2 == 0 ? 1.0f : 0.0f;
            if (paint == Paint::Blot) value = std::hypot(s - 0.5f, t - 0.4f) < 0.2f ? 1.0f : 0.0f;
            map.setTexel(x, y, 0, value);
        }
    }
    return map;
}

double chiSquareExcess(const std::vector<double>& expected, const std::vector<double>& found) {
    double sum = 0.0;
    double pooledExpected = 0.0;
    double pooledFound = 0.0;
    int bins = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        pooledExpected += expected[i];
        pooledFound += found[i];
        if (pooledExpected < 20.0) continue;
        sum += (pooledFound - pooledExpected) * (pooledFound - pooledExpected) / pooledExpected;
        ++bins;
        pooledExpected = pooledFound = 0.0;
    }
    if (bins < 2) return 0.0;
    const double k = bins - 1;
    return (std::cbrt(sum / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
}

namespace {

// Piece of a triangle that (u, v) lies in, after `depth` subdivisions through the middles of the sides.
std::size_t pieceAt(double u, double v, int depth) {
    std::size_t piece = 0;
    for (; depth > 0; --depth) {
        u *= 2.0;
        v *= 2.0;
        std::size_t j = 3;
        if (u >= 1.0) {
            j = 1;
            u -= 1.0;
        } else if (v >= 1.0) {
            j = 2;
            v -= 1.0;
        } else if (u + v <= 1.0) {
            j = 0;
        } else {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        piece = 4 * piece + j;
    }
    return piece;
}

// Calls visit(u, v) with the centre of every piece, in the order of `pieceAt`.
template <class Visit>
void forCentres(double u, double v, double size, int depth, Visit&& visit) {
    if (depth == 0) {
        visit(u + size / 3.0, v + size / 3.0);
        return;
    }
    const double half = 0.5 * size;
    forCentres(u, v, half, depth - 1, visit);
    forCentres(u + half, v, half, depth - 1, visit);
    forCentres(u, v + half, half, depth - 1, visit);
    forCentres(u + half, v + half, -half, depth - 1, visit);
}

}  // namespace

FineBins::FineBins(const Groom& groom) {
    const SurfaceMesh& mesh = *groom.mesh;
    const DensityLookup density(groom);
    m_firstBin.push_back(0);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        const int depth = texelDepth(mesh, t, density.mapWidth(), density.mapHeight(), 8);
        const double area = triangleArea(mesh, t) / std::pow(4.0, depth);
        forCentres(0.0, 0.0, 1.0, depth, [&](double u, double v) {
            const SurfacePoint centre{t, static_cast<float>(u), static_cast<float>(v)};
            m_weights.push_back(area * static_cast<double>(density.at(t, uvAt(mesh, centre))));
        });
        m_depths.push_back(depth);
        m_firstBin.push_back(m_weights.size());
    }
    m_total = std::accumulate(m_weights.begin(), m_weights.end(), 0.0);
    m_found.assign(m_weights.size(), 0.0);
}

void FineBins::add(const SurfacePoint& root) {
    const int depth = m_depths[root.triangle];
    const std::size_t first = m_firstBin[root.triangle];
    const auto u = static_cast<double>(root.u), v = static_cast<double>(root.v);
    std::size_t piece = pieceAt(u, v, depth);
    // A place is stored in floats: one on the edge of its piece may read as its neighbour's by the last bit.
    constexpr double bit = 1.2e-7;
    for (const auto& [du, dv] : {std::pair(bit, 0.0), {-bit, 0.0}, {0.0, bit}, {0.0, -bit}, {bit, bit}, {-bit, -bit}}) {
        if (m_weights[first + piece] > 0.0) break;
        const double nu = std::clamp(u + du, 0.0, 1.0), nv = std::clamp(v + dv, 0.0, 1.0 - nu);
        piece = pieceAt(nu, nv, depth);
    }
    m_found[first + piece] += 1.0;
}

std::uint64_t FineBins::foundWhereNothingGrows() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < m_found.size(); ++i) sum += m_weights[i] > 0.0 ? 0.0 : m_found[i];
    return static_cast<std::uint64_t>(sum);
}

std::uint64_t FineBins::foundOn(std::size_t triangle) const {
    double sum = 0.0;
    for (std::size_t i = m_firstBin[triangle]; i < m_firstBin[triangle + 1]; ++i) sum += m_found[i];
    return static_cast<std::uint64_t>(sum);
}

double FineBins::chiSquareExcess() const {
    const double found = std::accumulate(m_found.begin(), m_found.end(), 0.0);
    std::vector<double> expected = m_weights;
    for (double& share : expected) share *= found / m_total;
    return testing::chiSquareExcess(expected, m_found);
}

double FineBins::chiSquarePerBin(double pooled) const {
    const double found = std::accumulate(m_found.begin(), m_found.end(), 0.0);
    double sum = 0.0, expected = 0.0, here = 0.0;
    int bins = 0;
    for (std::size_t i = 0; i < m_weights.size(); ++i) {
        expected += m_weights[i] * found / m_total;
        here += m_found[i];
        if (expected < pooled) continue;
        sum += (here - expected) * (here - expected) / expected;
        ++bins;
        expected = here = 0.0;
    }
    return bins > 0 ? sum / bins : 1e9;
}

Groom densityGroom(SurfaceMesh mesh, Map map) {
    Groom groom = makeGroom(std::move(mesh));
    groom.maps.set("density", std::move(map));
    groom.groups.edit()[0].params.general.density = {1.0f, "density"};
    return groom;
}

RootSampler samplerOf(const Groom& groom) {
    Progress progress;
    return *RootSampler::build(groom, DensityLookup(groom), progress);
}

}  // namespace whorl::testing
