// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/ear.h"

#include "resources/samples/source/sdf.h"

#include <array>

namespace whorl::samples::ear {

using glm::vec2;
using glm::vec3;

namespace {

const vec3 kOrigin(0.0715f, 0.2665f, -0.0200f);
constexpr float kFlare = 0.42f;  // how far the back edge stands off the head
constexpr float kLean = 0.16f;   // how far the top leans back

/// Ear frame: x forward within the ear's plane, y up, z out of the ear's face.
vec3 local(const vec3& p) {
    vec3 q = sdf::turnX(p, kOrigin, kLean) - kOrigin;
    const float c = std::cos(kFlare), s = std::sin(kFlare);
    return {-s * q.x + c * q.z, q.y, c * q.x + s * q.z};
}

/// The ear is a shallow dish: its rim comes forward, more so at the top.
float dish(const vec2& q) {
    const vec2 d = q - vec2(0.0f, 0.002f);
    return 6.0f * (d.x * d.x + 0.35f * d.y * d.y) - 0.0012f;
}

const sdf::Tube& helix() {
    static const sdf::Tube tube({{{0.0010f, -0.0005f, -0.0080f}, 0.0018f},
                                 {{0.0065f, 0.0032f, -0.0026f}, 0.0022f},
                                 {{0.0120f, 0.0100f, 0.0004f}, 0.0023f},
                                 {{0.0128f, 0.0190f, 0.0010f}, 0.0024f},
                                 {{0.0070f, 0.0277f, 0.0020f}, 0.0026f},
                                 {{-0.0040f, 0.0312f, 0.0030f}, 0.0027f},
                                 {{-0.0135f, 0.0265f, 0.0032f}, 0.0027f},
                                 {{-0.0185f, 0.0160f, 0.0028f}, 0.0025f},
                                 {{-0.0188f, 0.0040f, 0.0022f}, 0.0022f},
                                 {{-0.0160f, -0.0070f, 0.0014f}, 0.0020f},
                                 {{-0.0118f, -0.0160f, 0.0008f}, 0.0019f},
                                 {{-0.0070f, -0.0235f, 0.0004f}, 0.0020f},
                                 {{-0.0010f, -0.0280f, 0.0002f}, 0.0022f}},
                                5);
    return tube;
}

const sdf::Tube& antihelix() {
    static const sdf::Tube tube({{{0.0010f, -0.0150f, 0.0004f}, 0.0022f},
                                 {{-0.0050f, -0.0140f, 0.0006f}, 0.0024f},
                                 {{-0.0102f, -0.0070f, 0.0008f}, 0.0025f},
                                 {{-0.0118f, 0.0030f, 0.0012f}, 0.0027f},
                                 {{-0.0095f, 0.0120f, 0.0010f}, 0.0028f},
                                 {{-0.0045f, 0.0190f, 0.0000f}, 0.0025f},
                                 {{0.0010f, 0.0235f, -0.0012f}, 0.0016f}},
                                4);
    return tube;
}

const sdf::Tube& lowerCrus() {
    static const sdf::Tube tube({{{-0.0100f, 0.0095f, 0.0006f}, 0.0024f},
                                 {{-0.0020f, 0.0135f, -0.0006f}, 0.0021f},
                                 {{0.0070f, 0.0135f, -0.0022f}, 0.0016f}},
                                4);
    return tube;
}

/// Egg outline of the ear, negative inside.
float outline(const vec2& q) {
    const float upper = sdf::ellipsoid(vec3(q, 0.0f), vec3(-0.0030f, 0.0105f, 0.0f), vec3(0.0168f, 0.0215f, 1.0f));
    const float lower = sdf::ellipsoid(vec3(q, 0.0f), vec3(-0.0005f, -0.0150f, 0.0f), vec3(0.0098f, 0.0150f, 1.0f));
    return sdf::smoothMin(upper, lower, 0.016f);
}

/// Area of the bowl, negative inside; behind it the ear is solid down to the head.
float bowl(const vec2& q) {
    return sdf::ellipsoid(vec3(q, 0.0f), vec3(0.0008f, -0.0020f, 0.0f), vec3(0.0098f, 0.0158f, 1.0f));
}

}  // namespace

float bounds(const vec3& p) {
    return glm::length(p - kOrigin) - 0.037f;
}

float blend(const vec3& p, float head) {
    const vec3 q = local(p);
    const vec2 flat(q);
    const float sheet = std::abs(q.z - dish(flat)) - 0.0019f;
    float d = sdf::smoothMax(sheet, outline(flat), 0.003f);
    // The root that carries the bowl of the ear on the head.
    const float root = sdf::ellipsoid(q, vec3(0.0020f, -0.0015f, -0.0085f), vec3(0.0135f, 0.0205f, 0.0112f));
    d = sdf::smoothMin(d, root, 0.006f);
    d = sdf::smoothMin(d, sdf::ellipsoid(q, vec3(-0.0003f, -0.0235f, 0.0f), vec3(0.0082f, 0.0085f, 0.0030f)), 0.003f);
    d = sdf::smoothMin(head, d, 0.005f);
    // Bowl (concha), then the folds that stand around and above it.
    d = sdf::carve(d, sdf::ellipsoid(q, vec3(0.0002f, -0.0060f, -0.0005f), vec3(0.0080f, 0.0090f, 0.0085f)), 0.004f);
    d = sdf::carve(d, sdf::ellipsoid(q, vec3(0.0010f, 0.0065f, -0.0005f), vec3(0.0076f, 0.0042f, 0.0056f)), 0.0035f);
    d = sdf::smoothMin(d, antihelix().distance(q, 0.01f), 0.0030f);
    d = sdf::smoothMin(d, lowerCrus().distance(q, 0.01f), 0.0028f);
    // Groove between rim and inner fold.
    d = sdf::smoothMin(d, helix().distance(q, 0.01f), 0.0018f + 0.0022f * sdf::smoothstep(0.004f, -0.001f, head));
    const float tragus = sdf::ellipsoid(sdf::turnZ(q, vec3(0.0105f, -0.0075f, 0.0f), 0.25f),
                                        vec3(0.0098f, -0.0075f, -0.0012f), vec3(0.0036f, 0.0054f, 0.0036f));
    d = sdf::smoothMin(d, tragus, 0.0035f);
    return d;
}

float region(const vec3& p) {
    const vec3 q = local(p);
    const float deeper = 0.0120f * (1.0f - sdf::smoothstep(-0.0015f, 0.0015f, bowl(vec2(q))));
    const float shell = std::max({q.z - 0.0090f, -0.0045f - deeper - q.z, outline(vec2(q)) - 0.0030f});
    return -sdf::smoothMax(shell, q.x - 0.0125f, 0.003f);
}

float backSide(const vec3& p) {
    const vec3 q = local(p);
    const vec2 flat(q);
    // Along the rim the line follows the middle of the helix; inside, it stays hidden within the sheet.
    const float rim =
        0.0002f + 0.0030f * sdf::smoothstep(-0.025f, 0.020f, q.y) - 0.0022f * sdf::smoothstep(-0.002f, 0.012f, q.x);
    float level = glm::mix(dish(flat), rim, sdf::smoothstep(-0.0040f, -0.0015f, outline(flat)));
    level -= 0.02f * (1.0f - sdf::smoothstep(-0.0015f, 0.0015f, bowl(flat)));
    level -= 0.02f * sdf::smoothstep(0.0060f, 0.0110f, q.x);
    return level - q.z;
}

}  // namespace whorl::samples::ear
