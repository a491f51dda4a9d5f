// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command.h"
#include "resources/samples/source/grooms.h"
#include "resources/samples/source/style.h"

#include <glm/geometric.hpp>

namespace whorl::samples {
namespace {

// Landmarks of the bust in metres (see bust_field.cpp): the crown where the hair whirls, and the heights of the top of
// the head and of the nape.
constexpr float topHeight = 0.400f;
constexpr float napeHeight = 0.235f;
constexpr float partingSide = 0.022f;

HairParams scalpHair() {
    HairParams hair;
    hair.general.density = {1.0f, "scalp_density"};
    hair.general.samples = 4;
    hair.general.randomScale.value = 0.18f;
    hair.general.rootThickness.value = 0.00014f;
    hair.general.tipThickness.value = 0.00004f;
    hair.colour.root.value = {0.030f, 0.014f, 0.0065f};
    hair.colour.tip.value = {0.150f, 0.070f, 0.028f};
    hair.colour.hueVariation.value = 0.05f;
    hair.colour.valueVariation.value = 0.35f;
    hair.frizz.root.value = 0.0004f;
    hair.frizz.tip.value = 0.0045f;
    hair.frizz.frequency.value = glm::vec3(260.0f);
    hair.kink.tip.value = 0.0012f;
    hair.kink.frequency.value = glm::vec3(90.0f);
    return hair;
}

HairParams browHair() {
    HairParams hair;
    hair.general.segments = 7;
    hair.general.density = {0.8f, "brow_density"};
    hair.general.randomScale.value = 0.35f;
    hair.general.rootThickness.value = 0.00013f;
    hair.general.tipThickness.value = 0.00003f;
    hair.colour.root.value = {0.022f, 0.011f, 0.006f};
    hair.colour.tip.value = {0.055f, 0.027f, 0.013f};
    hair.colour.valueVariation.value = 0.25f;
    hair.frizz.tip.value = 0.0012f;
    hair.frizz.frequency.value = glm::vec3(900.0f);
    return hair;
}

/// Combed back from the forehead, to the model's right over the parting, down at the sides and the nape.
glm::vec3 scalpFlow(const glm::vec3& p, const glm::vec3& root) {
    const float height = ramp(p.y, 0.290f, topHeight);
    const float front = ramp(p.z, -0.030f, 0.060f);
    const float side = ramp(root.x, partingSide - 0.006f, partingSide + 0.006f) * 2.0f - 1.0f;
    return {side * 0.85f * front * height, -0.25f - 1.1f * (1.0f - height), -1.0f + 0.15f * front};
}

float scalpLength(const glm::vec3& root) {
    const float height = ramp(root.y, napeHeight, topHeight - 0.010f);
    const float front = ramp(root.z, 0.000f, 0.070f) * ramp(root.y, 0.330f, 0.370f);
    return 0.020f + 0.072f * height + 0.022f * front;
}

float scalpLift(const glm::vec3& root) {
    return 0.22f + 0.38f * ramp(root.z, 0.020f, 0.075f) * ramp(root.y, 0.335f, 0.365f);
}

}  // namespace

Result<Groom> bustGroom(Progress& progress) {
    const int mapSize = 1024;
    Groom groom = groomFrom(sculptBust());
    const ScalarImage scalp = bustScalpDensity(mapSize);
    const ScalarImage brows = bustBrowDensity(mapSize);
    groom.maps.set("scalp_density", mapFrom(scalp));
    groom.maps.set("brow_density", mapFrom(brows));
    groom.maps.set("skin", mapFrom(bustSkin(mapSize)));

    // Texel 1 of 255 is the second group.
    Map areas(mapSize, mapSize, 1, TexelFormat::U8, 0.0f);
    for (int y = 0; y < mapSize; ++y) {
        for (int x = 0; x < mapSize; ++x) {
            const auto i = static_cast<std::size_t>(y * mapSize + x);
            if (brows.values[i] > scalp.values[i]) areas.setTexel(x, y, 0, 1.0f / 255.0f);
        }
    }
    groom.maps.set("groups", std::move(areas));
    for (MeshPart& part : groom.mesh.edit().parts) part.texture = "skin";

    groom.groups = Cow<std::vector<Group>>({{"scalp", scalpHair()}, {"brows", browHair()}});
    CountParams& counts = groom.counts.edit();
    counts.guides = 900;
    counts.hairs = 60000;
    counts.shownHairs = 20000;
    counts.parts = 4;
    counts.groupMap.name = "groups";

    const Surface surface(groom.mesh);
    if (auto placed = placeGuides(groom, surface, 900, 0.05f, false, progress); !placed) return placed.error();
    growGuides(groom, surface, 0,
               {.length = scalpLength,
                .flow = scalpFlow,
                .lift = scalpLift,
                .turn = 0.42f,
                .gravity = 0.035f,
                .layer = 0.0045f,
                .stray = 0.10f});
    growGuides(
        groom, surface, 1,
        {.length = [](const glm::vec3& root) { return 0.010f - 0.004f * ramp(std::abs(root.x), 0.035f, 0.055f); },
         .flow =
             [](const glm::vec3& p, const glm::vec3&) {
                 const float outward = ramp(std::abs(p.x), 0.008f, 0.030f);
                 return glm::vec3(p.x < 0 ? -outward : outward, 0.9f - 1.1f * outward, 0.0f);
             },
         .lift = [](const glm::vec3&) { return 0.25f; },
         .turn = 0.5f,
         .gravity = 0.0f,
         .layer = 0.0008f,
         .stray = 0.15f});
    return groom;
}

}  // namespace whorl::samples
