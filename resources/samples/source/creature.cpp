// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/creature.h"

#include "resources/samples/source/assemble.h"
#include "resources/samples/source/sdf.h"

namespace whorl::samples {

using glm::vec3;

namespace {

enum Region : uint8_t {
    kTrunk,
    kFaceSide,
    kHeadBack,
    kEarInside,
    kEarOutside,
    kForelegOuter,
    kForelegInner,
    kThigh,
    kHindFoot,
    kTail,
    kUnderside,
    kEyeFront = 32,
    kEyeBack,
    kNose = 40,
};

float edgeLength(const vec3& point) {
    const vec3 p(std::abs(point.x), point.y, point.z);
    const vec3 h = creatureHeadSpace(p);
    float wanted = 0.0046f;
    auto finer = [&](const vec3& at, const vec3& centre, const vec3& radii, float length) {
        wanted = std::min(wanted, length + 0.15f * std::max(sdf::ellipsoid(at, centre, radii), 0.0f));
    };
    finer(h, kCreatureEye, vec3(0.0170f), 0.0020f);
    finer(h, {0.0f, 0.2000f, 0.1050f}, {0.0250f, 0.0150f, 0.0200f}, 0.0017f);
    finer(p, {0.0290f, 0.0120f, 0.0770f}, {0.0180f, 0.0140f, 0.0120f}, 0.0022f);
    finer(p, {0.0740f, 0.0120f, 0.0420f}, {0.0150f, 0.0140f, 0.0100f}, 0.0022f);
    if (creatureEarFrame(h).y > 0.0f) {
        wanted = std::min(wanted, 0.0032f);
    }
    return wanted;
}

HalfMesh bodyMesh() {
    const Field surface = creatureBody;
    HalfMesh mesh = polygonise(surface, {0.0f, -0.006f, -0.222f}, {0.104f, 0.366f, 0.146f}, 0.0026f);
    auto members = [](auto pick) { return [pick](const vec3& p) { return pick(creatureMembers(p)); }; };
    splitRegion(mesh, kTrunk, kFaceSide,
                [](const vec3& p) { return std::min(p.y - 0.168f + 0.12f * p.z, p.z + 0.100f); });
    splitRegion(mesh, kFaceSide, kEarInside, members([](const CreatureMembers& m) { return m.head - m.ear; }));
    splitRegion(mesh, kEarInside, kEarOutside,
                [](const vec3& p) { return -0.0020f - creatureEarFrame(creatureHeadSpace(p)).z; });
    splitRegion(mesh, kFaceSide, kHeadBack, [](const vec3& p) { return 0.005f - p.z; });
    splitRegion(mesh, kTrunk, kTail, members([](const CreatureMembers& m) { return m.trunk - m.tail; }));
    splitRegion(mesh, kTrunk, kForelegOuter, members([](const CreatureMembers& m) {
                    return std::min({m.trunk, m.thigh, m.hindFoot}) - m.foreleg;
                }));
    splitRegion(mesh, kTrunk, kHindFoot,
                members([](const CreatureMembers& m) { return std::min(m.trunk, m.thigh) - m.hindFoot; }));
    splitRegion(mesh, kTrunk, kThigh, members([](const CreatureMembers& m) { return m.trunk - m.thigh; }));
    splitRegion(mesh, kTrunk, kUnderside, [](const vec3& p) { return 0.052f + 0.28f * (p.z - 0.03f) - p.y; });
    splitRegion(mesh, kThigh, kUnderside, [](const vec3& p) { return 0.019f - p.y; });
    splitRegion(mesh, kForelegOuter, kForelegInner, [](const vec3& p) { return 0.0288f - p.x; });
    absorbSpecks(mesh);
    remesh(mesh, surface, edgeLength, 7);
    return mesh;
}

HalfMesh eyeMesh() {
    const Field surface = creatureEye;
    const vec3 reach(0.021f), centre = creatureFromHead(kCreatureEye);
    HalfMesh mesh = polygonise(surface, (centre - reach) * vec3(0, 1, 1), centre + reach, 0.0020f);
    splitRegion(mesh, 0, 1, [&](const vec3& p) { return centre.z + 0.004f - p.z; });
    remesh(
        mesh, surface, [](const vec3&) { return 0.0028f; }, 6);
    return mesh;
}

HalfMesh noseMesh() {
    const Field surface = creatureNose;
    const vec3 reach(0.018f), centre = creatureFromHead(kCreatureNose);
    HalfMesh mesh = polygonise(surface, (centre - reach) * vec3(0, 1, 1), centre + reach, 0.0015f);
    remesh(
        mesh, surface, [](const vec3&) { return 0.0017f; }, 6);
    return mesh;
}

bool isSeam(uint8_t a, uint8_t b, const vec3& p) {
    if (a > b) {
        std::swap(a, b);
    }
    if (a == kFaceSide && b == kHeadBack) {
        return creatureHeadSpace(p).y < 0.265f;
    }
    if (a == kForelegOuter && b == kForelegInner) {
        // Open along the back of the leg and half of the sole.
        return p.z < 0.048f - 0.18f * (p.y - 0.026f);
    }
    return true;
}

bool joinsMirror(uint8_t region, const vec3& p) {
    switch (region) {
        case kTrunk:
            return p.z > -0.01f;
        case kFaceSide: {
            // Open from under the chin to the throat.
            const vec3 h = creatureHeadSpace(p);
            return h.y > 0.210f || h.z > 0.095f;
        }
        case kTail: {
            const vec3 axis(creatureTailAxis(p));
            const vec3 middle(0.0f, 0.125f, -0.110f);
            return glm::distance(p, middle) > glm::distance(axis, middle);
        }
        case kNose:
            return creatureHeadSpace(p).z > kCreatureNose.z - 0.003f;
        default:
            return true;
    }
}

}  // namespace

Sculpture sculptCreature() {
    HalfMesh mesh = bodyMesh();
    append(mesh, eyeMesh(), kEyeFront);
    append(mesh, noseMesh(), kNose);
    Recipe recipe;
    recipe.seams = {isSeam, joinsMirror};
    recipe.parts = {{"body", true, vec3(0.42f, 0.30f, 0.22f)},
                    {"eyes", false, vec3(0.012f, 0.008f, 0.006f)},
                    {"nose", false, vec3(0.020f, 0.014f, 0.013f)}};
    recipe.partOf = [](uint8_t region) {
        return region >= kNose ? kCreatureNosePart : region >= kEyeFront ? kCreatureEyes : kCreatureFur;
    };
    recipe.texelShare = [](uint8_t region) { return region == kUnderside ? 0.6f : region == kEyeBack ? 0.3f : 1.0f; };
    recipe.normal = [](uint8_t region, const vec3& p) {
        return fieldNormal(region >= kNose ? creatureNose : region >= kEyeFront ? creatureEye : creatureBody, p);
    };
    return assemble(mesh, recipe);
}

const Sculpture& sharedCreature() {
    static const Sculpture creature = sculptCreature();
    return creature;
}

}  // namespace whorl::samples
