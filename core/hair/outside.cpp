// SPDX-License-Identifier: Apache-2.0
#include "core/hair/outside.h"

#include "core/hair/outside.kernel.h"

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
// A long way to beyond this may lead through the whole band.
constexpr float wholeBand = 0.9f;

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

SkinGuard::SkinGuard(std::shared_ptr<const DistanceField> skin)
    : m_skin(std::move(skin)), m_clearance(0.25f * m_skin->spacing()) {}

// True when the way from a vertex that is `distanceFrom` away from the skin to one that is `distanceTo` goes deep into
// it.
bool SkinGuard::dives(const glm::vec3& from, float distanceFrom, const glm::vec3& to, float distanceTo) const {
    const float band = m_skin->band();
    if (distanceTo < -deepBands * band) return true;
    // Through the whole band, into what looks like far outside: only then is there something to find in between.
    const glm::vec3 step = to - from;
    const float reach = distanceFrom + wholeBand * band;
    if (distanceTo < wholeBand * band || glm::dot(step, step) < reach * reach) return false;
    const int pieces = piecesOf(*m_skin, step);
    for (int i = 1; i < pieces; ++i)
        if (m_skin->distance(from + step * (static_cast<float>(i) / static_cast<float>(pieces))) < -passingBands * band)
            return true;
    return false;
}

void SkinGuard::findStarts(const float* x, const float* y, const float* z, std::span<const float> ease,
                           std::size_t vertices, Start (&starts)[lanes]) const {
    int first[lanes];
    float awayBefore[lanes];
    const float band = m_skin->band();
    WHORL_PICK(freeOfSkin)
    ({m_skin->arrays(), x, y, z, vertices, ease.data(), m_clearance, deepBands * band, wholeBand * band, first,
      awayBefore});
    for (std::size_t l = 0; l < lanes; ++l) starts[l] = {static_cast<std::size_t>(first[l]), awayBefore[l]};
}

void SkinGuard::keepFrom(Start start, std::span<glm::vec3> points, std::span<const float> ease) const {
    const DistanceField& skin = *m_skin;
    bool diverted = false;
    float awayBefore = start.awayBefore;
    glm::vec3 wishedBefore = points[start.first - 1];
    for (std::size_t v = start.first; v < points.size(); ++v) {
        const glm::vec3 wished = points[v];
        const glm::vec3 before = points[v - 1];
        const glm::vec3 step = wished - wishedBefore;
        wishedBefore = wished;
        glm::vec3 p = diverted ? before + step : wished;
        DistanceField::Sample here = skin.sample(p);
        if (dives(before, awayBefore, p, here.distance())) {
            diverted = true;
            const glm::vec3 out = skin.gradient(before);
            const glm::vec3 along = step - out * std::min(0.0f, glm::dot(step, out));
            p = before + along;
            here = skin.sample(p);
            if (dives(before, awayBefore, p, here.distance())) {
                p = lastOutside(skin, before, along);
                here = skin.sample(p);
            }
        }
        float away = here.distance();
        const float clearance = m_clearance * ease[v];
        if (away < 2.0f * clearance || away < 0.0f) {
            const float target = clearance > 0.0f ? smoothMax(away, clearance, clearance) : 0.0f;
            // The field is not quite linear: a second step reaches what the first one missed. Near the skin the way
            // out is the same at both; from deep inside it has to be asked for again, and more often. The number of
            // steps does not depend on what they reach, so that hair does not jump where a limit is crossed.
            const int steps = away < -clearance ? 4 : 2;
            glm::vec3 out = here.gradient();
            p += out * (target - away);
            for (int i = 1; i < steps; ++i) {
                here = skin.sample(p);
                if (steps > 2) out = here.gradient();
                p += out * (target - here.distance());
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
