// SPDX-License-Identifier: Apache-2.0
#include "core/field/field_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>

namespace whorl {
namespace {

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

bool mayBeParted(const FieldDomain& domain, std::uint32_t triangle) {
    const SurfaceMesh& mesh = domain.mesh();
    const glm::uvec3 corners = mesh.triangles[triangle];
    const glm::vec3 centre = (mesh.positions[corners.x] + mesh.positions[corners.y] + mesh.positions[corners.z]) / 3.0f;
    float radius = 0.0f;
    for (int k = 0; k < 3; ++k) radius = std::max(radius, glm::distance(centre, mesh.positions[corners[k]]));
    return domain.partings.near(centre, radius);
}

/// Share of its shortest edge that a vertex counts as beside a parting at least.
constexpr float besideShare = 0.01f;

std::vector<glm::vec3> placesBeside(const FieldDomain& domain) {
    const SurfaceMesh& mesh = domain.mesh();
    std::vector<float> shortest(mesh.positions.size(), 0.0f);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        if (!domain.nearParting[t]) continue;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            const float length = glm::distance(mesh.positions[a], mesh.positions[b]);
            for (const std::uint32_t v : {a, b})
                if (shortest[v] == 0.0f || length < shortest[v]) shortest[v] = length;
        }
    }
    std::vector<glm::vec3> places = mesh.positions;
    for (std::size_t v = 0; v < places.size(); ++v)
        if (shortest[v] > 0.0f) places[v] = domain.partings.beside(places[v], besideShare * shortest[v]);
    return places;
}

struct Edge {
    std::uint32_t from, to;  // unknowns
    double weight;
    std::complex<double> turn;  // from -> to
};

}  // namespace

Result<FieldMesh> FieldMesh::make(std::shared_ptr<const Surface> surface, std::span<const std::uint8_t> grows,
                                  std::span<const Parting> partings, Progress& progress) {
    FieldMesh made;
    FieldDomain& domain = *made.domain;
    domain.surface = std::move(surface);
    const SurfaceMesh& mesh = domain.mesh();
    domain.grows.assign(grows.begin(), grows.end());
    domain.grows.resize(mesh.triangleCount(), 0);
    domain.partings = PartingIndex(mesh, partings);
    domain.lines.assign(partings.begin(), partings.end());
    domain.normals = mesh.normals;
    for (const glm::vec3& normal : domain.normals) domain.axes.push_back(anyPerpendicular(normal));

    domain.nearParting.assign(mesh.triangleCount(), 0);
    made.unknown.assign(mesh.positions.size(), none);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        if ((t & 4095u) == 0 && progress.cancelled()) return cancelledError();
        if (!domain.grows[t]) continue;
        if (!domain.partings.empty()) domain.nearParting[t] = mayBeParted(domain, t) ? 1 : 0;
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& number = made.unknown[mesh.triangles[t][k]];
            if (number != none) continue;
            number = static_cast<std::uint32_t>(made.vertex.size());
            made.vertex.push_back(mesh.triangles[t][k]);
        }
    }
    if (!domain.partings.empty()) domain.besides = placesBeside(domain);
    made.areas.assign(made.vertex.size(), 0.0);
    std::vector<Edge> edges;
    double lengths = 0.0;
    std::size_t sides = 0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        if ((t & 4095u) == 0 && progress.cancelled()) return cancelledError();
        if (!domain.grows[t]) continue;
        const glm::uvec3 corners = mesh.triangles[t];
        const double area = triangleArea(mesh, t);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
            made.areas[made.unknown[a]] += area / 3.0;
            lengths += static_cast<double>(glm::distance(mesh.positions[a], mesh.positions[b]));
            ++sides;
            const std::uint32_t i = made.unknown[a], j = made.unknown[b];
            if (i == j) continue;
            // The place is kept for strokes even where nothing is compared.
            made.pairs.push_back({std::min(i, j), std::max(i, j)});
            if (domain.nearParting[t] != 0 && domain.separated(a, b)) continue;
            const glm::dvec3 corner(mesh.positions[c]);
            const double weight =
                0.5 * cotangent(glm::dvec3(mesh.positions[a]) - corner, glm::dvec3(mesh.positions[b]) - corner);
            edges.push_back({i, j, weight, domain.turn(a, b)});
        }
    }
    std::ranges::sort(made.pairs);
    made.pairs.erase(std::unique(made.pairs.begin(), made.pairs.end()), made.pairs.end());
    made.edgeLength = sides > 0 ? lengths / static_cast<double>(sides) : 0.0;

    made.smooth.diagonal.assign(made.vertex.size(), ground);
    made.smooth.coupled.assign(made.pairs.size(), 0.0);
    made.firstWay.assign(made.vertex.size() + 1, 0);
    for (const Edge& edge : edges) {
        made.smooth.diagonal[edge.from] += edge.weight;
        made.smooth.diagonal[edge.to] += edge.weight;
        made.smooth.coupled[made.pairOf(edge.from, edge.to)] -=
            edge.weight * (edge.to > edge.from ? edge.turn : std::conj(edge.turn));
        ++made.firstWay[edge.from + 1];
        ++made.firstWay[edge.to + 1];
    }
    std::partial_sum(made.firstWay.begin(), made.firstWay.end(), made.firstWay.begin());
    made.ways.resize(2 * edges.size());
    std::vector<std::uint32_t> next = made.firstWay;
    for (const Edge& edge : edges) {
        made.ways[next[edge.from]++] = {edge.to, edge.turn};
        made.ways[next[edge.to]++] = {edge.from, std::conj(edge.turn)};
    }
    made.numberPieces();
    return made;
}

void FieldMesh::numberPieces() {
    piece.assign(vertex.size(), none);
    std::vector<std::uint32_t> open;
    for (std::uint32_t start = 0; start < vertex.size(); ++start) {
        if (piece[start] != none) continue;
        open.push_back(start);
        piece[start] = pieces;
        while (!open.empty()) {
            const std::uint32_t here = open.back();
            open.pop_back();
            for (std::uint32_t w = firstWay[here]; w < firstWay[here + 1]; ++w) {
                if (piece[ways[w].to] != none) continue;
                piece[ways[w].to] = pieces;
                open.push_back(ways[w].to);
            }
        }
        ++pieces;
    }
}

std::uint32_t FieldMesh::pairOf(std::uint32_t a, std::uint32_t b) const {
    const FrontSolver::Pair pair{std::min(a, b), std::max(a, b)};
    return static_cast<std::uint32_t>(std::ranges::lower_bound(pairs, pair) - pairs.begin());
}

glm::vec3 FieldMesh::defaultAt(std::uint32_t at, const FieldParams& params) const {
    const SurfaceMesh& mesh = domain->mesh();
    const std::uint32_t corner = vertex[at];
    const glm::vec3& place = mesh.positions[corner];
    const float pull = glm::length(params.gravity.value);
    const glm::vec3 down = pull > 0.0f ? domain->tangent(corner, params.gravity.value / pull) : glm::vec3(0.0f);
    if (!(params.partingWidth > 0.0f)) return down;
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
            away = domain->tangent(corner, from);
        }
    }
    const float length = glm::length(away);
    if (!(length > 1e-9f)) return down;
    const float share = 1.0f - nearest / params.partingWidth;
    return glm::mix(down, away / length, share * share * (3.0f - 2.0f * share));
}

}  // namespace whorl
