// SPDX-License-Identifier: Apache-2.0
#include "core/field/field_wishes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>

// The way to the line is carried from vertex to vertex, outward from the line: turned along with the skin over each
// edge, less the edge itself (Schmidt, Grimm and Wyvill, "Interactive Decal Compositing with Discrete Exponential
// Maps", 2006). On a plane that is exact.

namespace whorl {
namespace {

using Complex = FieldMesh::Complex;

/// A place of the line, with a frame of its own.
struct Place {
    SurfacePoint point;
    glm::vec3 position{0.0f}, normal{0.0f}, axis{0.0f};
    Complex ahead;  // to the next place; zero where the line ends
    Complex turn;   // from this frame to the next place's

    Complex inFrame(const glm::vec3& v) const {
        return {static_cast<double>(glm::dot(v, axis)), static_cast<double>(glm::dot(v, glm::cross(normal, axis)))};
    }
};

/// The number of a vector along the skin that is as long as it is in space.
Complex asLong(Complex value, const glm::vec3& vector) {
    const double length = std::abs(value);
    return length > 0.0 ? value * (static_cast<double>(glm::length(vector)) / length) : value;
}

Complex unit(Complex value) {
    const double length = std::abs(value);
    return length > 0.0 ? value / length : 1.0;
}

std::vector<Place> placesOf(const FieldMesh& field, std::span<const SurfacePoint> points) {
    const SurfaceMesh& mesh = field.domain->mesh();
    std::vector<Place> places;
    for (const LineByLength& line : linesOf(mesh, points)) {
        const double steps = std::ceil(2.0 * static_cast<double>(line.length()) / std::max(field.edgeLength, 1e-12));
        const int last = std::clamp(static_cast<int>(steps), 0, 100000);
        const std::size_t first = places.size();
        for (int k = 0; k <= last; ++k) {
            const float metres = last > 0 ? line.length() * static_cast<float>(k) / static_cast<float>(last) : 0.0f;
            const auto hit = field.domain->surface->query.nearest(line.at(metres));
            if (!hit) continue;
            Place place{hit->point, hit->position, normalAt(mesh, hit->point), {}, 0.0, 1.0};
            const glm::vec3 other = std::abs(place.normal.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
            place.axis = glm::normalize(other - place.normal * glm::dot(place.normal, other));
            if (places.size() > first) {
                Place& before = places.back();
                const glm::vec3 ahead = place.position - before.position;
                before.ahead = asLong(before.inFrame(ahead), ahead);
                before.turn = unit(place.inFrame(minimalRotation(before.normal, place.normal) * before.axis));
            }
            places.push_back(place);
        }
    }
    return places;
}

/// What a vertex knows of the line.
struct Known {
    Complex way;   // to the place, in the vertex's frame
    Complex turn;  // from the place's frame to the vertex's
    std::uint32_t place = 0;
    bool settled = false;
};

/// Takes the neighbours of the place while they are nearer.
void slide(const std::vector<Place>& places, Known& known) {
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Place& here = places[known.place];
        const Complex ahead = known.way + known.turn * here.ahead;
        if (here.ahead != 0.0 && std::norm(ahead) < std::norm(known.way)) {
            known = {ahead, known.turn * std::conj(here.turn), known.place + 1, false};
            continue;
        }
        if (known.place == 0 || places[known.place - 1].ahead == 0.0) return;
        const Place& before = places[known.place - 1];
        const Complex turn = known.turn * before.turn;
        const Complex back = known.way - turn * before.ahead;
        if (!(std::norm(back) < std::norm(known.way))) return;
        known = {back, turn, known.place - 1, false};
    }
}

/// The way to the nearest place between the place and its neighbours.
Complex nearest(const std::vector<Place>& places, const Known& known) {
    Complex best = known.way;
    const auto along = [&](Complex piece) {
        if (piece == 0.0) return;
        const double t = std::clamp(-(known.way * std::conj(piece)).real() / std::norm(piece), 0.0, 1.0);
        if (std::norm(known.way + t * piece) < std::norm(best)) best = known.way + t * piece;
    };
    along(known.turn * places[known.place].ahead);
    if (known.place > 0) along(-known.turn * places[known.place - 1].turn * places[known.place - 1].ahead);
    return best;
}

}  // namespace

std::vector<WayToLine> waysToLine(const FieldMesh& field, std::span<const SurfacePoint> points, float radius) {
    const FieldDomain& domain = *field.domain;
    const SurfaceMesh& mesh = domain.mesh();
    const std::vector<Place> places = placesOf(field, points);
    std::unordered_map<std::uint32_t, Known> known;
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto limit = static_cast<double>(radius);
    const auto offer = [&](std::uint32_t unknown, Known offered) {
        slide(places, offered);
        const double distance = std::abs(offered.way);
        if (!(distance < limit)) return;
        const auto [at, isNew] = known.try_emplace(unknown, offered);
        if (!isNew) {
            if (at->second.settled || !(distance < std::abs(at->second.way))) return;
            at->second = offered;
        }
        open.emplace(distance, unknown);
    };
    for (std::uint32_t k = 0; k < places.size(); ++k) {
        const Place& place = places[k];
        const std::uint32_t triangle = place.point.triangle;
        if (!domain.grows[triangle]) continue;
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t corner = mesh.triangles[triangle][c];
            if (domain.nearParting[triangle] != 0 && domain.apart({place.position, place.normal}, domain.root(corner)))
                continue;
            const glm::vec3 way = place.position - mesh.positions[corner];
            const glm::vec3 axis = minimalRotation(place.normal, domain.normals[corner]) * place.axis;
            offer(field.unknown[corner],
                  {asLong(domain.inFrame(corner, way), way), unit(domain.inFrame(corner, axis)), k, false});
        }
    }
    while (!open.empty()) {
        const auto [distance, here] = open.top();
        open.pop();
        Known& from = known.at(here);
        if (from.settled) continue;
        from.settled = true;
        const Known settled = from;  // the table may move
        const glm::vec3 position = mesh.positions[field.vertex[here]];
        for (std::uint32_t w = field.firstWay[here]; w < field.firstWay[here + 1]; ++w) {
            const auto& [to, turn] = field.ways[w];
            const glm::vec3 step = mesh.positions[field.vertex[to]] - position;
            // As both ends see it.
            const Complex edge =
                domain.inFrame(field.vertex[here], step) * turn + domain.inFrame(field.vertex[to], step);
            offer(to, {settled.way * turn - asLong(edge, step), settled.turn * turn, settled.place, false});
        }
    }
    std::vector<WayToLine> ways;
    for (const auto& [unknown, at] : known) ways.push_back({unknown, nearest(places, at)});
    std::ranges::sort(ways, {}, &WayToLine::unknown);
    return ways;
}

}  // namespace whorl
