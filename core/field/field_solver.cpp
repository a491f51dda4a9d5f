// SPDX-License-Identifier: Apache-2.0
#include "core/field/direction_field.h"
#include "core/field/field_state.h"

#include <Eigen/SparseCholesky>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace whorl {
namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::SparseMatrix<Complex>;
using Factor = Eigen::SimplicialLDLT<Matrix, Eigen::Lower>;

constexpr std::uint32_t none = UINT32_MAX;
/// Weight of a stroke of one edge's length against a unit of smoothness: enough for a fraction of a degree.
constexpr double strokeStrength = 20000.0;
/// Holds the system definite where there is neither stroke nor default.
constexpr double ground = 1e-9;

glm::vec3 anyPerpendicular(const glm::vec3& normal) {
    const glm::vec3 other = std::abs(normal.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(other - normal * glm::dot(normal, other));
}

double cotangent(const glm::dvec3& a, const glm::dvec3& b) {
    const double across = glm::length(glm::cross(a, b));
    // Obtuse and thin triangles of scans keep their neighbours together, too.
    return across > 0.0 ? std::clamp(glm::dot(a, b) / across, 0.05, 20.0) : 0.05;
}

struct Edge {
    std::uint32_t from, to;  // unknowns
    double weight;
    Complex turn;  // from -> to
};

/// A place of a stroke: what the field is there, as a sum over the corners, and what it shall be.
struct Wish {
    std::uint32_t unknowns[3];
    Complex shares[3];
    Complex wanted;
    double weight;
};

/// A polyline by its length.
class StrokeLine {
public:
    explicit StrokeLine(std::span<const glm::vec3> points) : m_points(points), m_before{0.0f} {
        for (std::size_t i = 1; i < points.size(); ++i) {
            m_before.push_back(m_before.back() + glm::distance(points[i - 1], points[i]));
        }
    }
    float length() const { return m_points.empty() ? 0.0f : m_before.back(); }
    /// The place after `metres`; the ends for less and more. Not when there are no points.
    glm::vec3 at(float metres) const {
        metres = std::clamp(metres, 0.0f, length());
        const auto next = static_cast<std::size_t>(std::ranges::upper_bound(m_before, metres) - m_before.begin());
        if (next >= m_points.size()) return m_points.back();
        const float piece = m_before[next] - m_before[next - 1];
        return glm::mix(m_points[next - 1], m_points[next],
                        piece > 0.0f ? (metres - m_before[next - 1]) / piece : 0.0f);
    }

private:
    std::span<const glm::vec3> m_points;
    std::vector<float> m_before;
};

}  // namespace

struct FieldSolver::State {
    std::shared_ptr<FieldDomain> domain = std::make_shared<FieldDomain>();
    std::vector<std::uint32_t> unknown;  // one a vertex, or none
    std::vector<std::uint32_t> vertex;   // one an unknown
    std::vector<double> areas;           // one an unknown, square metres
    std::vector<Edge> edges;
    double edgeLength = 0.0;  // mean, metres
    Matrix smooth;            // strokes and defaults add to places that are there
    // Knows the order of elimination, which depends on those places only; one thread at a time.
    mutable std::mutex factorMutex;
    mutable Factor factor;

    /// Direction and how much it counts, 0 to 1, at a vertex.
    glm::vec3 defaultAt(std::uint32_t at, const FieldParams& params) const;
    void addWishes(const FieldStroke& stroke, std::vector<Wish>& wishes) const;
    void addWish(const SurfacePoint& point, const glm::vec3& piece, float weight, std::vector<Wish>& wishes) const;
};

glm::vec3 FieldSolver::State::defaultAt(std::uint32_t at, const FieldParams& params) const {
    const SurfaceMesh& mesh = domain->mesh();
    const glm::vec3& place = mesh.positions[at];
    const float pull = glm::length(params.gravity.value);
    glm::vec3 sum = pull > 0.0f ? domain->tangent(at, params.gravity.value / pull) : glm::vec3(0.0f);
    if (!(params.partingWidth > 0.0f)) return sum;
    float nearest = params.partingWidth;
    glm::vec3 away(0.0f);
    for (const Parting& parting : domain->lines) {
        for (std::size_t i = 1; i < parting.points.size(); ++i) {
            const glm::vec3 a = positionAt(mesh, parting.points[i - 1]), b = positionAt(mesh, parting.points[i]);
            const glm::vec3 way = b - a;
            const float squared = glm::dot(way, way);
            const float t = squared > 0.0f ? glm::clamp(glm::dot(place - a, way) / squared, 0.0f, 1.0f) : 0.0f;
            const glm::vec3 from = place - (a + way * t);
            const float distance = glm::length(from);
            if (distance >= nearest) continue;
            nearest = distance;
            away = domain->tangent(at, from);
        }
    }
    const float length = glm::length(away);
    if (!(length > 1e-9f)) return sum;
    const float share = 1.0f - nearest / params.partingWidth;
    return glm::mix(sum, away / length, share * share * (3.0f - 2.0f * share));
}

void FieldSolver::State::addWishes(const FieldStroke& stroke, std::vector<Wish>& wishes) const {
    const SurfaceMesh& mesh = domain->mesh();
    if (!(stroke.weight > 0.0f)) return;
    const double step = std::max(edgeLength, 1e-12);
    // Pieces between points that are on the mesh; a line may have gaps.
    std::vector<glm::vec3> line;
    const auto flush = [&] {
        const StrokeLine along(line);
        const int places = std::clamp(static_cast<int>(2.0 * static_cast<double>(along.length()) / step), 1, 100000);
        const float share = along.length() / static_cast<float>(places);
        for (int k = 0; k < places && along.length() > 0.0f; ++k) {
            const float here = (static_cast<float>(k) + 0.5f) * share;
            // The direction over an edge's length: a line over flat triangles has kinks where they meet, and the hand
            // shakes.
            const auto reach = static_cast<float>(step);
            const glm::vec3 way = along.at(here + reach) - along.at(here - reach);
            const auto hit = domain->surface->query.nearest(along.at(here));
            if (hit) addWish(hit->point, way, stroke.weight * share, wishes);
        }
        line.clear();
    };
    for (const SurfacePoint& point : stroke.points) {
        if (point.triangle < mesh.triangleCount()) {
            line.push_back(positionAt(mesh, point));
        } else {
            flush();
        }
    }
    flush();
}

void FieldSolver::State::addWish(const SurfacePoint& point, const glm::vec3& piece, float weight,
                                 std::vector<Wish>& wishes) const {
    const SurfaceMesh& mesh = domain->mesh();
    if (!domain->grows[point.triangle]) return;
    const glm::vec3 normal = normalAt(mesh, point);
    const glm::vec3 way = piece - normal * glm::dot(normal, piece);
    if (!(glm::length(way) > 1e-9f)) return;
    // Frame at the place: along the stroke is 1.
    const glm::vec3 along = glm::normalize(way), left = glm::cross(normal, along);
    const float shares[3] = {1.0f - point.u - point.v, point.u, point.v};
    Wish wish{{none, none, none}, {}, 1.0, 0.0};
    const PartingIndex::Root here{positionAt(mesh, point), normal};
    double met = 0.0;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t corner = mesh.triangles[point.triangle][k];
        const bool apart = domain->nearParting[point.triangle] != 0 &&
                           domain->apart(here, {mesh.positions[corner], domain->normals[corner]});
        if (apart) continue;
        wish.unknowns[k] = unknown[corner];
        const glm::vec3 turned = minimalRotation(domain->normals[corner], normal) * domain->axes[corner];
        const Complex turn(static_cast<double>(glm::dot(turned, along)), static_cast<double>(glm::dot(turned, left)));
        wish.shares[k] = turn * static_cast<double>(shares[k]);
        met += static_cast<double>(shares[k]);
    }
    if (!(met > 1e-3)) return;
    for (Complex& share : wish.shares) share /= met;
    wish.weight = strokeStrength * static_cast<double>(weight) / std::max(edgeLength, 1e-12);
    wishes.push_back(wish);
}

Result<FieldSolver> FieldSolver::make(std::shared_ptr<const Surface> surface, std::span<const std::uint8_t> grows,
                                      std::span<const Parting> partings, Progress& progress) {
    auto state = std::make_shared<State>();
    FieldDomain& domain = *state->domain;
    domain.surface = std::move(surface);
    const SurfaceMesh& mesh = domain.mesh();
    domain.grows.assign(grows.begin(), grows.end());
    domain.grows.resize(mesh.triangleCount(), 0);
    domain.partings = PartingIndex(mesh, partings);
    domain.lines.assign(partings.begin(), partings.end());
    domain.normals = mesh.normals;
    for (const glm::vec3& normal : domain.normals) domain.axes.push_back(anyPerpendicular(normal));

    domain.nearParting.assign(mesh.triangleCount(), 0);
    state->unknown.assign(mesh.positions.size(), none);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        if ((t & 4095u) == 0 && progress.cancelled()) return cancelledError();
        if (!domain.grows[t]) continue;
        const glm::uvec3 corners = mesh.triangles[t];
        if (!domain.partings.empty()) {
            const glm::vec3 centre =
                (mesh.positions[corners.x] + mesh.positions[corners.y] + mesh.positions[corners.z]) / 3.0f;
            float radius = 0.0f;
            for (int k = 0; k < 3; ++k) radius = std::max(radius, glm::distance(centre, mesh.positions[corners[k]]));
            domain.nearParting[t] = domain.partings.near(centre, radius) ? 1 : 0;
        }
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& number = state->unknown[corners[k]];
            if (number != none) continue;
            number = static_cast<std::uint32_t>(state->vertex.size());
            state->vertex.push_back(corners[k]);
        }
    }
    const auto count = static_cast<Eigen::Index>(state->vertex.size());
    state->areas.assign(state->vertex.size(), 0.0);
    std::vector<Eigen::Triplet<Complex>> entries;
    double lengths = 0.0;
    std::size_t edgeCount = 0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        if ((t & 4095u) == 0 && progress.cancelled()) return cancelledError();
        if (!domain.grows[t]) continue;
        const glm::uvec3 corners = mesh.triangles[t];
        const double area = triangleArea(mesh, t);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
            state->areas[state->unknown[a]] += area / 3.0;
            lengths += static_cast<double>(glm::distance(mesh.positions[a], mesh.positions[b]));
            ++edgeCount;
            const std::uint32_t i = state->unknown[a], j = state->unknown[b];
            // The place is kept for strokes even where nothing is compared.
            entries.emplace_back(std::max(i, j), std::min(i, j), 0.0);
            if (i == j || (domain.nearParting[t] != 0 && domain.separated(a, b))) continue;
            const glm::dvec3 corner(mesh.positions[c]);
            const double weight =
                0.5 * cotangent(glm::dvec3(mesh.positions[a]) - corner, glm::dvec3(mesh.positions[b]) - corner);
            state->edges.push_back({i, j, weight, domain.turn(a, b)});
        }
    }
    state->edgeLength = edgeCount > 0 ? lengths / static_cast<double>(edgeCount) : 0.0;
    // |z_j - r z_i|^2 for each edge, the lower half.
    for (const Edge& edge : state->edges) {
        entries.emplace_back(edge.from, edge.from, edge.weight);
        entries.emplace_back(edge.to, edge.to, edge.weight);
        const bool lower = edge.to > edge.from;
        entries.emplace_back(std::max(edge.from, edge.to), std::min(edge.from, edge.to),
                             lower ? -edge.weight * edge.turn : -edge.weight * std::conj(edge.turn));
    }
    for (Eigen::Index i = 0; i < count; ++i) entries.emplace_back(i, i, ground);
    state->smooth = Matrix(count, count);
    state->smooth.setFromTriplets(entries.begin(), entries.end());
    if (count > 0) state->factor.analyzePattern(state->smooth);
    FieldSolver solver;
    solver.m_state = std::move(state);
    return solver;
}

DirectionField FieldSolver::defaults(const FieldParams& params) const {
    auto made = std::make_shared<DirectionField::State>();
    made->domain = m_state->domain;
    made->directions.assign(m_state->unknown.size(), glm::vec3(0.0f));
    for (const std::uint32_t vertex : m_state->vertex) {
        const glm::vec3 direction = m_state->defaultAt(vertex, params);
        const float length = glm::length(direction);
        if (length > 1e-4f) made->directions[vertex] = direction / length;
    }
    DirectionField field;
    field.m_state = std::move(made);
    return field;
}

Result<DirectionField> FieldSolver::solve(std::span<const FieldStroke> strokes, const FieldParams& params,
                                          Progress& progress) const {
    const State& s = *m_state;
    const auto count = static_cast<Eigen::Index>(s.vertex.size());
    std::vector<Wish> wishes;
    for (const FieldStroke& stroke : strokes) s.addWishes(stroke, wishes);

    Matrix matrix = s.smooth;
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(count);
    // A screened system: influence falls to 1/e over `reach`.
    const double lean = params.reach > 0.0f
                            ? 1.0 / (static_cast<double>(params.reach) * static_cast<double>(params.reach))
                        : wishes.empty() ? 1.0 / std::max(s.edgeLength * s.edgeLength * 16.0, 1e-18)
                                         : 0.0;
    if (lean > 0.0) {
        for (Eigen::Index i = 0; i < count; ++i) {
            const std::uint32_t vertex = s.vertex[static_cast<std::size_t>(i)];
            const glm::vec3 wanted = s.defaultAt(vertex, params);
            // Steep skin knows where down is better than flat skin does.
            const double weight =
                lean * s.areas[static_cast<std::size_t>(i)] * static_cast<double>(glm::length(wanted));
            if (!(weight > 0.0)) continue;
            matrix.coeffRef(i, i) += weight;
            right[i] += weight * s.domain->inFrame(vertex, glm::normalize(wanted));
        }
    }
    for (const Wish& wish : wishes) {
        for (int a = 0; a < 3; ++a) {
            if (wish.unknowns[a] == none) continue;
            right[wish.unknowns[a]] += wish.weight * std::conj(wish.shares[a]) * wish.wanted;
            for (int b = 0; b < 3; ++b) {
                if (wish.unknowns[b] == none || wish.unknowns[a] < wish.unknowns[b]) continue;
                matrix.coeffRef(wish.unknowns[a], wish.unknowns[b]) +=
                    wish.weight * std::conj(wish.shares[a]) * wish.shares[b];
            }
        }
    }
    if (progress.cancelled()) return cancelledError();
    Eigen::VectorXcd values = right;
    if (count > 0) {
        const std::lock_guard lock(s.factorMutex);
        s.factor.factorize(matrix);
        if (progress.cancelled()) return cancelledError();
        values = s.factor.solve(right);
    }

    auto made = std::make_shared<DirectionField::State>();
    made->domain = s.domain;
    made->directions.assign(s.unknown.size(), glm::vec3(0.0f));
    for (Eigen::Index i = 0; i < count; ++i) {
        const Complex value = values[i];
        const double length = std::abs(value);
        if (!(length > 1e-12) || !std::isfinite(length)) continue;
        const std::uint32_t vertex = s.vertex[static_cast<std::size_t>(i)];
        made->directions[vertex] = s.domain->fromFrame(vertex, value / length);
    }
    DirectionField field;
    field.m_state = std::move(made);
    return field;
}

}  // namespace whorl
