// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/screen.h"

#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

namespace whorl {
namespace {

/// Position in groom space of a pixel at depth `z` of the clip box (-1 near, 1 far).
glm::dvec3 unproject(const StrokeView& view, glm::vec2 pixel, double z) {
    const glm::dmat4 groomFromClip = glm::inverse(glm::dmat4(view.clipFromGroom));
    const glm::dvec4 clip(2.0 * static_cast<double>(pixel.x / view.viewportPixels.x) - 1.0,
                          1.0 - 2.0 * static_cast<double>(pixel.y / view.viewportPixels.y), z, 1.0);
    const glm::dvec4 p = groomFromClip * clip;
    return glm::dvec3(p) / p.w;
}

bool hasPerspective(const StrokeView& view) {
    const glm::vec4 row = glm::row(view.clipFromGroom, 3);
    return row.x != 0.0f || row.y != 0.0f || row.z != 0.0f;
}

glm::vec3 normalizedOr(const glm::vec3& v, const glm::vec3& other) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : other;
}

}  // namespace

std::optional<glm::vec2> StrokeView::pixelFromGroom(const glm::vec3& point) const {
    const ScreenFrame frame(*this);
    const float depth = frame.depth(point);
    if (!frame.visible(depth)) return std::nullopt;
    return frame.pixel(point, depth);
}

glm::vec3 StrokeView::rayDirection(glm::vec2 pixel) const {
    const glm::dvec3 far = unproject(*this, pixel, 1.0);
    const glm::dvec3 from = hasPerspective(*this) ? glm::dvec3(eyeGroom) : unproject(*this, pixel, -1.0);
    return normalizedOr(glm::vec3(glm::normalize(far - from)), glm::vec3(0.0f, 0.0f, -1.0f));
}

glm::vec3 StrokeView::rayOrigin(glm::vec2 pixel) const {
    return hasPerspective(*this) ? eyeGroom : glm::vec3(unproject(*this, pixel, -1.0));
}

float StrokeView::metresPerPixel(const glm::vec3& point) const {
    const ScreenFrame frame(*this);
    return frame.metresPerPixel(std::max(frame.depth(point), 0.0f));
}

ScreenFrame::ScreenFrame(const StrokeView& view) : m_halfViewport(view.viewportPixels * 0.5f) {
    const glm::vec4 x = glm::row(view.clipFromGroom, 0) * m_halfViewport.x;
    const glm::vec4 y = glm::row(view.clipFromGroom, 1) * -m_halfViewport.y;
    const glm::vec4 w = glm::row(view.clipFromGroom, 3);
    m_right = glm::vec3(x);
    m_rightOffset = x.w;
    m_down = glm::vec3(y);
    m_downOffset = y.w;
    m_depth = glm::vec3(w);
    m_depthOffset = w.w;
    m_depthSlope = glm::length(m_depth);
    // Directions across the view: what is left of the rows without their part along the view (off-centre pictures).
    const glm::vec3 forward = m_depthSlope > 0.0f ? m_depth / m_depthSlope : glm::vec3(0.0f);
    const glm::vec3 right = m_right - forward * glm::dot(m_right, forward);
    const glm::vec3 down = m_down - forward * glm::dot(m_down, forward);
    const float rightSquared = glm::dot(right, right), downSquared = glm::dot(down, down);
    m_movementRight = rightSquared > 0.0f ? right / rightSquared : glm::vec3(0.0f);
    m_movementDown = downSquared > 0.0f ? down / downSquared : glm::vec3(0.0f);
    m_metresPerPixel = downSquared > 0.0f ? 1.0f / std::sqrt(downSquared) : 0.0f;
}

bool ScreenFrame::ballMayTouch(const glm::vec3& ball, float ballRadius, glm::vec2 centre, float radius) const {
    const float depthHere = depth(ball);
    const float nearest = depthHere - ballRadius * m_depthSlope;
    if (nearest <= 1e-6f) return depthHere + ballRadius * m_depthSlope > 0.0f;
    // With q = ball + e: pixel(q) - pixel(ball) = (m_right - offset m_depth) . e / depth(q), so this is a true bound.
    const glm::vec2 offset = pixel(ball, depthHere) - m_halfViewport;
    const float reach = ballRadius * 1.0001f / nearest;
    const float reachX = glm::length(m_right - m_depth * offset.x) * reach + 0.01f;
    const float reachY = glm::length(m_down - m_depth * offset.y) * reach + 0.01f;
    const glm::vec2 away = glm::abs(offset + m_halfViewport - centre) - glm::vec2(reachX, reachY);
    const glm::vec2 outside = glm::max(away, glm::vec2(0.0f));
    return glm::dot(outside, outside) <= radius * radius;
}

bool BrushArea::mayTouch(const glm::vec3& ball, float ballRadius) const {
    if (reach == Reach::Spherical) {
        const float limit = (radius + ballRadius) * 1.0001f;
        const glm::vec3 away = ball - centre;
        return glm::dot(away, away) <= limit * limit;
    }
    return frame.ballMayTouch(ball, ballRadius, pixel, radiusPixels);
}

}  // namespace whorl
