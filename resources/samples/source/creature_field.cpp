// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/creature.h"
#include "resources/samples/source/sdf.h"

namespace whorl::samples {

using glm::vec3;
using sdf::carve;
using sdf::ellipsoid;
using sdf::gauss;
using sdf::smoothMax;
using sdf::smoothMin;
using sdf::smoothstep;
using sdf::taper;

const vec3 kCreatureEye(0.0330f, 0.2330f, 0.0700f);
const vec3 kCreatureNose(0.0f, 0.2150f, 0.1170f);

namespace {

constexpr float kEyeRadius = 0.0160f;
const vec3 kEarRoot(0.0420f, 0.2620f, 0.0060f);
const vec3 kEarTip(0.0690f, 0.3400f, -0.0020f);

// The head is modelled at one size and worn larger and lower: childlike proportions.
constexpr float kHeadScale = 1.13f;
const vec3 kHeadPivot(0.0f, 0.1850f, 0.0100f);
const vec3 kHeadShift(0.0f, -0.0160f, 0.0040f);

vec3 mirrored(const vec3& p) {
    return {std::abs(p.x), p.y, p.z};
}
vec3 softSide(const vec3& p, float radius) {
    return {std::sqrt(p.x * p.x + radius * radius), p.y, p.z};
}

const sdf::Tube& tailTube() {
    static const sdf::Tube tube({{{0.0f, 0.0420f, -0.0750f}, 0.0170f},
                                 {{0.0f, 0.0340f, -0.1150f}, 0.0220f},
                                 {{0.0f, 0.0500f, -0.1550f}, 0.0295f},
                                 {{0.0f, 0.0950f, -0.1800f}, 0.0345f},
                                 {{0.0f, 0.1450f, -0.1800f}, 0.0320f},
                                 {{0.0f, 0.1850f, -0.1620f}, 0.0210f},
                                 {{0.0f, 0.2080f, -0.1450f}, 0.0090f}},
                                14);
    return tube;
}

float headShape(const vec3& p) {
    const vec3 s = softSide(p, 0.006f);
    float d = ellipsoid(p, {0, 0.2280f, 0.0250f}, {0.0680f, 0.0560f, 0.0570f});
    d = smoothMin(d, ellipsoid(s, {0.0360f, 0.2060f, 0.0400f}, {0.0340f, 0.0260f, 0.0300f}), 0.030f);
    // Muzzle with its bridge, cheeks of the lip, and chin.
    d = smoothMin(d, taper(p, {0, 0.2280f, 0.0660f}, 0.0150f, {0, 0.2140f, 0.1020f}, 0.0130f), 0.022f);
    d = smoothMin(d, ellipsoid(p, {0, 0.2040f, 0.0820f}, {0.0300f, 0.0200f, 0.0330f}), 0.018f);
    d = smoothMin(d, ellipsoid(s, {0.0110f, 0.2010f, 0.0990f}, {0.0125f, 0.0110f, 0.0150f}), 0.010f);
    d = smoothMin(d, ellipsoid(p, {0, 0.1900f, 0.0850f}, {0.0150f, 0.0100f, 0.0220f}), 0.008f);
    return d;
}

float earShape(const vec3& p) {
    const float length = glm::distance(kEarTip, kEarRoot);
    const vec3 q = creatureEarFrame(p) * vec3(1.0f, length, 1.0f);
    // Widest low down, drawn out to a soft point.
    const float t = std::clamp(q.y / length, -0.3f, 1.0f);
    const float narrow = 1.0f - 0.34f * t * t;
    const vec3 shaped(q.x / narrow, q.y, q.z / narrow);
    return ellipsoid(shaped, {0, 0.40f * length, 0}, {0.0320f, 0.0560f, 0.0155f}) * narrow;
}

float earCup(const vec3& p) {
    const float length = glm::distance(kEarTip, kEarRoot);
    const vec3 q = creatureEarFrame(p) * vec3(1.0f, length, 1.0f);
    const float t = std::clamp(q.y / length, -0.3f, 1.0f);
    const float narrow = 1.0f - 0.36f * t * t;
    const vec3 shaped(q.x / narrow, q.y, q.z);
    return ellipsoid(shaped, {0, 0.46f * length, 0.0160f}, {0.0250f, 0.0420f, 0.0170f}) * narrow;
}

float trunkShape(const vec3& p) {
    float d = taper(p, {0, 0.1900f, 0.0020f}, 0.0420f, {0, 0.1250f, 0.0080f}, 0.0480f);
    d = smoothMin(d, ellipsoid(p, {0, 0.1320f, 0.0140f}, {0.0500f, 0.0560f, 0.0460f}), 0.020f);
    d = smoothMin(d, ellipsoid(p, {0, 0.0680f, -0.0340f}, {0.0640f, 0.0640f, 0.0620f}), 0.040f);
    return d;
}

float forelegShape(const vec3& p) {
    const float leg = taper(p, {0.0280f, 0.1300f, 0.0280f}, 0.0240f, {0.0290f, 0.0260f, 0.0480f}, 0.0160f);
    float paw = ellipsoid(p, {0.0290f, 0.0165f, 0.0580f}, {0.0190f, 0.0165f, 0.0260f});
    // Two grooves part three toes.
    const float front = smoothstep(0.0640f, 0.0800f, p.z);
    paw += 0.0022f * front * (gauss(p.x - 0.0230f, 0.0017f) + gauss(p.x - 0.0350f, 0.0017f));
    return smoothMin(leg, paw, 0.014f);
}

float thighShape(const vec3& p) {
    const vec3 q = sdf::turnX(p, {0.0510f, 0.0580f, -0.0330f}, -0.35f);
    return ellipsoid(q, {0.0510f, 0.0580f, -0.0330f}, {0.0320f, 0.0500f, 0.0420f});
}

float hindFootShape(const vec3& p) {
    float d = taper(p, {0.0640f, 0.0140f, -0.0150f}, 0.0140f, {0.0715f, 0.0140f, 0.0240f}, 0.0135f);
    d = smoothMin(d, ellipsoid(p, {0.0730f, 0.0160f, 0.0280f}, {0.0185f, 0.0165f, 0.0210f}), 0.012f);
    const float front = smoothstep(0.0300f, 0.0460f, p.z);
    d += 0.0020f * front * (gauss(p.x - 0.0690f, 0.0017f) + gauss(p.x - 0.0800f, 0.0017f));
    return d;
}

/// Depth of the mouth's groove: down from the nose, then out under the lips in a small smile.
float mouthGroove(const vec3& p) {
    const float x = std::abs(p.x);
    const float split = gauss(x, 0.0016f) * smoothstep(0.2100f, 0.2060f, p.y) * smoothstep(0.1905f, 0.1935f, p.y);
    const float curve = 0.1918f + 26.0f * (x - 0.0080f) * (x - 0.0080f);
    const float smile = gauss(p.y - curve, 0.0017f) * smoothstep(0.0290f, 0.0200f, x);
    return 0.0026f * std::max(split, smile) * smoothstep(0.0700f, 0.0850f, p.z);
}

/// Head with ears, opened for the eyes, in head space.
float fullHead(const vec3& p) {
    float d = headShape(p);
    if (p.y > 0.22f) {
        d = smoothMin(d, earShape(p), 0.016f);
        d = carve(d, earCup(p), 0.006f);
    }
    const vec3 eye = p - kCreatureEye;
    if (glm::dot(eye, eye) < 0.0012f) {
        // Lids swell over the eyeball and open on an almond.
        const vec3 gaze = glm::normalize(vec3(0.42f, 0.10f, 0.90f));
        d = smoothMin(d, glm::length(eye) - (kEyeRadius + 0.0020f), 0.008f);
        const float opening =
            ellipsoid(p, kCreatureEye + gaze * 0.0150f - vec3(0, 0.0016f, 0), {0.0140f, 0.0124f, 0.0120f});
        const float inside = glm::length(eye) - (kEyeRadius - 0.0016f);
        d = carve(d, smoothMax(opening, -inside, 0.002f), 0.0025f);
    }
    if (glm::distance(p, kCreatureNose) < 0.06f) {
        d += mouthGroove(p);
    }
    return d;
}

}  // namespace

vec3 creatureHeadSpace(const vec3& p) {
    return kHeadPivot + (p - kHeadShift - kHeadPivot) / kHeadScale;
}

vec3 creatureFromHead(const vec3& p) {
    return kHeadPivot + kHeadShift + (p - kHeadPivot) * kHeadScale;
}

vec3 creatureEarFrame(const vec3& point) {
    const vec3 along = glm::normalize(kEarTip - kEarRoot);
    const vec3 across = glm::normalize(glm::cross(along, vec3(0.38f, 0.0f, 0.92f)));
    const vec3 out = glm::cross(across, along);
    const vec3 q = mirrored(point) - kEarRoot;
    return {glm::dot(q, across), glm::dot(q, along) / glm::distance(kEarTip, kEarRoot), glm::dot(q, out)};
}

glm::vec4 creatureTailAxis(const vec3& p) {
    return tailTube().nearest(p);
}

CreatureMembers creatureMembers(const vec3& point) {
    const vec3 p = mirrored(point);
    const vec3 h = creatureHeadSpace(p);
    return {headShape(h) * kHeadScale, earShape(h) * kHeadScale,     trunkShape(p), forelegShape(p), thighShape(p),
            hindFootShape(p),          tailTube().distance(p, 0.03f)};
}

float creatureBody(const vec3& point) {
    const vec3 p = mirrored(point);
    float d = 1e9f;
    if (p.y < 0.25f) {
        d = trunkShape(p);
        d = smoothMin(d, forelegShape(p), 0.012f);
        d = smoothMin(d, smoothMin(thighShape(p), hindFootShape(p), 0.010f), 0.010f);
        d = smoothMin(d, tailTube().distance(p, 0.03f), 0.016f);
        d = smoothMax(d, -p.y, 0.006f);
    }
    if (p.y > 0.12f) {
        d = smoothMin(d, fullHead(creatureHeadSpace(p)) * kHeadScale, 0.024f);
    }
    return d;
}

float creatureEye(const vec3& p) {
    return sdf::sphere(creatureHeadSpace(mirrored(p)), kCreatureEye, kEyeRadius) * kHeadScale;
}

float creatureNose(const vec3& point) {
    const vec3 p = softSide(creatureHeadSpace(point), 0.0015f);
    float d = ellipsoid(p, kCreatureNose, {0.0130f, 0.0080f, 0.0085f});
    d = smoothMin(d, ellipsoid(p, kCreatureNose + vec3(0, -0.0045f, 0.0005f), {0.0060f, 0.0075f, 0.0070f}), 0.005f);
    const vec3 hole = kCreatureNose + vec3(0.0075f, -0.0035f, 0.0072f);
    return carve(d, ellipsoid(p, hole, {0.0034f, 0.0022f, 0.0040f}), 0.002f) * kHeadScale;
}

}  // namespace whorl::samples
