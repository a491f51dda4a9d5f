// SPDX-License-Identifier: Apache-2.0
#include "core/param/path.h"

#include "core/model/groom.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <sstream>

namespace whorl {
namespace {

std::vector<std::string_view> split(std::string_view path) {
    std::vector<std::string_view> words;
    for (;;) {
        const std::size_t slash = path.find('/');
        words.push_back(path.substr(0, slash));
        if (slash == std::string_view::npos) return words;
        path.remove_prefix(slash + 1);
    }
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

/// A path taken apart: `group` is -1 for blocks of the whole groom; `block` is "modifiers/NAME" for a modifier.
struct Place {
    int group = -1;
    std::string block;
    std::string_view param;
    bool map = false;
};

Result<Place> parsePath(const Groom& groom, std::string_view path) {
    auto words = split(path);
    Place place;
    if (words.size() > 1 && words.back() == "map") {
        place.map = true;
        words.pop_back();
    }
    std::string begins;
    bool ofGroom = false;
    Groom::eachBlock(groom, [&](const BlockInfo& info, const auto&) {
        begins += std::string(info.id) + "/, ";
        ofGroom = ofGroom || words[0] == info.id;
    });
    if (ofGroom && words.size() == 2) {
        place.block = std::string(words[0]);
        place.param = words[1];
        return place;
    }
    if (words[0] != "groups" && !ofGroom) {
        begins.resize(begins.size() - 2);
        return Error{"\"" + std::string(path) + "\": paths begin with " + begins + " or groups/."};
    }
    const bool modifier = words.size() > 2 && words[2] == "modifiers";
    if (words[0] != "groups" || words.size() != (modifier ? 5u : 4u)) {
        return Error{"\"" + std::string(path) +
                     "\": write counts/PARAMETER, groups/GROUP/BLOCK/PARAMETER or "
                     "groups/GROUP/modifiers/MODIFIER/PARAMETER."};
    }
    place.group = groom.groupIndex(words[1]);
    if (place.group < 0) {
        std::vector<std::string> names;
        for (const Group& group : *groom.groups) names.push_back(group.name);
        return Error{"There is no group \"" + std::string(words[1]) + "\"; groups are " + listed(names) + "."};
    }
    place.block = std::string(words[2]);
    if (modifier) place.block += "/" + std::string(words[3]);
    place.param = words.back();
    return place;
}

/// Calls `use` with that of `refs`, the parameters of `parent`, which `place` names.
template <class Use>
Result<void> withParam(std::span<const ParamRef> refs, const std::string& parent, const Place& place, Use&& use) {
    std::vector<std::string> names;
    for (const ParamRef& ref : refs) {
        if (ref.info.id == place.param) return use(ref);
        names.emplace_back(ref.info.id);
    }
    return Error{parent + " has no parameter " + std::string(place.param) + "; parameters are " + listed(names) + "."};
}

template <class Use>
Result<void> withParam(HairParams& hair, const Place& place, std::string_view path, Use&& use) {
    std::vector<ParamRef> refs;
    std::vector<std::string> blocks;
    HairParams::eachWithModifiers(hair, [&](const BlockInfo& info, auto& block) {
        blocks.emplace_back(info.id);
        if (info.id == place.block) refs = paramsOf(block);
    });
    const auto parent = std::string(path.substr(0, path.find('/', path.find('/') + 1)));
    if (refs.empty()) return Error{parent + " has no block " + place.block + "; blocks are " + listed(blocks) + "."};
    return withParam(refs, parent + "/" + place.block, place, use);
}

Result<void> setMapName(const Groom& groom, const ParamRef& ref, const ParamValue& value) {
    std::string* map = paramMap(ref);
    if (!map) return Error{std::string(ref.info.id) + " is not driven by a map."};
    const auto* name = std::get_if<std::string>(&value);
    if (!name) return Error{"Give the name of a map, or \"\" for none."};
    if (!name->empty() && !groom.maps.find(*name)) {
        std::vector<std::string> names;
        for (const auto& entry : groom.maps.entries()) names.push_back(entry.name);
        return Error{"There is no map \"" + *name + "\"" +
                     (names.empty() ? "; the groom has no maps." : "; maps are " + listed(names) + ".")};
    }
    *map = *name;
    return {};
}

void resampleGuides(Groom& groom, int group) {
    const int segments = (*groom.groups)[static_cast<std::size_t>(group)].params.general.segments;
    for (std::size_t i = 0; i < groom.guides.count(); ++i) {
        if (groom.guides.group(i) != group) continue;
        if (groom.guides.points(i).size() == static_cast<std::size_t>(segments) + 1) continue;
        groom.guides.setPoints(i, resampled(groom.guides.points(i), segments));
    }
}

}  // namespace

Result<ParamValue> groomValue(const Groom& groom, std::string_view path) {
    const auto place = parsePath(groom, path);
    if (!place) return place.error();
    ParamValue value;
    const auto take = [&](const ParamRef& ref) -> Result<void> {
        if (!place->map) {
            value = paramValue(ref);
        } else if (const std::string* map = paramMap(ref)) {
            value = *map;
        } else {
            return Error{std::string(ref.info.id) + " is not driven by a map."};
        }
        return {};
    };
    Result<void> found;
    if (place->group >= 0) {
        HairParams hair = (*groom.groups)[static_cast<std::size_t>(place->group)].params;
        found = withParam(hair, *place, path, take);
    } else {
        Groom::eachBlock(groom, [&](const BlockInfo& info, const auto& block) {
            if (info.id != place->block) return;
            auto copy = *block;
            found = withParam(paramsOf(copy), place->block, *place, take);
        });
    }
    if (!found) return found.error();
    return value;
}

Result<void> setGroomValue(Groom& groom, std::string_view path, const ParamValue& value) {
    const auto place = parsePath(groom, path);
    if (!place) return place.error();
    const auto set = [&](const ParamRef& ref) {
        const bool name = place->map || std::holds_alternative<MapName*>(ref.target);
        return name ? setMapName(groom, ref, value) : setParamValue(ref, value);
    };
    // On copies first: a refused value must not unshare anything.
    if (place->group < 0) {
        const Cow<CountParams> before = groom.counts;
        Result<void> done;
        Groom::eachBlock(groom, [&](const BlockInfo& info, auto& block) {
            if (info.id != place->block) return;
            auto copy = *block;
            done = withParam(paramsOf(copy), place->block, *place, set);
            if (done && !(copy == *block)) block = {std::move(copy)};
        });
        if (done && (before->hairs != groom.counts->hairs || before->groupMap != groom.counts->groupMap))
            groom.countAnew();
        return done;
    }
    const auto index = static_cast<std::size_t>(place->group);
    HairParams hair = (*groom.groups)[index].params;
    if (const auto done = withParam(hair, *place, path, set); !done) return done;
    if (hair == (*groom.groups)[index].params) return {};
    const bool resample = hair.general.segments != (*groom.groups)[index].params.general.segments;
    const bool recount = hair.general.density != (*groom.groups)[index].params.general.density;
    groom.groups.edit()[index].params = std::move(hair);
    if (recount) groom.countAnew();
    if (resample) resampleGuides(groom, place->group);
    return {};
}

std::vector<std::string> groomPaths(const Groom& groom) {
    std::vector<std::string> paths;
    Groom::eachBlock(groom, [&](const BlockInfo& info, const auto& block) {
        auto copy = *block;
        for (const ParamRef& ref : paramsOf(copy))
            paths.push_back(std::string(info.id) + "/" + std::string(ref.info.id));
    });
    for (const Group& group : *groom.groups) {
        HairParams params = group.params;
        HairParams::eachWithModifiers(params, [&](const BlockInfo& info, auto& block) {
            for (const ParamRef& ref : paramsOf(block)) {
                paths.push_back("groups/" + group.name + "/" + std::string(info.id) + "/" + std::string(ref.info.id));
            }
        });
    }
    return paths;
}

namespace {

void writeBlock(std::ostream& out, std::string_view path, std::string_view label, std::string_view tip,
                std::span<const ParamRef> refs) {
    const auto shown = [](const ParamInfo& info, double value) {
        // Whole numbers whole; six digits of others, which are stored as floats.
        char text[32];
        const double number = value * info.shownScale;
        const bool whole = std::abs(number) < 1e12 && number == std::round(number);
        const auto end =
            whole ? std::to_chars(std::begin(text), std::end(text), static_cast<std::int64_t>(number)).ptr
                  : std::to_chars(std::begin(text), std::end(text), number, std::chars_format::general, 6).ptr;
        return std::string(text, end) + (info.unit.empty() ? "" : " " + std::string(info.unit));
    };
    out << "## " << label << "\n\n" << tip << "\n\n";
    out << "| path | name | default | range | map | what it does |\n|---|---|---|---|---|---|\n";
    for (const ParamRef& ref : refs) {
        const ParamInfo& info = ref.info;
        const ParamValue value = paramValue(ref);
        const auto* number = std::get_if<double>(&value);
        const bool colour =
            std::holds_alternative<DrivenColour*>(ref.target) || std::holds_alternative<Colour*>(ref.target);
        out << "| `" << path << info.id << "` | " << info.label << " | ";
        out << (number ? shown(info, *number) : paramText(value)) << " | ";
        if (!info.choices.empty()) {
            for (std::size_t i = 0; i < info.choices.size(); ++i) out << (i > 0 ? ", " : "") << info.choices[i];
        } else if (colour) {
            out << "linear colour";
        } else if (std::holds_alternative<bool>(value)) {
            out << "on, off";
        } else if (!std::holds_alternative<std::string>(value)) {
            out << shown(info, info.min) << " to " << shown(info, info.max);
        }
        const bool driven = paramMap(ref) && !std::holds_alternative<MapName*>(ref.target);
        out << " | " << (driven ? "yes" : "") << " | " << info.tip << " |\n";
    }
    out << "\n";
}

}  // namespace

std::string parameterReference() {
    std::ostringstream out;
    out << "# Parameters\n\nEvery number marked with a map is multiplied by that map's value at the root of each hair. "
           "`GROUP` stands for the name of a group; a new groom has one, `hair`.\n\n";
    const Groom groom;
    Groom::eachBlock(groom, [&](const BlockInfo& info, const auto& block) {
        auto copy = *block;
        writeBlock(out, std::string(info.id) + "/", info.label, info.tip, paramsOf(copy));
    });
    HairParams hair;
    HairParams::each(hair, [&](const BlockInfo& info, auto& block) {
        writeBlock(out, "groups/GROUP/" + std::string(info.id) + "/", info.label, info.tip, paramsOf(block));
    });
    out << "# Modifiers\n\nA group has a list of modifiers, which work on its hairs from top to bottom, after the "
           "blocks "
           "above and before strands and the cut. `MODIFIER` stands for the name of one; each kind may be there many "
           "times.\n\n";
    const std::vector<BlockInfo> kinds = modifierKinds();
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        Modifier modifier;
        modifier.params = defaultModifierParams(kind);
        writeBlock(out, "groups/GROUP/modifiers/MODIFIER/",
                   std::string(kinds[kind].label) + " (`" + std::string(kinds[kind].id) + "`)", kinds[kind].tip,
                   paramsOf(modifier));
    }
    return std::move(out).str();
}

}  // namespace whorl
