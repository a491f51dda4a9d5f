// SPDX-License-Identifier: Apache-2.0
#include "core/hair/outside.h"

#include "core/base/parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

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

// How deep counts as a dive, in bands: pushing straight out is no answer any more. Meshes that are open (a head without
// a neck's floor) have no inside beyond the band, so a dive has to be seen on its way through the band.
constexpr float deepBands = 0.6f;
constexpr float passingBands = 0.3f;

// Pieces that `step` is looked at in: one of them ends in the band below passingBands if the step goes through it.
int piecesOf(const DistanceField& skin, const glm::vec3& step) {
    const float longest = (1.0f - passingBands) * skin.band();
    return std::clamp(static_cast<int>(glm::length(step) / longest) + 1, 1, 64);
}

// Where the way from `from` along `step` first meets the skin, still outside; `from` itself when it is inside.
glm::vec3 lastOutside(const DistanceField& skin, const glm::vec3& from, const glm::vec3& step) {
    const int pieces = piecesOf(skin, step);
    float out = 0.0f, in = 1.0f;
    for (int i = 1; i < pieces; ++i) {
        const float at = static_cast<float>(i) / static_cast<float>(pieces);
        if (skin.distance(from + step * at) <= 0.0f) {
            in = at;
            break;
        }
        out = at;
    }
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
    const float least = 2.0f * m_clearance + skin.spacing() * (0.8661f * cellSpacings + 1.75f);
    if (m_surface->bounds.empty() || !(cell > 0.0f) || least > skin.band()) return;
    m_origin = m_surface->bounds.min - glm::vec3(skin.band());
    m_cellsPerMetre = 1.0f / cell;
    std::size_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const float length = m_surface->bounds.size()[axis] + 2.0f * skin.band();
        m_size[axis] = static_cast<int>(length / cell) + 1;
        cells *= static_cast<std::size_t>(m_size[axis]);
    }
    const std::size_t row = static_cast<std::size_t>(m_size[0]), rows = static_cast<std::size_t>(m_size[1]);
    const auto size = glm::ivec3(m_size[0], m_size[1], m_size[2]);
    enum : std::uint8_t { Inside, Near, Far };
    std::vector<std::uint8_t> kinds(cells);
    parallelFor(cells / row, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
            const auto y = static_cast<float>(r % rows), z = static_cast<float>(r / rows);
            for (std::size_t x = 0; x < row; ++x) {
                const glm::vec3 middle = m_origin + (glm::vec3(static_cast<float>(x), y, z) + 0.5f) * cell;
                const float distance = skin.distance(middle);
                kinds[r * row + x] = distance < 0.0f ? Inside : distance < least ? Near : Far;
            }
        }
    });
    // Inside an open mesh the field goes from deep inside to far outside at once: a far cell next
    // to an inside one may hold both.
    m_far.resize(cells);
    const auto insideAround = [&](const glm::ivec3& at) {
        const glm::ivec3 first = glm::max(at - 1, glm::ivec3(0)), last = glm::min(at + 1, size - 1);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x)
                    if (kinds[static_cast<std::size_t>((z * size.y + y) * size.x + x)] == Inside) return true;
        return false;
    };
    parallelFor(cells / row, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r)
            for (std::size_t x = 0; x < row; ++x)
                m_far[r * row + x] = kinds[r * row + x] == Far && !insideAround({x, r % rows, r / rows});
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

float SkinGuard::distance(const glm::vec3& p) const {
    return certainlyFar(p) ? m_surface->skin().band() : m_surface->skin().distance(p);
}

// True when the way from a vertex that is `distanceFrom` away from the skin to one that is `distanceTo` goes deep into
// it.
bool SkinGuard::dives(const glm::vec3& from, float distanceFrom, const glm::vec3& to, float distanceTo) const {
    const float band = m_surface->skin().band();
    if (distanceTo < -deepBands * band) return true;
    // Through the whole band, into what looks like far outside: only then is there something to find in between.
    constexpr float wholeBand = 0.9f;
    const glm::vec3 step = to - from;
    const float reach = distanceFrom + wholeBand * band;
    if (distanceTo < wholeBand * band || glm::dot(step, step) < reach * reach) return false;
    const int pieces = piecesOf(m_surface->skin(), step);
    for (int i = 1; i < pieces; ++i)
        if (distance(from + step * (static_cast<float>(i) / static_cast<float>(pieces))) < -passingBands * band)
            return true;
    return false;
}

void SkinGuard::keepOutside(std::span<glm::vec3> points, std::span<const float> ease) const {
    const DistanceField& skin = m_surface->skin();
    bool diverted = false;
    float awayBefore = 0.0f;
    glm::vec3 wishedBefore = points[0];
    for (std::size_t v = 1; v < points.size(); ++v) {
        const glm::vec3 wished = points[v];
        const glm::vec3 before = points[v - 1];
        const glm::vec3 step = wished - wishedBefore;
        wishedBefore = wished;
        glm::vec3 p = diverted ? before + step : wished;
        float away = distance(p);
        if (dives(before, awayBefore, p, away)) {
            diverted = true;
            const glm::vec3 out = skin.gradient(before);
            const glm::vec3 along = step - out * std::min(0.0f, glm::dot(step, out));
            p = before + along;
            away = distance(p);
            if (dives(before, awayBefore, p, away)) {
                p = lastOutside(skin, before, along);
                away = distance(p);
            }
        }
        const float clearance = m_clearance * ease[v];
        if (away < 2.0f * clearance || away < 0.0f) {
            const float target = clearance > 0.0f ? smoothMax(away, clearance, clearance) : 0.0f;
            // The field is not quite linear: a second step reaches what the first one missed. Near the skin the way
            // out is the same at both; from deep inside it has to be asked for again, and more often. The number of
            // steps does not depend on what they reach, so that hair does not jump where a limit is crossed.
            const int steps = away < -clearance ? 4 : 2;
            glm::vec3 out(0.0f);
            for (int i = 0; i < steps; ++i) {
                if (i > 0) away = skin.distance(p);
                if (i == 0 || steps > 2) out = skin.gradient(p);
                p += out * (target - away);
            }
            // Where the field has no clear way out, the hair stops at the skin.
            if (steps > 2 && skin.distance(p) < 0.0f) p = lastOutside(skin, before, p - before);
            away = target;
        }
        points[v] = p;
        awayBefore = away;
    }
}

}  // namespace whorl
