// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/surface_curve.h"

#include "core/sampling/hilbert.h"
#include "core/surface/surface_point.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace whorl {

namespace {

struct Areas {
    std::vector<double> byTriangle;
    double total = 0.0;
    double growing = 0.0;

    Areas(const SurfaceMesh& mesh, std::span<const std::uint8_t> grows) : byTriangle(mesh.triangles.size()) {
        for (std::uint32_t t = 0; t < byTriangle.size(); ++t) {
            const double area = triangleArea(mesh, t);
            byTriangle[t] = area > 0.0 && std::isfinite(area) ? area : 0.0;
            total += byTriangle[t];
            if (grows[t]) growing += byTriangle[t];
        }
    }
    bool enoughGrows() const { return growing >= total / 64.0; }
};

}  // namespace

SurfaceCurve::SurfaceCurve(const SurfaceMesh& mesh, std::span<const std::uint8_t> grows) {
    const Areas all(mesh, grows);
    const std::vector<double>& areas = all.byTriangle;
    m_whole = all.enoughGrows();
    const double total = m_whole ? all.total : all.growing;
    if (!(total > 0.0) || !std::isfinite(total)) return;

    double before = 0.0;
    std::uint32_t begin = 0;
    for (const std::uint32_t t : hilbertOrder(mesh)) {
        if (areas[t] <= 0.0 || (!m_whole && !grows[t])) continue;
        before += areas[t];
        const double place = std::round(before / total * static_cast<double>(end));
        const auto next = static_cast<std::uint32_t>(std::min(place, static_cast<double>(end)));
        if (next <= begin) continue;
        m_triangles.push_back(t);
        m_begins.push_back(begin);
        begin = next;
    }
    // What rounding left over belongs to the last.
    m_begins.push_back(end);
    m_reciprocals.resize(count());
    for (std::size_t i = 0; i < count(); ++i) {
        const std::uint64_t scaled = std::uint64_t{width(i)} << std::countl_zero(width(i));
        m_reciprocals[i] = static_cast<std::uint32_t>(~std::uint64_t{0} / scaled - (std::uint64_t{1} << 32));
    }
}

bool SurfaceCurve::serves(const SurfaceMesh& mesh, std::span<const std::uint8_t> grows) const {
    return m_whole && Areas(mesh, grows).enoughGrows();
}

std::size_t SurfaceCurve::placeAt(std::uint32_t unit) const {
    return static_cast<std::size_t>(std::upper_bound(m_begins.begin(), m_begins.end() - 1, unit) - m_begins.begin()) -
           1;
}

std::size_t SurfaceCurve::memoryBytes() const {
    return (m_triangles.capacity() + m_begins.capacity() + m_reciprocals.capacity()) * sizeof(std::uint32_t);
}

}  // namespace whorl
