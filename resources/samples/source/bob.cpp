// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/bust.h"
#include "resources/samples/source/paint.h"
#include "resources/samples/source/sdf.h"

#include <cmath>

namespace whorl::samples {

using glm::vec3;
using sdf::carve;
using sdf::ellipsoid;
using sdf::smoothMax;
using sdf::smoothMin;
using sdf::smoothstep;

namespace {

enum Region : uint8_t { kHair = 16, kInside };
enum Part { kSkinPart, kFootPart, kHairPart, kInsidePart };

constexpr float kRim = 0.012f;  // of the hair's edge that is hair still, metres inwards

/// Radians from the back of the head, without a crease on the mirror plane.
float around(const vec3& p) {
    const float turn = std::atan2(p.x, -(p.z + 0.03f));
    return std::sqrt(turn * turn + 0.02f);
}

/// The outside of the hair: over the skull, then down around the neck, in locks that turn in at the ends.
float outside(const vec3& p) {
    const float skull = ellipsoid(p, {0.0f, 0.3210f, -0.0200f}, {0.0900f, 0.0910f, 0.1030f});
    // Fullest at the jaw, a little closer at the ends.
    const float curtain = ellipsoid(p, {0.0f, 0.2450f, -0.0210f}, {0.1000f, 0.1180f, 0.1030f});
    float d = smoothMin(skull, curtain, 0.035f);
    const float low = smoothstep(0.36f, 0.24f, p.y);
    const float turn = around(p) * 9.0f + 2.2f * std::sin(around(p) * 3.0f) + 14.0f * (0.30f - p.y);
    d -= 0.0016f * low * std::sin(turn) + 0.0008f * low * std::sin(2.3f * turn + 1.0f);
    return d;
}

/// Positive where hair is taken away: the face, the neck, below the ends.
float open(const vec3& p) {
    const float face = ellipsoid(p, {0.0f, 0.2380f, 0.1120f}, {0.0615f, 0.1090f, 0.1040f});
    const float brow = ellipsoid(p, {0.0f, 0.3060f, 0.1060f}, {0.0560f, 0.0440f, 0.0820f});
    const float neck = sdf::taper(p, {0.0f, 0.1000f, -0.0280f}, 0.0800f, {0.0f, 0.2350f, -0.0260f}, 0.0640f);
    // Longer in front.
    const float ends = 0.1960f - 0.22f * (p.z + 0.03f) + 0.0022f * std::sin(around(p) * 13.0f) - p.y;
    return smoothMax(-smoothMin(smoothMin(face, brow, 0.020f), neck, 0.020f), ends, 0.006f);
}

float bobDistance(const vec3& point) {
    const vec3 p(std::abs(point.x), point.y, point.z);
    return smoothMax(outside(p), open(p), 0.010f);
}

HalfMesh hairMesh() {
    const Field surface = bobDistance;
    HalfMesh mesh = polygonise(surface, {0.0f, 0.130f, -0.145f}, {0.118f, 0.430f, 0.115f}, 0.0030f);
    splitRegion(mesh, 0, 1, [](const vec3& p) { return -outside({std::abs(p.x), p.y, p.z}) - kRim; });
    absorbSpecks(mesh);
    remesh(
        mesh, surface, [](const vec3& p) { return bobDistance(p) < 0.01f && outside(p) < -kRim ? 0.0080f : 0.0046f; },
        7);
    return mesh;
}

const Sculpture& sharedBob() {
    static const Sculpture bob = sculptBob();
    return bob;
}

}  // namespace

Sculpture sculptBob() {
    HalfMesh mesh = bustHalf();
    append(mesh, hairMesh(), kHair);
    Recipe recipe = bustRecipe();
    const Recipe bust = recipe;
    recipe.parts.push_back({"hair", true, vec3(0.030f, 0.014f, 0.008f)});
    recipe.parts.push_back({"inside", false, vec3(0.012f, 0.006f, 0.004f)});
    recipe.seams.isSeam = [bust](uint8_t a, uint8_t b, const vec3& p) {
        return std::max(a, b) >= kHair || bust.seams.isSeam(a, b, p);
    };
    recipe.seams.joinsMirror = [bust](uint8_t region, const vec3& p) {
        // Open at the back, from the crown down; the inside in halves.
        if (region == kHair) return p.y > 0.330f;
        if (region == kInside) return false;
        return bust.seams.joinsMirror(region, p);
    };
    recipe.partOf = [bust](uint8_t region) {
        return region == kHair ? kHairPart : region == kInside ? kInsidePart : bust.partOf(region);
    };
    recipe.texelShare = [bust](uint8_t region) {
        return region == kHair ? 1.0f : region == kInside ? 0.25f : 0.55f * bust.texelShare(region);
    };
    recipe.normal = [bust](uint8_t region, const vec3& p) {
        return region >= kHair ? fieldNormal(bobDistance, p) : bust.normal(region, p);
    };
    return assemble(mesh, recipe);
}

ScalarImage bobDensity(int size) {
    return paintScalar(sharedBob(), size, [](const PaintPoint& point) {
        if (point.part != kHairPart) {
            return 0.0f;
        }
        const vec3 p(std::abs(point.position.x), point.position.y, point.position.z);
        return smoothstep(-kRim, -0.4f * kRim, outside(p));
    });
}

}  // namespace whorl::samples
