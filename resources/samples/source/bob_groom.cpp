// SPDX-License-Identifier: Apache-2.0
#include "core/surface/parting_line.h"
#include "resources/samples/source/grooms.h"

#include <initializer_list>

namespace whorl::samples {
namespace {

HairParams bobHair() {
    HairParams hair;
    hair.general.density = {1.0f, "hair_density"};
    hair.colour.root.value = {0.030f, 0.013f, 0.007f};
    hair.colour.tip.value = {0.070f, 0.029f, 0.013f};
    hair.colour.valueVariation.value = 0.25f;
    return hair;
}

/// From the parting down over the side of the head, a little back, and in under the jaw.
constexpr glm::vec3 sideLines[][5] = {
    {{0.030f, 0.400f, 0.040f},
     {0.070f, 0.360f, 0.050f},
     {0.085f, 0.300f, 0.045f},
     {0.088f, 0.240f, 0.040f},
     {0.070f, 0.185f, 0.040f}},
    {{0.035f, 0.410f, -0.010f},
     {0.080f, 0.360f, -0.010f},
     {0.098f, 0.290f, -0.010f},
     {0.098f, 0.240f, -0.010f},
     {0.085f, 0.190f, -0.008f}},
    {{0.030f, 0.405f, -0.060f},
     {0.065f, 0.360f, -0.075f},
     {0.080f, 0.290f, -0.080f},
     {0.078f, 0.240f, -0.080f},
     {0.068f, 0.205f, -0.075f}},
};
constexpr glm::vec3 backLine[] = {
    {0.0f, 0.400f, -0.080f}, {0.0f, 0.350f, -0.115f}, {0.0f, 0.280f, -0.125f}, {0.0f, 0.225f, -0.115f}};

}  // namespace

Result<Groom> bobGroom(Progress&) {
    const int mapSize = 1024;
    const Sculpture sculpture = sculptBob();
    Groom groom = groomFrom(sculpture);
    // The head below wears no hair of its own.
    groom.partSettings.edit()[0].growsHair = false;
    groom.maps.set("hair_density", mapFrom(bobDensity(mapSize)));
    groom.maps.set("skin", mapFrom(bustSkin(sculpture, mapSize)));
    for (std::size_t part : {0, 1}) groom.mesh.edit().parts[part].texture = "skin";
    groom.groups = Cow<std::vector<Group>>({{"hair", bobHair()}});

    const Surface surface(groom.mesh);
    // A little to the model's left, from the brow to the crown.
    const glm::vec3 partingLine[] = {
        {0.022f, 0.352f, 0.088f}, {0.022f, 0.400f, 0.040f}, {0.018f, 0.412f, -0.010f}, {0.010f, 0.408f, -0.055f}};
    auto parting = tracedParting(surface, partingLine);
    if (!parting) return parting.error();
    groom.partings.edit().push_back({1, "", std::move(*parting)});
    std::uint32_t id = 0;
    const auto draw = [&](std::span<const glm::vec3> line, float side) -> Result<void> {
        std::vector<glm::vec3> points;
        for (const glm::vec3& p : line) points.push_back({p.x * side, p.y, p.z});
        auto traced = tracedParting(surface, points);
        if (!traced) return traced.error();
        FieldStroke stroke;
        stroke.id = ++id;
        stroke.points = std::move(*traced);
        groom.strokes.edit().push_back(std::move(stroke));
        return {};
    };
    for (const auto& line : sideLines) {
        for (const float side : {1.0f, -1.0f}) {
            if (auto done = draw(line, side); !done) return done.error();
        }
    }
    if (auto done = draw(backLine, 1.0f); !done) return done.error();

    LicParams& lic = groom.lic.edit();
    lic.length.value = 0.050f;
    lic.grain.value = 0.0008f;
    lic.colourPlace = 0.7f;
    lic.specular = 0.9f;
    lic.shininess = 90.0f;
    lic.border = 0.004f;
    return groom;
}

}  // namespace whorl::samples
