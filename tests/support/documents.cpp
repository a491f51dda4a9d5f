// SPDX-License-Identifier: Apache-2.0
#include "tests/support/documents.h"

#include "core/io/container.h"
#include "core/io/document.h"
#include "core/io/groom_codec.h"
#include "core/io/json_text.h"
#include "tests/support/shapes.h"

#include <cstring>
#include <limits>

namespace whorl::testing {
namespace {

using nlohmann::json;

constexpr ContainerKind documentKind{"WHORLDOC", 1, "a Whorl document"};

/// A document taken apart.
struct Apart {
    json manifest;
    std::vector<std::vector<std::uint8_t>> pieces;
    std::vector<json::json_pointer> places;
};

Groom baseGroom() {
    Groom groom = groomOn(plane(2), 5, 4);
    groom.groups.edit().push_back({"second", {}});
    groom.groups.edit()[1].params.general.density.map = "density";
    groom.maps.set("density", Map(70, 40, 1, TexelFormat::F32, 1.0f));
    groom.maps.edit("density")->setTexel(3, 4, 0, 0.5f);
    groom.maps.set("colour", Map(8, 8, 3, TexelFormat::U8, 0.5f));
    groom.maps.edit("colour")->setTexel(1, 1, 2, 1.0f);
    groom.partings.edit() = {{1, "middle", {{0, 0.5f, 0.25f}, {3, 0.25f, 0.5f}, {7, 0.1f, 0.2f}}},
                             {4, "", {{2, 0.0f, 0.0f}, {5, 1.0f, 0.0f}}}};
    groom.strokes.edit() = {{1, StrokeKind::Along, 2.0f, 0.0f, {{0, 0.5f, 0.25f}, {3, 0.25f, 0.5f}}},
                            {3, StrokeKind::Whorl, 1.0f, 0.03f, {{2, 0.25f, 0.5f}}}};
    groom.field.edit().lift = 0.5f;
    groom.lic.edit().length.map = "density";
    return groom;
}

Apart takenApart() {
    Apart apart;
    const std::vector<std::uint8_t> bytes = documentBytes(baseGroom());
    auto container = Container::read(bytes, documentKind, "base");
    apart.manifest = *parseJson(*container->manifest(), "base");
    Progress progress;
    for (std::uint32_t i = 0; i + 1 < container->pieceCount(); ++i) {
        std::vector<std::uint8_t> raw(static_cast<std::size_t>(container->rawBytes(i)));
        const Container::Request request{{i, 1, raw.size()}, raw.data()};
        if (container->claim(request.blob, raw.size()) && container->inflate({&request, 1}, progress))
            apart.pieces.push_back(std::move(raw));
    }
    const json flat = apart.manifest.flatten();
    for (const auto& [place, value] : flat.items()) {
        json::json_pointer pointer(place);
        apart.places.push_back(pointer);
        if (!pointer.empty()) apart.places.push_back(pointer.parent_pointer());
    }
    return apart;
}

json junk(std::uint64_t value) {
    switch (value % 9) {
        case 0:
            return nullptr;
        case 1:
            return (value & 16) != 0;
        case 2:
            return -static_cast<std::int64_t>(value >> 8);
        case 3:
            return 1e300;
        case 4:
            return std::string(static_cast<std::size_t>(value >> 8) % 300, 'x');
        case 5:
            return json::array();
        case 6:
            return json::object();
        case 7:
            return json::array({value >> 60, (value >> 52) & 3, (value >> 8) & 0xffff});
        default:
            return json{{"value", value >> 8}, {"map", "density"}};
    }
}

}  // namespace

std::vector<std::uint8_t> mutatedDocument(std::span<const std::uint8_t> choices) {
    static const Apart base = takenApart();
    json manifest = base.manifest;
    std::vector<std::vector<std::uint8_t>> pieces = base.pieces;
    for (; choices.size() >= 11; choices = choices.subspan(11)) {
        std::uint16_t index = 0;
        std::uint64_t value = 0;
        std::memcpy(&index, choices.data() + 1, 2);
        std::memcpy(&value, choices.data() + 3, 8);
        const json::json_pointer& place = base.places[index % base.places.size()];
        std::vector<std::uint8_t>& piece = pieces[index % pieces.size()];
        try {
            switch (choices[0] % 6) {
                case 0:
                    manifest.at(place) = value;
                    break;
                case 1:
                    manifest.at(place) = value % 100;
                    break;
                case 2:
                    manifest.at(place) = junk(value);
                    break;
                case 3:
                    manifest.at(place)["more"] = value;
                    break;
                case 4:
                    if (!piece.empty()) piece[(value >> 8) % piece.size()] = static_cast<std::uint8_t>(value);
                    break;
                default:
                    if (piece.size() >= 4)
                        std::memcpy(piece.data() + (value >> 32) % (piece.size() / 4) * 4, &value, 4);
                    break;
            }
        } catch (const json::exception&) {  // an earlier change took the place away
        }
    }
    ContainerWriter writer;
    Progress progress;
    for (const auto& piece : pieces) writer.add(piece);
    auto bytes = writer.finish(documentKind, jsonText(manifest), progress);
    return bytes ? std::move(*bytes) : std::vector<std::uint8_t>();
}

bool obeysLaws(const Groom& groom) {
    for (const std::string& problem : checkGroom(groom)) {
        if (problem.find("which is not there") == std::string::npos &&
            problem.find("has no triangles") == std::string::npos)
            return false;
    }
    return true;
}

Groom goldenGroom() {
    SurfaceMesh mesh;
    mesh.positions = {{0.0f, 0.0f, 0.0f}, {0.1f, 0.0f, 0.0f}, {0.1f, 0.05f, 0.1f}, {0.0f, -0.0f, 0.1f}};
    mesh.normals = {{0.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.6f, 0.8f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    mesh.triangles = {{0, 3, 1}, {1, 3, 2}};
    mesh.cornerUvs = {{0.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 0.0f}, {1.0f, 0.0f}, {-1.5f, 1.0f}, {1.0f, 1e9f}};
    mesh.parts = {
        {.name = "skin", .firstTriangle = 0, .triangleCount = 1, .baseColour = glm::vec3(0.5f), .texture = "colour"},
        {.name = "caf\xe9 髪", .firstTriangle = 1, .triangleCount = 1, .baseColour = glm::vec3(0.25f), .texture = {}}};
    mesh.madeAtlas = true;
    Groom groom = makeGroom(std::move(mesh));
    groom.partSettings.edit()[1] = {.growsHair = false, .visible = false};

    groom.groups.edit() = {{"crown", {}}, {"beard-2", {}}};
    int step = 0;
    for (Group& group : groom.groups.edit()) {
        // Every parameter that format 1 began with gets its own value, whatever defaults become.
        HairParams& p = group.params;
        const auto next = [&] { return static_cast<float>(++step) / 1024.0f; };
        p.general = {.segments = 2 + static_cast<int>(&group - groom.groups->data()),
                     .density = {next(), "density"},
                     .samples = 4,
                     .interpolation = {1},
                     .cut = {next(), {}},
                     .scale = {next(), "half"},
                     .randomScale = {next(), {}},
                     .rootThickness = {next() / 64, {}},
                     .tipThickness = {next() / 64, {}},
                     .displacement = {-next() / 64, {}},
                     .keepOutside = false};
        p.colour = {.root = {{next(), next(), next()}, "colour"},
                    .tip = {{next(), next(), next()}, {}},
                    .rootOpacity = {next(), {}},
                    .tipOpacity = {next(), {}},
                    .hueVariation = {next(), {}},
                    .valueVariation = {next(), {}},
                    .mutant = {{next(), next(), next()}},
                    .mutants = {next(), {}}};
        p.frizz = {.root = {next(), {}}, .tip = {next(), "half"}, .frequency = {{next(), 2.0f, 3.0f}, {}}};
        p.kink = {.root = {next(), {}}, .tip = {next(), {}}, .frequency = {{4.0f, next(), 6.0f}, "half"}};
    }
    groom.counts.edit() = {.guides = 5, .hairs = 123, .shownHairs = 45, .parts = 3, .seed = 77, .groupMap = {"half"}};

    Map density(70, 3, 1, TexelFormat::U8, 1.0f);
    density.setTexel(65, 2, 0, 0.25f);
    Map half(2, 130, 1, TexelFormat::U16, 0.5f);
    half.setTexel(1, 129, 0, 0.125f);
    half.flipV = true;
    Map colour(5, 5, 3, TexelFormat::F32, 0.75f);
    colour.setTexel(4, 4, 1, 0.375f);
    colour.srgb = true;
    groom.maps.set("density", std::move(density));
    groom.maps.set("half", std::move(half));
    groom.maps.set("colour", std::move(colour));

    for (std::uint32_t i = 0; i < 3; ++i) {
        const auto group = static_cast<std::uint8_t>(i % 2);
        std::vector<glm::vec3> points;
        for (int k = 0; k < 3 + group; ++k)
            points.emplace_back(static_cast<float>(k) / 64.0f, static_cast<float>(i) / 32.0f, -0.5f);
        groom.guides.appendWithId(10 * i + 3, {i % 2, 0.25f, 0.5f}, group, points);
    }
    groom.guides.setNextId(99);
    return groom;
}

}  // namespace whorl::testing
