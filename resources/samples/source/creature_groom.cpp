// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command.h"
#include "resources/samples/source/grooms.h"
#include "resources/samples/source/style.h"

#include <glm/geometric.hpp>

namespace whorl::samples {
namespace {

const glm::vec3 noseTip{0.0f, 0.2150f, 0.1170f};
const glm::vec3 tailRoot{0.0f, 0.0400f, -0.0900f};

HairParams fur() {
    HairParams hair;
    hair.general.density = {1.0f, "fur_density"};
    hair.general.samples = 5;
    hair.general.randomScale.value = 0.35f;
    hair.general.rootThickness.value = 0.00022f;
    hair.general.tipThickness.value = 0.00003f;
    hair.colour.root = {glm::vec3(0.55f), "fur_colour"};
    hair.colour.tip = {glm::vec3(1.0f), "fur_colour"};
    hair.colour.hueVariation.value = 0.03f;
    hair.colour.valueVariation.value = 0.22f;
    hair.frizz.root.value = 0.0003f;
    hair.frizz.tip.value = 0.0050f;
    hair.frizz.frequency.value = glm::vec3(420.0f);
    hair.kink.tip.value = 0.0008f;
    hair.kink.frequency.value = glm::vec3(160.0f);
    return hair;
}

/// From the nose over head and back, down the belly and the legs, up along the tail.
glm::vec3 furFlow(const glm::vec3& p, const glm::vec3&) {
    const glm::vec3 fromNose = glm::normalize(p - noseTip + glm::vec3(0, 0, 1e-4f));
    const float head = ramp(p.y, 0.150f, 0.190f) * ramp(p.z, -0.060f, 0.000f);
    const glm::vec3 body(0.0f, -0.85f, -0.55f);
    const float tail = ramp(p.z, -0.100f, -0.140f);
    const glm::vec3 up = glm::vec3(0.0f, 1.0f, -0.35f) + (p - tailRoot) * 2.0f * glm::vec3(1, 0, 0);
    return glm::mix(glm::mix(body, fromNose, head), up, tail);
}

}  // namespace

Result<Groom> creatureGroom(Progress& progress) {
    const int mapSize = 1024;
    Groom groom = groomFrom(sculptCreature());
    groom.maps.set("fur_density", mapFrom(creatureDensity(mapSize)));
    groom.maps.set("fur_length", mapFrom(creatureLength(mapSize)));
    groom.maps.set("fur_colour", mapFrom(creatureFurColour(mapSize)));
    groom.maps.set("skin", mapFrom(creatureSkin(mapSize)));
    for (MeshPart& part : groom.mesh.edit().parts) part.texture = "skin";
    groom.groups = Cow<std::vector<Group>>({{"fur", fur()}});
    CountParams& counts = groom.counts.edit();
    counts.guides = 1500;
    counts.hairs = 120000;
    counts.shownHairs = 40000;
    counts.parts = 8;

    const Surface surface(groom.mesh);
    if (auto placed = placeGuides(groom, surface, 1500, 0.02f, false, progress); !placed) return placed.error();
    const Map* lengths = groom.maps.find("fur_length");
    growGuides(groom, surface, 0,
               {.length =
                    [&](const glm::vec3& root) {
                        const auto hit = surface.query.nearest(root);
                        const float share = hit ? lengths->sample(uvAt(surface.mesh(), hit->point)) : 1.0f;
                        return 0.0045f + 0.054f * share;
                    },
                .flow = furFlow,
                .lift = [](const glm::vec3&) { return 0.68f; },
                .layer = [](const glm::vec3&) { return 0.010f; },
                .turn = 0.28f,
                .gravity = 0.03f,
                .hug = 0.05f,
                .stray = 0.12f});
    return groom;
}

}  // namespace whorl::samples
