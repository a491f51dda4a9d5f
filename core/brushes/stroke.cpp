// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/stroke_scratch.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

// Centres of steps are multiples of 1/16 pixel and pressures of 1/4096, so that rounding on the way along the path can
// not make two strokes differ that were cut into events differently.
glm::vec2 onGrid(glm::dvec2 pixel) {
    return glm::vec2(glm::round(pixel * 16.0) / 16.0);
}
float pressureOnGrid(double pressure) {
    return static_cast<float>(std::round(std::clamp(pressure, 0.0, 1.0) * 4096.0) / 4096.0);
}

StrokeView mirrorImage(const StrokeView& view) {
    // The mirrored eye sees the mirrored point at the same pixel: only the matrix and the eye change.
    StrokeView mirrored = view;
    mirrored.clipFromGroom[0] = -mirrored.clipFromGroom[0];
    mirrored.eyeGroom.x = -mirrored.eyeGroom.x;
    return mirrored;
}

bool isFinite(const StrokePoint& point) {
    return std::isfinite(point.pixel.x) && std::isfinite(point.pixel.y) && std::abs(point.pixel.x) < 1e6f &&
           std::abs(point.pixel.y) < 1e6f && std::isfinite(point.pressure);
}

}  // namespace

Result<Stroke> Stroke::begin(const BrushInfo& brush, Groom groom, std::shared_ptr<const Surface> surface,
                             const StrokeView& view, const BrushSettings& settings) {
    Stroke stroke;
    stroke.m_info = &brush;
    stroke.m_settings = settings;
    stroke.m_settings.radiusPixels = std::clamp(settings.radiusPixels, 1.0f, 2000.0f);
    stroke.m_settings.strength = std::clamp(settings.strength, 0.0f, 1.0f);
    stroke.m_settings.value = std::clamp(settings.value, 0.0f, 1.0f);
    stroke.m_brush = brush.make();
    if (auto begun = stroke.m_brush->begin(groom, stroke.m_settings); !begun) return begun.error();
    if (settings.mirrorX) {
        stroke.m_mirrorBrush = brush.make();
        if (auto begun = stroke.m_mirrorBrush->begin(groom, stroke.m_settings); !begun) return begun.error();
    }
    stroke.m_groom = std::move(groom);
    stroke.m_surface = std::move(surface);
    stroke.m_view = view;
    stroke.m_mirrorView = mirrorImage(view);
    stroke.m_scratch = std::make_shared<StrokeScratch>();
    return stroke;
}

bool Stroke::moveTo(const StrokePoint& point) {
    if (!isFinite(point)) return false;
    const double spacing = static_cast<double>(std::max(1.0f, m_info->spacing * m_settings.radiusPixels));
    if (!m_last) {
        m_last = point;
        m_lastStep = onGrid(glm::dvec2(point.pixel));
        m_distanceToNext = spacing;
        return stepAt(m_lastStep, m_lastStep, pressureOnGrid(static_cast<double>(point.pressure)));
    }
    const glm::dvec2 from(m_last->pixel), way = glm::dvec2(point.pixel) - from;
    const double length = glm::length(way);
    bool changed = false;
    double at = m_distanceToNext;
    // The tolerance lets a step that falls on an event be taken there, however the distance was summed up.
    for (; at <= length + 1e-6; at += spacing) {
        const double t = length > 0.0 ? std::min(at / length, 1.0) : 1.0;
        const glm::vec2 pixel = onGrid(from + way * t);
        const double pressure =
            static_cast<double>(m_last->pressure) + static_cast<double>(point.pressure - m_last->pressure) * t;
        changed |= stepAt(m_lastStep, pixel, pressureOnGrid(pressure));
        m_lastStep = pixel;
    }
    m_distanceToNext = std::max(at - length, 0.0);
    m_last = point;
    return changed;
}

bool Stroke::stepAt(glm::vec2 previous, glm::vec2 pixel, float pressure) {
    bool changed = stepOn(*m_brush, m_view, false, previous, pixel, pressure);
    if (m_mirrorBrush) changed |= stepOn(*m_mirrorBrush, m_mirrorView, true, previous, pixel, pressure);
    return changed;
}

bool Stroke::stepOn(Brush& brush, const StrokeView& view, bool mirrored, glm::vec2 previous, glm::vec2 pixel,
                    float pressure) {
    BrushStep step{.groom = m_groom, .surface = *m_surface, .view = view, .settings = m_settings};
    step.pixel = pixel;
    step.previousPixel = previous;
    step.hit = m_surface->query.raycast(view.rayOrigin(pixel), view.rayDirection(pixel));
    step.radiusPixels = m_settings.radiusPixels * (m_settings.pressureSize ? std::max(pressure, 0.01f) : 1.0f);
    step.strength = m_settings.strength * (m_settings.pressureStrength ? pressure : 1.0f);
    step.mirrored = mirrored;
    step.scratch = m_scratch.get();
    brush.step(step);
    return step.changed;
}

Groom Stroke::finish() {
    m_brush->end(m_groom, *m_surface, m_settings);
    if (m_mirrorBrush) m_mirrorBrush->end(m_groom, *m_surface, m_settings);
    return std::move(m_groom);
}

}  // namespace whorl
