// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/bust.h"

#include "resources/samples/source/assemble.h"
#include "resources/samples/source/ear.h"
#include "resources/samples/source/sdf.h"

namespace whorl::samples {

using glm::vec3;

namespace {

enum Region : uint8_t { kFace, kScalp, kTorso, kFoot, kEarFront, kEarBack, kLid, kLip };

/// Finest where the small forms are, coarse on the shoulders.
float edgeLength(const vec3& p) {
    float wanted = 0.0045f;
    auto finer = [&](const vec3& centre, const vec3& radii, float length) {
        const float outside = std::max(sdf::ellipsoid(vec3(std::abs(p.x), p.y, p.z), centre, radii), 0.0f);
        wanted = std::min(wanted, length + 0.16f * outside);
    };
    wanted += 0.0032f * sdf::smoothstep(0.20f, 0.10f, p.y);
    finer({0.0310f, 0.2830f, 0.0750f}, {0.0150f, 0.0090f, 0.0100f}, 0.0012f);
    finer({0.0f, 0.2125f, 0.0850f}, {0.0240f, 0.0070f, 0.0150f}, 0.0014f);
    finer({0.0f, 0.2400f, 0.0950f}, {0.0150f, 0.0080f, 0.0140f}, 0.0015f);
    finer({0.0074f, 0.2360f, 0.0920f}, {0.0060f, 0.0050f, 0.0070f}, 0.0012f);
    finer({0.0f, 0.2450f, 0.0700f}, {0.0450f, 0.0600f, 0.0300f}, 0.0028f);
    wanted = std::min(wanted, 0.0018f + 0.20f * std::max(ear::bounds(vec3(std::abs(p.x), p.y, p.z)), 0.0f));
    wanted = std::min(wanted, 0.0034f + 0.25f * std::max(p.y - 0.006f, 0.0f));  // rounded lower edge
    return p.y < 0.0015f ? 0.0060f : wanted;
}

}  // namespace

HalfMesh bustHalf() {
    const Field surface = bustDistance;
    HalfMesh mesh = polygonise(surface, {0.0f, -0.008f, -0.150f}, {0.165f, 0.408f, 0.120f}, 0.0026f);
    // The head comes off along a line under the jaw to the nape; the ears, and a cut below each, let it lie flat.
    splitRegion(mesh, kFace, kTorso, [](const vec3& p) { return 0.174f - 0.45f * (p.z - 0.03f) - p.y; });
    splitRegion(mesh, kTorso, kFoot, [](const vec3& p) { return 0.0016f - p.y; });
    splitRegion(mesh, kFace, kEarFront, ear::region);
    splitRegion(mesh, kEarFront, kEarBack, ear::backSide);
    splitRegion(mesh, kFace, kScalp, [](const vec3& p) { return -0.022f - p.z; });
    splitRegion(mesh, kFace, kLid, bustUpperLid);
    splitRegion(mesh, kFace, kLip, bustUpperLip);
    absorbSpecks(mesh);
    remesh(mesh, surface, edgeLength, 7);
    return mesh;
}

Recipe bustRecipe() {
    Recipe recipe;
    recipe.seams.isSeam = [](uint8_t a, uint8_t b, const vec3& p) {
        if (std::max(a, b) >= kLid) {
            return false;
        }
        const bool aroundHead = (a == kFace && b == kScalp) || (a == kScalp && b == kFace);
        return !aroundHead || p.y < 0.262f;
    };
    recipe.seams.joinsMirror = [](uint8_t region, const vec3& p) {
        switch (region) {
            case kScalp:
                return p.y > 0.285f;
            case kTorso:
                return p.z > -0.04f;
            default:
                return true;
        }
    };
    recipe.parts = {{"skin", true, vec3(0.60f, 0.52f, 0.46f)}, {"foot", false, vec3(0.10f, 0.10f, 0.11f)}};
    recipe.partOf = [](uint8_t region) { return region == kFoot ? 1 : 0; };
    recipe.texelShare = [](uint8_t region) {
        return region == kTorso                            ? 0.60f
               : region == kFoot                           ? 0.35f
               : region == kEarFront || region == kEarBack ? 1.15f
                                                           : 1.0f;
    };
    recipe.normal = [](uint8_t, const vec3& p) { return fieldNormal(bustDistance, p); };
    return recipe;
}

Sculpture sculptBust() {
    return assemble(bustHalf(), bustRecipe());
}

const Sculpture& sharedBust() {
    static const Sculpture bust = sculptBust();
    return bust;
}

}  // namespace whorl::samples
