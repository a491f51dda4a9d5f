// SPDX-License-Identifier: Apache-2.0
#include "core/commands/facts.h"

#include "core/param/path.h"
#include "core/surface/parting_line.h"
#include "core/surface/surface_point.h"

#include <nlohmann/json.hpp>

namespace whorl {
namespace {

using Json = nlohmann::ordered_json;

Json vectorJson(const glm::vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

std::string_view formatName(TexelFormat format) {
    return format == TexelFormat::U8 ? "8 bit" : format == TexelFormat::U16 ? "16 bit" : "float";
}

glm::vec3 middleOf(const SurfaceMesh& mesh, std::uint32_t triangle) {
    return positionAt(mesh, {triangle, 1.0f / 3.0f, 1.0f / 3.0f});
}

double squareMetres(const SurfaceMesh& mesh) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) sum += triangleArea(mesh, t);
    return sum;
}

}  // namespace

std::string groomFactsText(const Groom& groom) {
    const SurfaceMesh& mesh = *groom.mesh;
    const Bounds bounds = boundsOf(mesh);
    const auto metres = [](float value) { return paramText(static_cast<double>(value)); };
    std::string text;
    const auto line = [&](const std::string& name, const std::string& value) { text += name + ": " + value + "\n"; };
    line("triangles", std::to_string(mesh.triangleCount()));
    line("vertices", std::to_string(mesh.positions.size()));
    if (!bounds.empty()) {
        line("size",
             metres(bounds.size().x) + " x " + metres(bounds.size().y) + " x " + metres(bounds.size().z) + " m");
    }
    line("UVs", mesh.madeAtlas ? "made by Whorl" : "from the file");
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        const bool grows = groom.growsHair(static_cast<std::uint32_t>(i));
        line("part", mesh.parts[i].name + ", " + std::to_string(mesh.parts[i].triangleCount) + " triangles" +
                         (grows ? "" : ", grows no hair"));
    }
    for (const MapSet::Entry& entry : groom.maps.entries()) {
        line("map", entry.name + ", " + std::to_string(entry.map->width()) + " x " +
                        std::to_string(entry.map->height()) + ", " +
                        (entry.map->channels() == 1 ? "numbers" : "colours") + ", " +
                        std::string(formatName(entry.map->format())));
    }
    for (std::size_t g = 0; g < groom.groups->size(); ++g) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < groom.guides.count(); ++i) count += groom.guides.group(i) == g ? 1u : 0u;
        line("group", (*groom.groups)[g].name + ", " + std::to_string(count) + " guides of " +
                          std::to_string((*groom.groups)[g].params.general.segments + 1) + " points");
    }
    for (const Parting& parting : *groom.partings) {
        line("parting", std::to_string(parting.id) + (parting.name.empty() ? "" : ", " + parting.name) + ", " +
                            std::to_string(parting.points.size()) + " points, " + metres(partingLength(mesh, parting)) +
                            " m");
    }
    for (const FieldStroke& stroke : *groom.strokes) {
        const auto kind = std::string(strokeKindNames[static_cast<std::size_t>(stroke.kind)]);
        line("stroke", std::to_string(stroke.id) + ", " + kind + ", " + std::to_string(stroke.points.size()) +
                           " points, weight " + metres(stroke.weight) +
                           (stroke.radius > 0.0f ? ", radius " + metres(stroke.radius) + " m" : ""));
    }
    line("guides", std::to_string(groom.guides.count()));
    line("hairs", std::to_string(groom.counts->hairs));
    return text;
}

std::string groomFactsJson(const Groom& groom, const Problems& problems, const std::string& kind) {
    const SurfaceMesh& mesh = *groom.mesh;
    const Bounds bounds = boundsOf(mesh);
    Json json;
    json["kind"] = kind;
    json["triangles"] = mesh.triangleCount();
    json["vertices"] = mesh.positions.size();
    if (!bounds.empty()) json["bounds"] = {{"min", vectorJson(bounds.min)}, {"max", vectorJson(bounds.max)}};
    json["area"] = squareMetres(mesh);
    json["made_atlas"] = mesh.madeAtlas;
    json["parts"] = Json::array();
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        json["parts"].push_back({{"name", mesh.parts[i].name},
                                 {"triangles", mesh.parts[i].triangleCount},
                                 {"grows_hair", groom.growsHair(static_cast<std::uint32_t>(i))}});
    }
    json["maps"] = Json::array();
    for (const MapSet::Entry& entry : groom.maps.entries()) {
        json["maps"].push_back({{"name", entry.name},
                                {"width", entry.map->width()},
                                {"height", entry.map->height()},
                                {"channels", entry.map->channels()},
                                {"format", formatName(entry.map->format())}});
    }
    json["groups"] = Json::array();
    for (const Group& group : *groom.groups) json["groups"].push_back(group.name);
    json["partings"] = Json::array();
    for (const Parting& parting : *groom.partings) {
        json["partings"].push_back({{"id", parting.id},
                                    {"name", parting.name},
                                    {"points", parting.points.size()},
                                    {"length", partingLength(mesh, parting)}});
    }
    json["strokes"] = Json::array();
    for (const FieldStroke& stroke : *groom.strokes) {
        json["strokes"].push_back({{"id", stroke.id},
                                   {"kind", strokeKindNames[static_cast<std::size_t>(stroke.kind)]},
                                   {"points", stroke.points.size()},
                                   {"weight", stroke.weight},
                                   {"radius", stroke.radius}});
    }
    json["guides"] = groom.guides.count();
    Json parameters = Json::object();
    for (const std::string& path : groomPaths(groom)) {
        const auto value = groomValue(groom, path);
        if (!value) continue;
        std::visit(
            [&](const auto& v) {
                if constexpr (std::is_same_v<std::decay_t<decltype(v)>, glm::vec3>) {
                    parameters[path] = vectorJson(v);
                } else {
                    parameters[path] = v;
                }
            },
            *value);
    }
    json["parameters"] = std::move(parameters);
    json["problems"] = problems;
    // Names come from strangers' files and need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string singularitiesText(const DirectionField& field, const SurfaceMesh& mesh) {
    std::string text;
    int sum = 0;
    const std::vector<FieldSingularity> all = field.singularities();
    for (const FieldSingularity& place : all) {
        const glm::vec3 at = middleOf(mesh, place.triangle);
        text += (place.index > 0 ? "+" : "") + std::to_string(place.index) + " at ";
        for (int k = 0; k < 3; ++k) text += (k > 0 ? "," : "") + paramText(static_cast<double>(at[k]));
        text += " in triangle " + std::to_string(place.triangle) + "\n";
        sum += place.index;
    }
    return text + std::to_string(all.size()) + " in all, sum " + std::to_string(sum);
}

std::string singularitiesJson(const DirectionField& field, const SurfaceMesh& mesh) {
    Json json;
    json["singularities"] = Json::array();
    int sum = 0;
    for (const FieldSingularity& place : field.singularities()) {
        json["singularities"].push_back({{"index", place.index},
                                         {"position", vectorJson(middleOf(mesh, place.triangle))},
                                         {"triangle", place.triangle}});
        sum += place.index;
    }
    json["sum"] = sum;
    return json.dump(2);
}

}  // namespace whorl
