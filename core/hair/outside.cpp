// SPDX-License-Identifier: Apache-2.0
#include "core/hair/outside.h"

#include "core/base/parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace whorl {
namespace {

// The greater of both, rounded off where they are within `width` of each other.
float smoothMax(float a, float b, float width) {
    const float over = a - b;
    if (over >= width) return a;
    if (over <= -width) return b;
    return b + (over + width) * (over + width) / (4.0f * width);
}

// Where the way from `from`, which is outside, along `step` meets the skin.
glm::vec3 lastOutside(const DistanceField& skin, const glm::vec3& from, const glm::vec3& step) {
    float out = 0.0f, in = 1.0f;
    for (int i = 0; i < 8; ++i) {
        const float middle = (out + in) * 0.5f;
        (skin.distance(from + step * middle) > 0.0f ? out : in) = middle;
    }
    return from + step * out;
}

}  // namespace

SkinGuard::SkinGuard(std::shared_ptr<const Surface> surface) : m_surface(std::move(surface)) {
    const DistanceField& skin = m_surface->skin();
    m_clearance = 0.25f * skin.spacing();
    // What can lie between the distance at a cell's middle and that anywhere in it: half a diagonal, and what linear
    // interpolation is wrong by at both places.
    constexpr float cellSpacings = 3.0f;
    const float cell = cellSpacings * skin.spacing();
    const float far = 2.0f * m_clearance + skin.spacing() * (0.8661f * cellSpacings + 1.75f);
    if (m_surface->bounds.empty() || !(cell > 0.0f) || far > skin.band()) return;
    m_origin = m_surface->bounds.min - glm::vec3(skin.band());
    m_cellsPerMetre = 1.0f / cell;
    std::size_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const float length = m_surface->bounds.size()[axis] + 2.0f * skin.band();
        m_size[axis] = static_cast<int>(length / cell) + 1;
        cells *= static_cast<std::size_t>(m_size[axis]);
    }
    m_far.resize(cells);
    const std::size_t row = static_cast<std::size_t>(m_size[0]);
    parallelFor(cells / row, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
            const auto y = static_cast<float>(r % static_cast<std::size_t>(m_size[1]));
            const auto z = static_cast<float>(r / static_cast<std::size_t>(m_size[1]));
            for (std::size_t x = 0; x < row; ++x) {
                const glm::vec3 middle = m_origin + (glm::vec3(static_cast<float>(x), y, z) + 0.5f) * cell;
                m_far[r * row + x] = skin.distance(middle) >= far;
            }
        }
    });
}

bool SkinGuard::certainlyFar(const glm::vec3& p) const {
    const glm::vec3 q = (p - m_origin) * m_cellsPerMetre;
    std::size_t index = 0;
    for (int axis = 2; axis >= 0; --axis) {
        if (!(q[axis] >= 0.0f && q[axis] < static_cast<float>(m_size[axis]))) return !m_far.empty();
        index = index * static_cast<std::size_t>(m_size[axis]) + static_cast<std::size_t>(q[axis]);
    }
    return m_far[index] != 0;
}

void SkinGuard::keepOutside(std::span<glm::vec3> points, std::span<const float> ease) const {
    const DistanceField& skin = m_surface->skin();
    const float deep = -0.9f * skin.band();
    bool diverted = false;
    glm::vec3 wishedBefore = points[0];
    for (std::size_t v = 1; v < points.size(); ++v) {
        const glm::vec3 wished = points[v];
        const glm::vec3 before = points[v - 1];
        const glm::vec3 step = wished - wishedBefore;
        wishedBefore = wished;
        glm::vec3 p = diverted ? before + step : wished;
        if (certainlyFar(p)) {
            points[v] = p;
            continue;
        }
        float distance = skin.distance(p);
        if (distance < deep) {
            diverted = true;
            const glm::vec3 out = skin.gradient(before);
            const glm::vec3 along = step - out * std::min(0.0f, glm::dot(step, out));
            p = before + along;
            distance = skin.distance(p);
            if (distance < deep) {
                p = lastOutside(skin, before, along);
                distance = skin.distance(p);
            }
        }
        const float clearance = m_clearance * ease[v];
        if (distance < 2.0f * clearance || distance < 0.0f) {
            const float target = clearance > 0.0f ? smoothMax(distance, clearance, clearance) : 0.0f;
            // The field is not quite linear: a second step reaches what the first one missed. Near the skin the way
            // out is the same at both; from deep inside it has to be asked for again, and more often. The number of
            // steps does not depend on what they reach, so that hair does not jump where a limit is crossed.
            const int steps = distance < -clearance ? 4 : 2;
            glm::vec3 out(0.0f);
            for (int i = 0; i < steps; ++i) {
                if (i > 0) distance = skin.distance(p);
                if (i == 0 || steps > 2) out = skin.gradient(p);
                p += out * (target - distance);
            }
        }
        points[v] = p;
    }
}

}  // namespace whorl
