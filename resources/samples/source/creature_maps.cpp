// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/creature.h"
#include "resources/samples/source/paint.h"
#include "resources/samples/source/sdf.h"

namespace whorl::samples {

using glm::mix;
using glm::vec3;
using sdf::gauss;
using sdf::smoothstep;

namespace {

struct Marks {
    CreatureMembers members;
    float muzzle;  // 1 on the snout
    float ear;     // 1 on the ears
    float earCup;  // 1 inside the ears
    float earTip;  // 0 at the root, 1 at the tip
    float legs;    // 1 low on the legs
    float tail;    // 1 on the tail
    float along;   // along the tail
    float chest;   // 1 on the throat and chest
    float belly;   // 1 on the pale front and underside
    float eye;     // metres from the eyeball
};

Marks markAt(const PaintPoint& point) {
    const vec3 p(std::abs(point.position.x), point.position.y, point.position.z);
    const vec3 h = creatureHeadSpace(p);
    Marks m;
    m.members = creatureMembers(p);
    m.muzzle = smoothstep(0.006f, -0.012f, sdf::ellipsoid(h, {0, 0.203f, 0.105f}, {0.036f, 0.026f, 0.036f}));
    const vec3 ear = creatureEarFrame(h);
    m.ear = smoothstep(-0.004f, 0.006f, m.members.head - m.members.ear) * smoothstep(0.25f, 0.27f, h.y);
    // The bowl of the ear, short of its rim.
    const float narrow = 1.0f - 0.36f * ear.y * ear.y;
    const float across = ear.x / (0.0240f * narrow), along = (ear.y - 0.46f) / 0.47f;
    m.earCup = m.ear * smoothstep(1.05f, 0.70f, std::sqrt(across * across + along * along)) *
               smoothstep(-0.0060f, -0.0020f, ear.z);
    m.earTip = m.ear * smoothstep(0.45f, 0.85f, ear.y);
    const float trunk = std::min({m.members.trunk, m.members.head, m.members.tail});
    const float limb = std::min({m.members.foreleg, m.members.hindFoot});
    m.legs = smoothstep(-0.004f, 0.006f, trunk - limb) * smoothstep(0.100f, 0.030f, p.y);
    m.tail = smoothstep(-0.006f, 0.010f, m.members.trunk - m.members.tail);
    m.along = creatureTailAxis(p).w;
    m.chest = smoothstep(0.0f, 0.030f, p.z) * smoothstep(0.180f, 0.165f, p.y) * smoothstep(0.050f, 0.110f, p.y) *
              smoothstep(0.058f, 0.018f, p.x);
    m.belly =
        std::max(m.chest, smoothstep(0.2f, -0.5f, point.normal.y) * smoothstep(0.045f, 0.020f, p.x) *
                              smoothstep(-0.075f, -0.050f, p.z) * smoothstep(0.15f, 0.12f, p.y) * (1.0f - m.tail));
    m.eye = creatureEye(p);
    return m;
}

}  // namespace

ScalarImage creatureDensity(int size) {
    return paintScalar(sharedCreature(), size, [](const PaintPoint& point) {
        if (point.part != kCreatureFur) {
            return 0.0f;
        }
        const Marks m = markAt(point);
        const vec3 p = point.position;
        float density = smoothstep(0.0010f, 0.0040f, m.eye);
        density *= smoothstep(0.0005f, 0.0035f, creatureNose(p));
        density *= 1.0f - 0.95f * m.earCup;
        // Soles and everything pressed on the ground stay bare.
        density *= smoothstep(0.0015f, 0.0060f, p.y + 0.004f * std::max(point.normal.y, 0.0f));
        return density;
    });
}

ScalarImage creatureLength(int size) {
    return paintScalar(sharedCreature(), size, [](const PaintPoint& point) {
        if (point.part != kCreatureFur) {
            return 0.0f;
        }
        const Marks m = markAt(point);
        const vec3 p(std::abs(point.position.x), point.position.y, point.position.z);
        const vec3 h = creatureHeadSpace(p);
        float length = 0.50f;
        // Ruff from cheek to cheek and down the chest.
        const float ruff = smoothstep(0.022f, 0.0f, std::abs(p.y - 0.168f) - 0.006f) * smoothstep(-0.05f, 0.0f, p.z);
        length = mix(length, 0.85f, ruff * (1.0f - m.muzzle));
        length = mix(length, 0.95f, m.chest);
        const float face = smoothstep(0.010f, 0.070f, h.z) * smoothstep(0.185f, 0.205f, h.y);
        length = mix(length, 0.22f, face);
        length = mix(length, 0.10f, m.muzzle);
        length = mix(length, 0.10f, smoothstep(0.010f, 0.001f, m.eye));
        length = mix(length, 0.28f, m.ear);
        length = mix(length, 0.14f, m.legs);
        const float feet = smoothstep(0.035f, 0.020f, p.y) * (1.0f - m.tail);
        length = mix(length, 0.17f, feet * m.legs);
        length = mix(length, 0.70f + 0.30f * gauss(m.along - 0.65f, 0.25f), m.tail * smoothstep(0.02f, 0.25f, m.along));
        return length;
    });
}

ColourImage creatureSkin(int size) {
    return paintColour(sharedCreature(), size, [](const PaintPoint& point) {
        if (point.part == kCreatureEyes) {
            // Dark amber iris around a black pupil, on the side the eye looks to.
            const vec3 p(std::abs(point.position.x), point.position.y, point.position.z);
            const vec3 side = glm::normalize(creatureHeadSpace(p) - kCreatureEye);
            const auto angleTo = [&](const vec3& direction) {
                return std::acos(std::clamp(glm::dot(side, glm::normalize(direction)), -1.0f, 1.0f));
            };
            const float away = angleTo(vec3(0.36f, 0.06f, 0.93f));
            const vec3 iris =
                mix(vec3(0.16f, 0.060f, 0.012f), vec3(0.045f, 0.016f, 0.006f), smoothstep(0.45f, 0.80f, away));
            const vec3 eye = mix(mix(vec3(0.004f), iris, smoothstep(0.40f, 0.46f, away)), vec3(0.010f, 0.007f, 0.006f),
                                 smoothstep(0.80f, 0.90f, away));
            // The glint of a window and a faint one below make the eyes alive in any light.
            const float glint = smoothstep(0.17f, 0.12f, angleTo(vec3(0.20f, 0.48f, 0.85f)));
            const float lower = 0.25f * smoothstep(0.13f, 0.06f, angleTo(vec3(0.50f, -0.30f, 0.80f)));
            return mix(eye, vec3(1.0f), std::max(glint, lower));
        }
        if (point.part == kCreatureNosePart) {
            return vec3(0.020f, 0.014f, 0.013f);
        }
        const Marks m = markAt(point);
        vec3 colour(0.40f, 0.27f, 0.20f);
        colour = mix(colour, vec3(0.55f, 0.42f, 0.34f), std::max(m.belly, m.muzzle));
        colour = mix(colour, vec3(0.60f, 0.33f, 0.28f), m.earCup);
        colour = mix(colour, vec3(0.10f, 0.06f, 0.05f), m.legs);
        colour = mix(colour, vec3(0.06f, 0.035f, 0.03f), smoothstep(0.004f, 0.001f, m.eye));
        colour = mix(colour, vec3(0.06f, 0.035f, 0.03f), smoothstep(0.003f, 0.0f, creatureNose(point.position)));
        return colour;
    });
}

ColourImage creatureFurColour(int size) {
    return paintColour(sharedCreature(), size, [](const PaintPoint& point) {
        if (point.part != kCreatureFur) {
            return vec3(0.02f);
        }
        const Marks m = markAt(point);
        const vec3 p(std::abs(point.position.x), point.position.y, point.position.z);
        const vec3 h = creatureHeadSpace(p);
        const float mottle = paintNoise(point.position * 60.0f) * 0.5f + paintNoise(p * 140.0f) * 0.3f;
        const vec3 rust(0.42f, 0.135f, 0.035f), deep(0.26f, 0.070f, 0.020f), cream(0.80f, 0.66f, 0.47f);
        const vec3 dark(0.035f, 0.018f, 0.012f);
        vec3 colour = mix(rust, deep, std::clamp(0.35f + 0.5f * mottle, 0.0f, 1.0f));
        // A darker saddle along the spine.
        colour = mix(colour, deep * 0.7f, 0.8f * gauss(p.x, 0.018f) * smoothstep(0.0f, -0.04f, p.z) * (1.0f - m.tail));
        colour = mix(colour, cream, m.belly);
        // Mask: pale snout, cheeks and spots over the eyes, with a dark line down from each eye.
        const float cheek =
            smoothstep(0.004f, -0.010f, sdf::ellipsoid(h, {0.050f, 0.200f, 0.052f}, {0.034f, 0.022f, 0.034f}));
        const float spot =
            smoothstep(0.004f, -0.004f, sdf::ellipsoid(h, {0.027f, 0.259f, 0.070f}, {0.011f, 0.008f, 0.016f}));
        colour = mix(colour, cream, std::max({m.muzzle, cheek, spot}));
        const float tear = gauss(h.x - 0.031f - 0.25f * (0.222f - h.y), 0.0065f) * smoothstep(0.228f, 0.218f, h.y) *
                           smoothstep(0.188f, 0.206f, h.y) * smoothstep(0.04f, 0.06f, h.z);
        colour = mix(colour, deep * 0.5f, 0.85f * tear);
        colour = mix(colour, mix(rust, dark, 0.75f), smoothstep(0.007f, 0.002f, m.eye));
        colour = mix(colour, mix(deep, cream, 0.15f), m.ear * 0.6f);
        colour = mix(colour, cream, m.earCup * 0.8f);
        colour = mix(colour, dark, m.earTip);
        colour = mix(colour, dark, m.legs);
        // Ringed tail with a dark tip.
        const float ring = smoothstep(-0.2f, 0.5f, std::sin(m.along * 6.2831853f * 4.5f));
        colour =
            mix(colour, mix(mix(rust, cream, 0.35f), deep * 0.8f, ring), m.tail * smoothstep(0.05f, 0.25f, m.along));
        return mix(colour, dark, m.tail * smoothstep(0.84f, 0.92f, m.along));
    });
}

}  // namespace whorl::samples
