// SPDX-License-Identifier: Apache-2.0
#include "core/field/grow_guides.h"

#include "core/base/parallel.h"
#include "core/brushes/constraints.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace whorl {
namespace {

/// Share of the length that a black texel of the length map leaves.
constexpr float shortest = 0.02f;

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& otherwise) {
    const float length = glm::length(v);
    return length > 1e-9f ? v / length : otherwise;
}

/// Radius of the tightest bend, in lengths of the hair.
constexpr float tightestBend = 0.25f;
/// Cosine of the angle from which on the field is against the hair: behind a point or line that it leads to.
constexpr float against = -0.2f;
/// Cosine of the angle from which on skin beyond the growing area stands in the hair's way.
constexpr float wall = 0.4f;

glm::vec3 onSkin(const glm::vec3& v, const glm::vec3& normal) {
    return v - normal * glm::dot(normal, v);
}

/// Unit vector `from` turned to unit vector `to`, but by `most` radians at most.
glm::vec3 towards(const glm::vec3& from, const glm::vec3& to, float most) {
    const float cosine = glm::dot(from, to);
    const glm::vec3 across = to - from * cosine;
    const float sine = glm::length(across);
    if (!(sine > 1e-3f)) return from;
    const float turn = std::min(std::atan2(sine, cosine), most);
    return from * std::cos(turn) + across * (std::sin(turn) / sine);
}

/// One hair on its way over the skin.
class Grower {
public:
    Grower(const Surface& surface, const SkinClearance& skin, const DirectionField& field, const GrowAlong& options)
        : m_surface(surface), m_field(field), m_options(options), m_walk{skin} {}

    /// The points of a hair; empty where the field has no direction at its root.
    std::vector<glm::vec3> grow(const SurfacePoint& root, std::size_t count, float length) {
        m_along = m_field.at(root);
        if (m_along == glm::vec3(0.0f) || count < 2 || !(length > 0.0f)) return {};
        const SurfaceMesh& mesh = m_surface.mesh();
        m_up = normalAt(mesh, root);
        m_under = root;
        m_step = length / static_cast<float>(count - 1);
        m_mostTurn = m_step / (tightestBend * length);
        std::vector<glm::vec3> points{positionAt(mesh, root)};
        for (std::size_t k = 1; k < count; ++k) {
            const float t = (static_cast<float>(k) - 0.5f) / static_cast<float>(count - 1);
            const glm::vec3 from = points.back();
            // The direction is that half way along the segment.
            follow(from + heading(t) * (0.5f * m_step));
            keepSide(from, t);
            points.push_back(placeNext(m_walk, from, from + heading(t) * m_step, m_along, m_step));
        }
        return points;
    }

private:
    /// Where the hair goes after that share of its length; unit.
    glm::vec3 heading(float t) const {
        // The angle to the skin falls from root to tip and ends lying on it.
        const float lift = glm::clamp(m_options.lift, 0.0f, 1.0f);
        const float angle = lift * (1.0f - t) * (1.0f - t) * std::numbers::pi_v<float> * 0.5f;
        return unitOr(m_along * std::cos(angle) + m_up * std::sin(angle) + m_options.down * (m_options.bend * t * t),
                      m_along);
    }

    /// Takes on the direction of the skin under `place`.
    void follow(const glm::vec3& place) {
        const auto hit = m_surface.query.nearest(place);
        if (!hit || m_field.parted(m_under, hit->point)) return;
        const glm::vec3 normal = normalAt(m_surface.mesh(), hit->point);
        const glm::vec3 here = m_field.at(hit->point);
        if (here == glm::vec3(0.0f)) {
            leave(normal);
        } else {
            m_along = turned(unitOr(onSkin(minimalRotation(m_up, normal) * m_along, normal), m_along), here, normal);
            m_up = normal;
        }
    }

    /// Goes on over skin where nothing grows.
    void leave(const glm::vec3& normal) {
        const float into = -glm::dot(m_along, normal);
        if (into > wall) {
            // Such as the back of an ear: hair slides off downward.
            m_along = towards(m_along, unitOr(onSkin(m_along + m_options.down, normal), m_along), 2.0f * m_mostTurn);
            return;
        }
        const glm::vec3 carried = unitOr(onSkin(minimalRotation(m_up, normal) * m_along, normal), m_along);
        // Hair does not creep back under what it has left, such as a chin, nor stand off behind it.
        if (glm::dot(carried, m_options.down) > glm::dot(m_along, m_options.down) - 1e-3f) m_along = carried;
        m_up = normal;
        if (m_options.down != glm::vec3(0.0f)) m_along = towards(m_along, m_options.down, 0.5f * m_mostTurn);
    }

    /// Turns towards `wanted`, both along the skin, by no more than a hair bends.
    glm::vec3 turned(const glm::vec3& from, const glm::vec3& wanted, const glm::vec3& normal) const {
        const float cosine = glm::dot(from, wanted);
        if (cosine < against) return from;
        const float angle = std::atan2(glm::dot(normal, glm::cross(from, wanted)), cosine);
        const float turn = glm::clamp(angle, -m_mostTurn, m_mostTurn);
        return from * std::cos(turn) + glm::cross(normal, from) * std::sin(turn);
    }

    /// Turns the hair just so far that its next point stays on its side of a parting.
    void keepSide(const glm::vec3& from, float t) {
        const glm::vec3 before = m_along, left = glm::cross(m_up, m_along);
        for (const float degrees :
             {0.0f, 15.0f, -15.0f, 30.0f, -30.0f, 50.0f, -50.0f, 70.0f, -70.0f, 90.0f, -90.0f, 120.0f, -120.0f}) {
            const float turn = degrees * std::numbers::pi_v<float> / 180.0f;
            m_along = before * std::cos(turn) + left * std::sin(turn);
            const auto hit = m_surface.query.nearest(from + heading(t) * m_step);
            if (!hit || m_field.parted(m_under, hit->point)) continue;
            m_under = hit->point;
            return;
        }
        m_along = before;
    }

    const Surface& m_surface;
    const DirectionField& m_field;
    const GrowAlong& m_options;
    SkinWalk m_walk;
    SurfacePoint m_under;  // the skin nearest to the last point
    glm::vec3 m_along{0.0f}, m_up{0.0f};
    float m_step = 0.0f;
    float m_mostTurn = 0.0f;  // a segment, radians
};

}  // namespace

GrowAlong growAlong(const FieldParams& params) {
    const float pull = glm::length(params.gravity.value);
    return {.length = params.length.value,
            .lengthMap = params.length.map,
            .lift = params.lift,
            .bend = params.bend,
            .down = pull > 0.0f ? params.gravity.value / pull : glm::vec3(0.0f)};
}

Result<void> growGuidesAlong(Groom& groom, const Surface& surface, const DirectionField& field,
                             const GrowAlong& options, Progress& progress) {
    const std::size_t count = groom.guides.count();
    std::vector<std::vector<glm::vec3>> shapes(count);
    const SkinClearance skin = SkinClearance::of(surface);
    const Map* lengths = options.lengthMap.empty() ? nullptr : groom.maps.find(options.lengthMap);
    parallelFor(count, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !progress.cancelled(); ++i) {
            if (options.group >= 0 && groom.guides.group(i) != options.group) continue;
            const auto points = groom.guides.points(i);
            const SurfacePoint root = groom.guides.root(i);
            float length = options.length > 0.0f ? options.length : curveLength(points);
            // A guide keeps a direction even where the map is black.
            if (options.length > 0.0f && lengths && !lengths->empty())
                length *= std::max(lengths->sample(uvAt(surface.mesh(), root)), shortest);
            shapes[i] = Grower(surface, skin, field, options).grow(root, points.size(), length);
        }
    });
    if (progress.cancelled()) return cancelledError();
    for (std::size_t i = 0; i < count; ++i) {
        if (!shapes[i].empty()) groom.guides.setPoints(i, shapes[i]);
    }
    return {};
}

std::vector<FieldStroke> strokesFromGuides(const Groom& groom, const Surface& surface, int group) {
    const std::size_t count = groom.guides.count();
    std::vector<FieldStroke> all(count);
    parallelFor(count, 32, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (group >= 0 && groom.guides.group(i) != group) continue;
            std::vector<SurfacePoint>& line = all[i].points;
            line.push_back(groom.guides.root(i));
            const glm::vec3 root = positionAt(surface.mesh(), line.front());
            for (const glm::vec3& point : groom.guides.points(i).subspan(1)) {
                const auto hit = surface.query.nearest(point);
                // Only the part that lies near the skin says how hair lies there.
                if (!hit || hit->distance > 2.0f * glm::distance(root, hit->position)) break;
                line.push_back(hit->point);
            }
        }
    });
    std::erase_if(all, [](const FieldStroke& stroke) { return stroke.points.size() < 2; });
    return all;
}

}  // namespace whorl
