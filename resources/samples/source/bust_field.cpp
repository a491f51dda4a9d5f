// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/bust.h"
#include "resources/samples/source/ear.h"
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

namespace {

/// Features beside the mirror plane blend with their twin; rounding |x| there keeps the midline free of a crease.
vec3 softSide(const vec3& p, float radius) {
    return {std::sqrt(p.x * p.x + radius * radius), p.y, p.z};
}

float skull(const vec3& p) {
    float d = ellipsoid(p, {0, 0.3225f, -0.0230f}, {0.0755f, 0.0775f, 0.0830f});
    d = smoothMin(d, ellipsoid(p, {0, 0.3180f, 0.0170f}, {0.0640f, 0.0680f, 0.0690f}), 0.030f);
    // Back of the skull, down to the nape.
    d = smoothMin(d, ellipsoid(p, {0, 0.2850f, -0.0370f}, {0.0600f, 0.0560f, 0.0600f}), 0.030f);
    // Temples and the side of the head that carries the ear.
    d = smoothMin(d, ellipsoid(p, {0, 0.2680f, -0.0100f}, {0.0655f, 0.0460f, 0.0560f}), 0.025f);
    return d;
}

float face(const vec3& p, float d) {
    const vec3 s = softSide(p, 0.004f);
    d = smoothMin(d, ellipsoid(p, {0, 0.2580f, 0.0300f}, {0.0560f, 0.0560f, 0.0480f}), 0.020f);
    // Muzzle of the mouth, then jaw from chin to ear.
    d = smoothMin(d, ellipsoid(p, {0, 0.2160f, 0.0415f}, {0.0405f, 0.0390f, 0.0410f}), 0.020f);
    d = smoothMin(d, ellipsoid(p, {0, 0.2240f, 0.0160f}, {0.0530f, 0.0500f, 0.0500f}), 0.020f);
    const float jaw = std::min(taper(s, {0.0135f, 0.1850f, 0.0630f}, 0.0132f, {0.0435f, 0.2050f, 0.0120f}, 0.0100f),
                               taper(s, {0.0435f, 0.2050f, 0.0120f}, 0.0100f, {0.0585f, 0.2600f, -0.0020f}, 0.0100f));
    d = smoothMin(d, jaw, 0.018f);
    d = smoothMin(d, ellipsoid(p, {0, 0.1838f, 0.0668f}, {0.0185f, 0.0130f, 0.0150f}), 0.030f);
    d = smoothMin(d, ellipsoid(s, {0.0330f, 0.2330f, 0.0450f}, {0.0190f, 0.0240f, 0.0210f}), 0.030f);
    // Cheekbone and its arch towards the ear.
    const vec3 cheek = sdf::turnY(s, {0.0430f, 0.2600f, 0.0500f}, 0.75f);
    d = smoothMin(d, ellipsoid(cheek, {0.0430f, 0.2600f, 0.0500f}, {0.0210f, 0.0120f, 0.0125f}), 0.030f);
    d = smoothMin(d, taper(s, {0.0490f, 0.2620f, 0.0460f}, 0.0070f, {0.0605f, 0.2690f, 0.0080f}, 0.0055f), 0.018f);
    return d;
}

float brows(const vec3& p, float d) {
    const vec3 s = softSide(p, 0.004f);
    const float ridge = std::min(taper(s, {0.0100f, 0.3030f, 0.0790f}, 0.0055f, {0.0330f, 0.3070f, 0.0722f}, 0.0062f),
                                 taper(s, {0.0330f, 0.3070f, 0.0722f}, 0.0062f, {0.0505f, 0.2965f, 0.0500f}, 0.0045f));
    return smoothMin(d, ridge, 0.026f);
}

const vec3 kEye(0.0310f, 0.2838f, 0.0624f);

/// A point seen from the centre of the eyeball.
struct LidPoint {
    float yaw, pitch, radius;
    float aboveLash;  // radians above the line where the closed lids meet
};

LidPoint lidPoint(const vec3& p) {
    const vec3 q = p - kEye;
    LidPoint l;
    l.radius = std::max(glm::length(q), 1e-4f);
    l.yaw = std::atan2(q.x, std::max(q.z, 1e-4f));
    l.pitch = std::asin(std::clamp(q.y / l.radius, -1.0f, 1.0f));
    // The line hangs in a curve, its outer corner a little above the inner one.
    l.aboveLash = l.pitch - (-0.50f + 0.42f * l.yaw * l.yaw + 0.08f * l.yaw);
    return l;
}

float eyes(const vec3& p, float d) {
    // Socket: a wide hollow, deepest towards the nose.
    d = carve(d, ellipsoid(p, {0.0295f, 0.2855f, 0.0915f}, {0.0205f, 0.0115f, 0.0165f}), 0.014f);
    d = carve(d, ellipsoid(p, {0.0175f, 0.2850f, 0.0860f}, {0.0060f, 0.0085f, 0.0075f}), 0.012f);
    const LidPoint l = lidPoint(p);
    if (l.radius > 0.03f) {
        return d;
    }
    const float lids = smoothstep(1.25f, 0.85f, std::abs(l.yaw));
    float ball = l.radius - 0.0152f;
    ball -= 0.0010f * smoothstep(-0.05f, 0.06f, l.aboveLash) * lids;
    ball += 0.0008f * gauss(l.aboveLash + 0.07f, 0.07f) * lids;
    d = smoothMin(d, ball, 0.0045f + 0.0045f * smoothstep(-0.45f, -1.0f, l.yaw));
    // Fold of the upper lid.
    const float fold = 0.52f - 0.30f * l.yaw * l.yaw + 0.05f * l.yaw;
    d += 0.0012f * gauss(l.pitch - fold, 0.08f) * smoothstep(1.15f, 0.7f, std::abs(l.yaw)) *
         smoothstep(0.022f, 0.017f, l.radius);
    return d;
}

float nose(const vec3& p, float d) {
    if (glm::length(p - vec3(0, 0.262f, 0.09f)) > 0.06f) {
        return d;
    }
    const vec3 s = softSide(p, 0.0015f);
    float n = taper(p, {0, 0.2920f, 0.0790f}, 0.0060f, {0, 0.2495f, 0.0985f}, 0.0066f);
    n = smoothMin(n, ellipsoid(p, {0, 0.2462f, 0.1000f}, {0.0088f, 0.0080f, 0.0085f}), 0.008f);
    // Flanks that carry the ridge on the face.
    n = smoothMin(n, taper(s, {0.0070f, 0.2840f, 0.0690f}, 0.0060f, {0.0105f, 0.2480f, 0.0830f}, 0.0080f), 0.010f);
    d = smoothMin(d, n, 0.008f);
    const vec3 wing = sdf::turnY(s, {0.0125f, 0.2400f, 0.0890f}, 0.35f);
    d = smoothMin(d, ellipsoid(wing, {0.0114f, 0.2405f, 0.0875f}, {0.0062f, 0.0064f, 0.0092f}), 0.0085f);
    // Column between the nostrils, then the nostrils.
    d = smoothMin(d, taper(p, {0, 0.2425f, 0.0985f}, 0.0042f, {0, 0.2375f, 0.0850f}, 0.0042f), 0.006f);
    const vec3 hole = sdf::turnX(s, {0.0070f, 0.2345f, 0.0930f}, -0.35f);
    return carve(d, ellipsoid(hole, {0.0074f, 0.2345f, 0.0925f}, {0.0034f, 0.0058f, 0.0062f}), 0.0025f);
}

const sdf::Tube& upperLip() {
    static const sdf::Tube tube({{{0.0f, 0.2162f, 0.0830f}, 0.0054f},
                                 {{0.0060f, 0.2178f, 0.0820f}, 0.0054f},
                                 {{0.0140f, 0.2156f, 0.0776f}, 0.0044f},
                                 {{0.0235f, 0.2130f, 0.0690f}, 0.0020f}});
    return tube;
}

const sdf::Tube& lowerLip() {
    static const sdf::Tube tube({{{0.0f, 0.2066f, 0.0806f}, 0.0066f},
                                 {{0.0080f, 0.2070f, 0.0790f}, 0.0062f},
                                 {{0.0160f, 0.2090f, 0.0746f}, 0.0042f},
                                 {{0.0235f, 0.2124f, 0.0680f}, 0.0016f}});
    return tube;
}

/// Height at which the lips meet.
float mouthLine(float x) {
    return 0.2117f + 0.0006f * smoothstep(0.0f, 0.0055f, x) - 0.0006f * smoothstep(0.0060f, 0.0140f, x) +
           0.0012f * smoothstep(0.0140f, 0.0260f, x);
}

float mouth(const vec3& p, float d) {
    if (glm::length(p - vec3(0, 0.212f, 0.085f)) > 0.05f) {
        return d;
    }
    const vec3 s = softSide(p, 0.001f);
    d = smoothMin(d, upperLip().distance(s, 0.012f), 0.0030f);
    d = smoothMin(d, lowerLip().distance(s, 0.012f), 0.0040f);
    d += 0.0026f * gauss(p.y - mouthLine(p.x), 0.0010f) * smoothstep(0.0270f, 0.0200f, p.x);
    // Groove under the nose, hollow over the chin, corners of the mouth.
    d += 0.0011f * gauss(p.x, 0.0028f) * smoothstep(0.2350f, 0.2310f, p.y) * smoothstep(0.2180f, 0.2250f, p.y);
    d += 0.0030f * gauss(p.y - 0.1965f, 0.0052f) * gauss(p.x, 0.0130f);
    d += 0.0010f * gauss(p.x - 0.0265f, 0.0035f) * gauss(p.y - 0.2118f, 0.0040f);
    return d;
}

float neckAndShoulders(const vec3& p) {
    const vec3 s = softSide(p, 0.006f);
    float d = taper(p, {0, 0.0600f, -0.0430f}, 0.0500f, {0, 0.2350f, -0.0240f}, 0.0460f);
    // Trapezius, shoulders, chest, upper back.
    d = smoothMin(d, taper(s, {0.0160f, 0.1720f, -0.0600f}, 0.0165f, {0.1150f, 0.0940f, -0.0500f}, 0.0160f), 0.036f);
    float trunk = taper(s, {0.0400f, 0.0700f, -0.0400f}, 0.0420f, {0.1500f, 0.0680f, -0.0450f}, 0.0420f);
    trunk = smoothMin(trunk, ellipsoid(p, {0, 0.0200f, -0.0280f}, {0.1300f, 0.0880f, 0.0700f}), 0.040f);
    d = smoothMin(d, trunk, 0.035f);
    // Neck muscle from behind the ear to the notch between the collar bones, and the bones.
    d = smoothMin(d, taper(s, {0.0500f, 0.2400f, -0.0300f}, 0.0090f, {0.0120f, 0.1010f, 0.0140f}, 0.0060f), 0.016f);
    static const sdf::Tube collar({{{0.0100f, 0.0960f, 0.0180f}, 0.0075f},
                                   {{0.0450f, 0.0970f, 0.0160f}, 0.0060f},
                                   {{0.0900f, 0.1040f, -0.0080f}, 0.0058f},
                                   {{0.1350f, 0.1080f, -0.0360f}, 0.0070f}});
    d = smoothMin(d, collar.distance(s, 0.05f), 0.016f);
    d = carve(d, ellipsoid(p, {0, 0.1030f, 0.0290f}, {0.0090f, 0.0090f, 0.0120f}), 0.014f);
    return d;
}

}  // namespace

float bustUpperLid(const vec3& point) {
    const LidPoint l = lidPoint({std::abs(point.x), point.y, point.z});
    const float reach = std::min({l.aboveLash, 1.0f - std::abs(l.yaw), 0.30f - l.pitch}) * l.radius;
    return std::min(reach, 0.019f - l.radius);
}

float bustUpperLip(const vec3& point) {
    const vec3 p(std::abs(point.x), point.y, point.z);
    return std::min({p.y - mouthLine(p.x), 0.2165f - 0.10f * p.x - p.y, 0.0255f - p.x, p.z - 0.060f});
}

BustMarks bustMarks(const vec3& point) {
    const vec3 p(std::abs(point.x), point.y, point.z);
    BustMarks marks{0.0f, 0.0f, 0.0f};
    const float lip = std::min(upperLip().distance(p, 0.012f), lowerLip().distance(p, 0.012f));
    marks.lips = smoothstep(0.0016f, 0.0002f, lip);
    const LidPoint l = lidPoint(p);
    if (l.radius < 0.022f && p.z > kEye.z) {
        const float width = smoothstep(1.20f, 0.95f, l.yaw) * smoothstep(-1.05f, -0.80f, l.yaw);
        marks.lash = width * gauss(l.aboveLash + 0.04f, 0.055f) * smoothstep(0.0205f, 0.0170f, l.radius);
        marks.lid = width * smoothstep(0.0f, 0.15f, l.aboveLash) * smoothstep(0.65f, 0.45f, l.pitch) *
                    smoothstep(0.0205f, 0.0165f, l.radius);
    }
    return marks;
}

float bustDistance(const vec3& point) {
    const vec3 p(std::abs(point.x), point.y, point.z);
    float d = 1e9f;
    if (p.y > 0.13f) {
        d = skull(p);
        if (p.z > -0.03f) {
            d = face(p, d);
            d = brows(p, d);
            if (d < 0.03f) {
                d = eyes(p, d);
                d = nose(p, d);
                d = mouth(p, d);
            }
        }
    }
    if (p.y < 0.31f) {
        d = smoothMin(d, neckAndShoulders(p), 0.022f);
    }
    if (ear::bounds(p) < 0.006f) {
        d = ear::blend(p, d);
    }
    // The bust narrows to a small foot and is cut level at y = 0.
    const float cut = ellipsoid(p, {0, 0.1150f, -0.0300f}, {0.1560f, 0.1480f, 0.1200f});
    if (p.y < 0.13f) {
        d = smoothMax(d, cut, 0.010f);
        d = smoothMax(d, -p.y, 0.009f);
    }
    return d;
}

}  // namespace whorl::samples
