// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command_list.h"
#include "core/commands/facts.h"
#include "core/commands/vertex_guides.h"
#include "core/hair/explain.h"
#include "core/param/path.h"

#include <algorithm>

namespace whorl {
namespace {

using Arguments = std::span<const std::string>;

Result<std::string> set(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() < 2) return usageError("set PATH VALUE");
    if (!context.hasGroom) return noGroomError();
    std::string value = arguments[1];
    for (const std::string& word : arguments.subspan(2)) value += " " + word;
    if (auto done = setGroomValue(context.groom, arguments[0], value); !done) return done.error();
    return std::string();
}

Result<std::string> get(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 1) return usageError("get PATH");
    if (!context.hasGroom) return noGroomError();
    const auto value = groomValue(context.groom, arguments[0]);
    if (!value) return value.error();
    return paramText(*value);
}

Result<std::string> info(CommandContext& context, Arguments arguments, Progress&) {
    if (!arguments.empty()) return usageError("info");
    if (!context.hasGroom) return noGroomError();
    return groomFactsText(context.groom);
}

Result<std::string> place(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.size() > 2) return usageError("place-guides [COUNT] [LENGTH]");
    if (!context.hasGroom) return noGroomError();
    auto count = static_cast<std::size_t>(context.groom.counts->guides);
    float length = 0.0f;
    if (!arguments.empty()) {
        const auto number = numberFrom<std::uint32_t>(arguments[0], 1, 1000000);
        if (!number) return Error{"The number of guides must be from 1 to 1000000, not \"" + arguments[0] + "\"."};
        count = *number;
    }
    if (arguments.size() > 1) {
        const auto number = numberFrom<float>(arguments[1], 1e-6f, 1000.0f);
        if (!number)
            return Error{"The length of guides must be from 0.000001 to 1000 metres, not \"" + arguments[1] + "\"."};
        length = *number;
    }
    const auto surface = context.surfaces.get(context.groom.mesh);
    if (auto done = placeGuides(context.groom, *surface, count, length, false, progress); !done) return done.error();
    return std::to_string(context.groom.guides.count()) + " guides";
}

Result<std::string> placeOnVertices(CommandContext& context, Arguments arguments, Progress& progress) {
    constexpr const char* usage =
        "place-guides-on-vertices [LENGTH] [PER-SQUARE-METRE] [LENGTH-MAP|-] [corners|blurred|texels]";
    if (arguments.size() > 4) return usageError(usage);
    if (!context.hasGroom) return noGroomError();
    VertexGuides options;
    if (!arguments.empty()) {
        const auto number = numberFrom<float>(arguments[0], 0.0f, 1000.0f);
        if (!number) return Error{"The length of guides must be from 0 to 1000 metres, not \"" + arguments[0] + "\"."};
        options.length = *number;
    }
    if (arguments.size() > 1) {
        const auto number = numberFrom<float>(arguments[1], 0.0f, 1e12f);
        if (!number) return Error{"Guides a square metre must be 0 or more, not \"" + arguments[1] + "\"."};
        options.perSquareMetre = *number;
    }
    if (arguments.size() > 2 && arguments[2] != "-") options.lengthMap = arguments[2];
    if (arguments.size() > 3) {
        const auto way = std::find(triangleDensityNames.begin(), triangleDensityNames.end(), arguments[3]);
        if (way == triangleDensityNames.end()) return usageError(usage);
        options.density = static_cast<TriangleDensity>(way - triangleDensityNames.begin());
    }
    const auto surface = context.surfaces.get(context.groom.mesh);
    if (auto done = placeGuidesOnVertices(context.groom, *surface, options, progress); !done) return done.error();
    return std::to_string(context.groom.guides.count()) + " guides";
}

Result<std::string> tessellate(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.empty() || arguments.size() > 2) return usageError("tessellate-guides SEGMENTS [GROUP]");
    if (!context.hasGroom) return noGroomError();
    const auto segments = numberFrom<int>(arguments[0], 1, 100);
    if (!segments) return Error{"Guides have 1 to 100 segments, not \"" + arguments[0] + "\"."};
    const int group = arguments.size() > 1 ? context.groom.groupIndex(arguments[1]) : 0;
    if (group < 0) return Error{"There is no group \"" + arguments[1] + "\"."};
    if (auto done = tessellateGuides(context.groom, group, *segments); !done) return done.error();
    return std::string();
}

Result<std::string> explain(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.size() != 1) return usageError("explain HAIR");
    if (!context.hasGroom) return noGroomError();
    const auto id = numberFrom<std::uint32_t>(arguments[0], 0, UINT32_MAX);
    if (!id) return Error{"A hair is named by its number from 0, not \"" + arguments[0] + "\"."};
    const auto hair = explainHair(context.groom, context.surfaces.get(context.groom.mesh), *id, 0, progress);
    if (!hair) return hair.error();
    return explanationText(*hair);
}

Result<std::string> clearGuides(CommandContext& context, Arguments arguments, Progress&) {
    if (!arguments.empty()) return usageError("clear-guides");
    if (!context.hasGroom) return noGroomError();
    context.groom.guides.clear();
    return std::string();
}

Result<std::string> fillMap(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() < 2 || arguments.size() > 3) return usageError("fill-map NAME VALUE [SIZE]");
    if (!context.hasGroom) return noGroomError();
    const auto value = numberFrom<float>(arguments[1], 0.0f, 1.0f);
    if (!value) return Error{"A map is filled with a number from 0 to 1, not \"" + arguments[1] + "\"."};
    const Map* old = context.groom.maps.find(arguments[0]);
    int width = old != nullptr ? old->width() : 1024, height = old != nullptr ? old->height() : 1024;
    if (arguments.size() == 3) {
        const auto size = numberFrom<int>(arguments[2], 1, Map::maxSize);
        if (!size) return Error{"The size of a map must be from 1 to 16384 texels, not \"" + arguments[2] + "\"."};
        width = height = *size;
    }
    const TexelFormat format = old != nullptr ? old->format() : TexelFormat::U16;
    Map map(std::max(width, 1), std::max(height, 1), old != nullptr ? old->channels() : 1, format, *value);
    if (old != nullptr) {
        map.flipV = old->flipV;
        map.srgb = old->srgb;
    }
    context.groom.maps.set(arguments[0], std::move(map));
    context.groom.countAnew();
    return std::string();
}

Result<std::string> grow(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 2) return usageError("grow PART on|off");
    if (!context.hasGroom) return noGroomError();
    const auto wish = switchFrom(arguments[1]);
    if (!wish) return usageError("grow PART on|off");
    const std::vector<MeshPart>& parts = context.groom.mesh->parts;
    bool found = false;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].name != arguments[0] && arguments[0] != "*") continue;
        found = true;
        if ((*context.groom.partSettings)[i].growsHair != *wish) context.groom.partSettings.edit()[i].growsHair = *wish;
    }
    if (found) return std::string();
    std::string names;
    for (const MeshPart& part : parts) names += (names.empty() ? "" : ", ") + part.name;
    return Error{"The mesh has no part \"" + arguments[0] + "\"; parts are " + names + "."};
}

Result<std::string> texture(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 2) return usageError("texture PART MAP|none");
    if (!context.hasGroom) return noGroomError();
    const std::string map = arguments[1] == "none" ? std::string() : arguments[1];
    if (!map.empty() && !context.groom.maps.find(map)) return Error{"There is no map \"" + map + "\"."};
    const auto named = [&](const MeshPart& part) { return arguments[0] == "*" || part.name == arguments[0]; };
    if (std::ranges::none_of(context.groom.mesh->parts, named))
        return Error{"The mesh has no part \"" + arguments[0] + "\"; the command parts lists them."};
    for (MeshPart& part : context.groom.mesh.edit().parts) {
        if (named(part)) part.texture = map;
    }
    return std::string();
}

Result<std::string> parts(CommandContext& context, Arguments arguments, Progress&) {
    if (!arguments.empty()) return usageError("parts");
    if (!context.hasGroom) return noGroomError();
    std::string text;
    for (std::size_t i = 0; i < context.groom.mesh->parts.size(); ++i) {
        text += context.groom.mesh->parts[i].name +
                (context.groom.growsHair(static_cast<std::uint32_t>(i)) ? " on\n" : " off\n");
    }
    return text;
}

}  // namespace

void addEditCommands(std::vector<Command>& list) {
    list.push_back({"set", "set PATH VALUE", "Sets a parameter (set groups/hair/frizz/tip 0.01).", true, set});
    list.push_back({"get", "get PATH", "Prints a parameter.", false, get});
    list.push_back({"info", "info", "Prints what the groom holds.", false, info});
    list.push_back({"place-guides", "place-guides [COUNT] [LENGTH]",
                    "Replaces all guides by evenly spread ones that stand up, LENGTH metres long.", true, place});
    list.push_back({"place-guides-on-vertices",
                    "place-guides-on-vertices [LENGTH] [PER-SQUARE-METRE] [LENGTH-MAP|-] [corners|blurred|texels]",
                    "Replaces all guides by one on every vertex where hair grows, and more in triangles that are too "
                    "large for as many a square metre; their segments grow longer from root to tip. The density of a "
                    "triangle is the average of its corners, of its corners on blurred maps, or of all its texels.",
                    true, placeOnVertices});
    list.push_back({"tessellate-guides", "tessellate-guides SEGMENTS [GROUP]",
                    "Gives the guides and hairs of a group another number of segments, along smooth curves through the "
                    "points of the guides.",
                    true, tessellate});
    list.push_back(
        {"explain", "explain HAIR", "Says why a hair is as it is: its guides, maps and every step.", false, explain});
    list.push_back({"clear-guides", "clear-guides", "Deletes all guides.", true, clearGuides});
    list.push_back(
        {"fill-map", "fill-map NAME VALUE [SIZE]", "Fills a map with one number, or makes it.", true, fillMap});
    list.push_back(
        {"grow", "grow PART on|off", "Says whether hair grows on a part of the mesh (* for all).", true, grow});
    list.push_back({"reference", "reference", "Prints the reference of all parameters (Markdown).", false,
                    [](CommandContext&, std::span<const std::string>, Progress&) -> Result<std::string> {
                        return parameterReference();
                    }});
    list.push_back({"texture", "texture PART MAP|none",
                    "Gives a part of the mesh (* for all) a colour map of the groom as its texture.", true, texture});
    list.push_back({"parts", "parts", "Lists the parts of the mesh and whether they grow hair.", false, parts});
}

}  // namespace whorl
