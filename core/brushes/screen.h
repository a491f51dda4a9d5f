// SPDX-License-Identifier: Apache-2.0
// The part of a stroke's view that a step asks thousands of times: pixels of points, and movements across the view.
#pragma once

#include "core/brushes/brush.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cmath>

namespace whorl {

/// Rows of the view's matrix, ready for use. Immutable; any thread may ask.
class ScreenFrame {
public:
    explicit ScreenFrame(const StrokeView& view);

    /// Depth along the view: above zero in front of the eye (always 1 without perspective).
    float depth(const glm::vec3& p) const { return glm::dot(m_depth, p) + m_depthOffset; }
    /// False for points at or behind the eye.
    bool visible(float depthOfPoint) const { return depthOfPoint > 1e-6f; }
    /// Pixel of a point at this depth.
    glm::vec2 pixel(const glm::vec3& p, float depthOfPoint) const {
        const float scale = 1.0f / depthOfPoint;
        return {m_halfViewport.x + (glm::dot(m_right, p) + m_rightOffset) * scale,
                m_halfViewport.y + (glm::dot(m_down, p) + m_downOffset) * scale};
    }
    /// The movement in the plane facing the camera that moves a point at this depth by `pixels`.
    glm::vec3 movement(glm::vec2 pixels, float depthOfPoint) const {
        return (m_movementRight * pixels.x + m_movementDown * pixels.y) * depthOfPoint;
    }
    /// Length of one pixel at this depth, metres.
    float metresPerPixel(float depthOfPoint) const { return m_metresPerPixel * depthOfPoint; }

    /// False only when no point of the ball can be in front of the eye and within `radius` pixels of `centre`.
    bool ballMayTouch(const glm::vec3& ball, float ballRadius, glm::vec2 centre, float radius) const;

private:
    glm::vec2 m_halfViewport;
    glm::vec3 m_right, m_down, m_depth;  // pixels are (m_right . p + offset) / depth + half the viewport
    float m_rightOffset, m_downOffset, m_depthOffset;
    glm::vec3 m_movementRight, m_movementDown;
    float m_metresPerPixel;
    float m_depthSlope;
};

/// The region of one step and how strongly the brush works there. Immutable; any thread may ask.
struct BrushArea {
    ScreenFrame frame;
    Reach reach = Reach::Projected;
    glm::vec2 pixel{0.0f};
    float radiusPixels = 1.0f;
    glm::vec3 centre{0.0f};  ///< Spherical only
    float radius = 0.0f;     ///< Spherical only, metres

    /// Distance of a point from the centre of the brush in radii; 1 or more is outside.
    float distanceInRadii(const glm::vec3& p) const {
        if (reach == Reach::Spherical) return glm::length(p - centre) / radius;
        const float depth = frame.depth(p);
        if (!frame.visible(depth)) return 2.0f;
        return glm::length(frame.pixel(p, depth) - pixel) / radiusPixels;
    }
    float weight(const glm::vec3& p) const { return brushFalloff(distanceInRadii(p)); }
    /// False only when no point of the ball has weight.
    bool mayTouch(const glm::vec3& ball, float ballRadius) const;
};

}  // namespace whorl
