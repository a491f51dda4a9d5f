// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/even_sequence.h"

#include "core/base/parallel.h"
#include "core/sampling/candidates.h"
#include "core/sampling/root_sampler.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace whorl {
namespace {

// A dart on the surface.
struct Dart {
    glm::vec3 position;
    glm::vec3 normal;
    std::uint32_t unit, triangle, share;
};

// Kept darts by cells of space, found by a hash: what shares a place in the table by chance is told by its distance.
class Cells {
public:
    // Twice the radius wide, so that a ball meets at most eight cells.
    void rebuild(double radius, const std::vector<Dart>& darts) {
        m_perMetre = static_cast<float>(1.0 / (2.0 * radius));
        m_first.assign(std::bit_ceil(std::max<std::size_t>(4 * darts.size(), 1024)), none);
        m_next.clear();
        for (const Dart& dart : darts) insert(dart);
    }

    /// The next dart.
    void insert(const Dart& dart) {
        std::uint32_t& first = m_first[slotOf(cellOf(dart.position))];
        m_next.push_back(first);
        first = static_cast<std::uint32_t>(m_next.size() - 1);
    }

    bool crowded(const Dart& dart, float radius, const std::vector<Dart>& darts) const {
        const glm::ivec3 low = cellOf(dart.position - radius), high = cellOf(dart.position + radius);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    for (std::uint32_t i = m_first[slotOf({x, y, z})]; i != none; i = m_next[i])
                        if (near(dart, darts[i], radius)) return true;
        return false;
    }

private:
    static constexpr std::uint32_t none = 0xffffffffu;
    static bool near(const Dart& a, const Dart& b, float radius) {
        const glm::vec3 apart = a.position - b.position;
        return glm::dot(apart, apart) < radius * radius && glm::dot(a.normal, b.normal) > 0.0f;
    }
    glm::ivec3 cellOf(const glm::vec3& p) const {
        const auto cell = [&](float x) {
            return static_cast<int>(std::clamp(std::floor(x * m_perMetre), -1e9f, 1e9f));
        };
        return {cell(p.x), cell(p.y), cell(p.z)};
    }
    std::size_t slotOf(const glm::ivec3& cell) const {
        std::uint32_t hash = static_cast<std::uint32_t>(cell.x) * 0x8da6b343u +
                             static_cast<std::uint32_t>(cell.y) * 0xd8163841u +
                             static_cast<std::uint32_t>(cell.z) * 0xcb1ab31fu;
        hash ^= hash >> 15;
        return (hash * 0x85ebca6bu >> 7) & (m_first.size() - 1);
    }

    float m_perMetre = 1.0f;
    std::vector<std::uint32_t> m_first;
    std::vector<std::uint32_t> m_next;
};

class Thrower {
public:
    Thrower(const SurfaceMesh& mesh, const SurfaceCurve& curve, std::uint32_t seed)
        : m_mesh(mesh), m_curve(curve), m_keys(candidateKeys(seed ^ 0x6576656eu)) {
        for (const std::uint32_t triangle : curve.triangles()) m_area += triangleArea(mesh, triangle);
        // The first place of every 65,536 units.
        std::uint32_t place = 0;
        for (std::uint64_t unit = 0; unit < SurfaceCurve::end; unit += 65536) {
            while (curve.begins()[place + 1] <= unit) ++place;
            m_nearby.push_back(place);
        }
    }

    // Distance that dart t keeps.
    double radiusOf(std::uint64_t t) const { return std::sqrt(EvenSequence::reach * m_area / static_cast<double>(t)); }

    Dart dart(std::uint64_t t) const {
        const auto id = static_cast<std::uint32_t>(t);
        Dart dart{};
        dart.unit = unitOf(stratumOf(m_keys, id));
        std::size_t place = m_nearby[dart.unit >> 16];
        while (m_curve.begins()[place + 1] <= dart.unit) ++place;
        const auto zeros = static_cast<std::uint32_t>(std::countl_zero(m_curve.width(place)));
        dart.share = shareOfTriangle(dart.unit - m_curve.begins()[place], finePlace(m_keys, id), zeros,
                                     m_curve.reciprocals()[place]);
        dart.triangle = m_curve.triangles()[place];
        std::int32_t u = 0, v = 0;
        placeInTriangle(dart.share, u, v);
        dart.position =
            positionAt(m_mesh, {dart.triangle, static_cast<float>(u) * placeUnit, static_cast<float>(v) * placeUnit});
        dart.normal = triangleNormal(m_mesh, dart.triangle);
        return dart;
    }

    bool hasArea() const { return m_area > 0.0 && std::isfinite(m_area); }

private:
    const SurfaceMesh& m_mesh;
    const SurfaceCurve& m_curve;
    CandidateKeys m_keys;
    double m_area = 0.0;
    std::vector<std::uint32_t> m_nearby;
};

}  // namespace

EvenSequence::EvenSequence(const SurfaceMesh& mesh, const SurfaceCurve& curve, std::uint32_t seed, std::uint32_t count,
                           bool alone, Progress& progress) {
    if (curve.empty() || count == 0) return;
    const Thrower thrower(mesh, curve, seed);
    if (!thrower.hasArea()) return;
    // Darts have numbers of 31 bits. So many are only thrown in vain where the surface has no room.
    constexpr std::uint64_t last = (std::uint64_t{1} << 31) - 1;
    std::vector<Dart> kept;
    kept.reserve(count);
    Cells cells;
    std::uint64_t built = 0;  // the dart that the cells were made for
    std::size_t before = 0;   // kept by then
    for (std::uint64_t first = 1; first <= last && kept.size() < count;) {
        if (built == 0 || first >= 2 * built) {
            // Where numbers are too coarse for the mesh no more find room; elsewhere about one in nine does.
            if (built >= 65536 && kept.size() - before < built / 100) break;
            built = first;
            before = kept.size();
            cells.rebuild(thrower.radiusOf(first), kept);
        }
        // Together, those that keep clear of all before; then one after another among themselves.
        const std::uint64_t end =
            std::min({first + std::clamp<std::uint64_t>(first / 8, 16, 1u << 16), 2 * built, last + 1});
        constexpr std::size_t grain = 1024;
        const auto thrown = static_cast<std::size_t>(end - first);
        struct Clear {
            std::uint64_t t;
            Dart dart;
        };
        std::vector<std::vector<Clear>> clear((thrown + grain - 1) / grain);
        const auto look = [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i) {
                const Dart dart = thrower.dart(first + i);
                if (!cells.crowded(dart, static_cast<float>(thrower.radiusOf(first + i)), kept))
                    clear[from / grain].push_back({first + i, dart});
            }
        };
        if (alone) {
            for (std::size_t from = 0; from < thrown; from += grain) look(from, std::min(from + grain, thrown));
        } else {
            parallelFor(thrown, grain, look);
        }
        for (const std::vector<Clear>& block : clear) {
            for (const Clear& c : block) {
                if (kept.size() >= count) break;
                if (cells.crowded(c.dart, static_cast<float>(thrower.radiusOf(c.t)), kept)) continue;
                kept.push_back(c.dart);
                cells.insert(c.dart);
            }
        }
        if (progress.cancelled()) return;
        first = end;
    }
    m_places.reserve(kept.size());
    for (std::uint32_t rank = 0; rank < kept.size(); ++rank)
        m_places.push_back({kept[rank].unit, rank, kept[rank].triangle, kept[rank].share});
    std::sort(m_places.begin(), m_places.end(),
              [](const Place& a, const Place& b) { return std::pair(a.unit, a.rank) < std::pair(b.unit, b.rank); });
}

std::shared_ptr<const EvenSequence> EvenSequences::get(std::uint32_t seed, double count, bool alone,
                                                       Progress& progress) {
    const double wanted = std::clamp(count, 1.0, static_cast<double>(EvenSequence::most));
    {
        const std::lock_guard lock(m_mutex);
        if (m_newest && m_seed == seed && m_asked >= wanted) return m_newest;
    }
    // Not under the lock: a thread that waits for others may be given work that comes here too. A little more, so that
    // a slider does not ask anew at every step.
    const double more = std::min(wanted * 1.25 + 1024.0, static_cast<double>(EvenSequence::most));
    auto made = std::make_shared<const EvenSequence>(*m_mesh, *m_curve, seed, static_cast<std::uint32_t>(more), alone,
                                                     progress);
    if (progress.cancelled()) return made;
    const std::lock_guard lock(m_mutex);
    if (m_newest && m_seed == seed && m_asked >= more) return m_newest;
    m_newest = made;
    m_seed = seed;
    m_asked = more;
    return made;
}

std::size_t EvenSequences::memoryBytes() {
    const std::lock_guard lock(m_mutex);
    return m_newest ? m_newest->memoryBytes() : 0;
}

}  // namespace whorl
