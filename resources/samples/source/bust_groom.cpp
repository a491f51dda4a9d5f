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

/// Combed from the forehead up and back over the crown, a little to the model's right, down at the sides and the nape.
glm::vec3 scalpFlow(const glm::vec3& p, const glm::vec3& root) {
    const float height = ramp(p.y, 0.290f, 0.385f);
    const float front = ramp(p.z, -0.020f, 0.060f) * ramp(root.y, 0.315f, 0.350f);
    const glm::vec3 overTheTop(-0.45f * ramp(root.z, 0.020f, 0.075f), 0.55f, -1.0f);
    const float outward = 0.35f * glm::clamp(root.x / 0.075f, -1.0f, 1.0f) * height;
    const glm::vec3 backAndDown(outward, -0.15f - 1.2f * (1.0f - height), -1.0f);
    return glm::mix(backAndDown, overTheTop, front);
}

float scalpLength(const glm::vec3& root) {
    const float height = ramp(root.y, napeHeight, topHeight - 0.020f);
    const float front = ramp(root.z, 0.000f, 0.070f) * ramp(root.y, 0.320f, 0.360f);
    return 0.022f + 0.068f * height + 0.030f * front;
}

float scalpLift(const glm::vec3& root) {
    return 0.18f + 0.50f * ramp(root.z, 0.010f, 0.075f) * ramp(root.y, 0.320f, 0.355f);
}

float scalpLayer(const glm::vec3& root) {
    const float top = ramp(root.y, 0.300f, 0.360f);
    const float front = ramp(root.z, -0.020f, 0.075f);
    return 0.0035f + 0.0075f * top + 0.0130f * top * front;
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
                .layer = scalpLayer,
                .turn = 0.40f,
                .gravity = 0.02f,
                .hug = 0.55f,
                .stray = 0.09f});
    growGuides(
        groom, surface, 1,
        {.length = [](const glm::vec3& root) { return 0.010f - 0.004f * ramp(std::abs(root.x), 0.035f, 0.055f); },
         .flow =
             [](const glm::vec3& p, const glm::vec3&) {
                 const float outward = ramp(std::abs(p.x), 0.008f, 0.030f);
                 return glm::vec3(p.x < 0 ? -outward : outward, 0.9f - 1.1f * outward, 0.0f);
             },
         .lift = [](const glm::vec3&) { return 0.25f; },
         .layer = [](const glm::vec3&) { return 0.0010f; },
         .turn = 0.5f,
         .gravity = 0.0f,
         .stray = 0.15f});
    return groom;
}

}  // namespace whorl::samples
