// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

/// Signed distance building blocks: negative inside, metres.
namespace whorl::samples::sdf {

using glm::vec2;
using glm::vec3;

/// Union whose crease is rounded over a band of width k.
inline float smoothMin(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}

inline float smoothMax(float a, float b, float k) {
    return -smoothMin(-a, -b, k);
}

/// Removes shape b from shape a, with a rounded rim.
inline float carve(float a, float b, float k) {
    return smoothMax(a, -b, k);
}

inline float smoothstep(float lo, float hi, float x) {
    const float t = std::clamp((x - lo) / (hi - lo), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

inline float gauss(float x, float sigma) {
    return std::exp(-0.5f * x * x / (sigma * sigma));
}

/// First-order distance to an axis-aligned ellipsoid; exact on the surface.
inline float ellipsoid(const vec3& p, const vec3& centre, const vec3& radii) {
    const vec3 q = p - centre;
    const float k0 = glm::length(q / radii);
    const float k1 = glm::length(q / (radii * radii));
    return k1 < 1e-6f ? -std::min({radii.x, radii.y, radii.z}) : k0 * (k0 - 1.0f) / k1;
}

inline float sphere(const vec3& p, const vec3& centre, float radius) {
    return glm::length(p - centre) - radius;
}

/// Rotations of a point about a pivot, in radians; they place a primitive by turning space the other way.
inline vec3 turnX(const vec3& p, const vec3& pivot, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    const vec3 q = p - pivot;
    return pivot + vec3(q.x, c * q.y + s * q.z, -s * q.y + c * q.z);
}

inline vec3 turnY(const vec3& p, const vec3& pivot, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    const vec3 q = p - pivot;
    return pivot + vec3(c * q.x - s * q.z, q.y, s * q.x + c * q.z);
}

inline vec3 turnZ(const vec3& p, const vec3& pivot, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    const vec3 q = p - pivot;
    return pivot + vec3(c * q.x + s * q.y, -s * q.x + c * q.y, q.z);
}

/// Capsule whose radius changes linearly along its length.
inline float taper(const vec3& p, const vec3& a, float ra, const vec3& b, float rb) {
    const vec3 ab = b - a;
    const float t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f);
    return glm::length(p - a - ab * t) - (ra + (rb - ra) * t);
}

struct TubePoint {
    vec3 centre;
    float radius;
};

/// Smooth tube through a few control points (Catmull-Rom, refined once at construction).
class Tube {
public:
    explicit Tube(const std::vector<TubePoint>& control, int steps = 6) {
        const int n = static_cast<int>(control.size());
        for (int i = 0; i + 1 < n; ++i) {
            const TubePoint& a = control[std::max(i - 1, 0)];
            const TubePoint& b = control[i];
            const TubePoint& c = control[i + 1];
            const TubePoint& d = control[std::min(i + 2, n - 1)];
            for (int s = 0; s < steps; ++s) {
                const float t = static_cast<float>(s) / static_cast<float>(steps);
                m_points.push_back({spline(a.centre, b.centre, c.centre, d.centre, t),
                                    spline(a.radius, b.radius, c.radius, d.radius, t)});
            }
        }
        m_points.push_back(control.back());
        m_lo = m_hi = m_points.front().centre;
        for (const TubePoint& q : m_points) {
            m_lo = glm::min(m_lo, q.centre - q.radius);
            m_hi = glm::max(m_hi, q.centre + q.radius);
        }
    }

    /// Distance to the tube. Farther than `reach` from its bounds, the cheap distance to the bounds is given.
    float distance(const vec3& p, float reach) const {
        const float box = glm::length(glm::max(glm::max(m_lo - p, p - m_hi), vec3(0.0f)));
        if (box > reach) {
            return box;
        }
        float best = 1e9f;
        for (size_t i = 0; i + 1 < m_points.size(); ++i) {
            best = std::min(
                best, taper(p, m_points[i].centre, m_points[i].radius, m_points[i + 1].centre, m_points[i + 1].radius));
        }
        return best;
    }

    /// Nearest point of the middle line, and in w how far along the tube it is (0..1).
    glm::vec4 nearest(const vec3& p) const {
        float best = 1e9f;
        glm::vec4 result(0.0f);
        for (size_t i = 0; i + 1 < m_points.size(); ++i) {
            const vec3 a = m_points[i].centre, ab = m_points[i + 1].centre - a;
            const float t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f);
            const float d = glm::distance(p, a + ab * t);
            if (d < best) {
                best = d;
                result = glm::vec4(a + ab * t, (float(i) + t) / float(m_points.size() - 1));
            }
        }
        return result;
    }

private:
    template <typename T>
    static T spline(const T& a, const T& b, const T& c, const T& d, float t) {
        return 0.5f * (2.0f * b + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * (t * t) +
                       (3.0f * b - a - 3.0f * c + d) * (t * t * t));
    }

    std::vector<TubePoint> m_points;
    vec3 m_lo{0.0f}, m_hi{0.0f};
};

}  // namespace whorl::samples::sdf
