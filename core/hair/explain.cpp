// SPDX-License-Identifier: Apache-2.0
#include "core/hair/explain.h"

#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <optional>

namespace whorl {
namespace {

std::string number(float value) {
    // Five digits: for people, and floats have not many more.
    char text[32];
    const auto end = std::to_chars(std::begin(text), std::end(text), value, std::chars_format::general, 5).ptr;
    return {text, end};
}

std::string vector(const glm::vec3& v) {
    return number(v.x) + " " + number(v.y) + " " + number(v.z);
}

void addGuides(const Groom& groom, const GuideIndex& index, HairExplanation& hair) {
    const HairRoot& root = hair.root;
    const GeneralParams& general = (*groom.groups)[root.group].params.general;
    std::array<Neighbour, GuideIndex::maxNeighbours> found;
    const std::size_t count = index.guidesOf(root.group, general, root.position, root.normal, found);
    const auto explained = [&](const GuideRoot& guide, float weight) {
        return ExplainedGuide{guide.guide, guide.id, weight, glm::distance(guide.position, root.position),
                              index.partings().detour({root.position, root.normal}, {guide.position, guide.normal})};
    };
    for (std::size_t j = 0; j < count; ++j) hair.guides.push_back(explained(*found[j].root, found[j].weight));
    std::stable_sort(hair.guides.begin(), hair.guides.end(),
                     [](const ExplainedGuide& a, const ExplainedGuide& b) { return a.weight > b.weight; });
    if (index.partings().empty()) return;
    std::vector<ExplainedGuide> separated;
    for (const GuideRoot& guide : index.rootsOf(root.group)) {
        const ExplainedGuide here = explained(guide, 0.0f);
        if (here.detour == PartingIndex::separate) separated.push_back(here);
    }
    std::stable_sort(separated.begin(), separated.end(),
                     [](const ExplainedGuide& a, const ExplainedGuide& b) { return a.distance < b.distance; });
    // Only those that would have shaped it: nearer than the farthest that does.
    float farthest = hair.guides.empty() ? 1e30f : 0.0f;
    for (const ExplainedGuide& guide : hair.guides) farthest = std::max(farthest, guide.distance);
    std::erase_if(separated, [&](const ExplainedGuide& guide) { return guide.distance > farthest; });
    separated.resize(std::min(separated.size(), std::max<std::size_t>(count, 3)));
    hair.separated = std::move(separated);
}

void addMaps(const Groom& groom, HairExplanation& hair) {
    const auto add = [&](const std::string& parameter, const std::string& name) {
        const Map* map = name.empty() ? nullptr : groom.maps.find(name);
        if (map && !map->empty()) hair.maps.push_back({parameter, name, map->sample(hair.root.uv)});
    };
    HairParams params = (*groom.groups)[hair.root.group].params;
    HairParams::each(params, [&](const BlockInfo& block, auto& values) {
        for (const ParamRef& ref : paramsOf(values))
            if (const std::string* map = paramMap(ref))
                add(std::string(block.id) + "/" + std::string(ref.info.id), *map);
    });
    add("group_map", groom.counts->groupMap.name);
}

}  // namespace

Result<HairExplanation> explainHair(const Groom& groom, std::shared_ptr<const Surface> surface, std::uint32_t id,
                                    std::uint32_t count, Progress& progress) {
    const DensityLookup density(groom);
    const auto sampler = RootSampler::build(groom, density, progress);
    if (!sampler) return sampler.error();
    if (sampler->empty()) return Error{"No hair grows: no part grows hair, or the density is zero everywhere."};
    const double hairs = count > 0 ? static_cast<double>(count) : std::max(groom.counts->hairs, 0);
    const RootSource source{*groom.mesh, *sampler, density, requestFor(*groom.counts, *sampler, hairs)};
    const std::uint32_t most = sampler->limitOf(255, source.request.rate);
    const bool even = (id & evenId) != 0;
    source.sampler.prepare(source.request, progress);
    if (numberOf(id) >= most || (even && !density.anyEven()))
        return Error{"There is no hair " + std::to_string(id) + "; numbers of this groom's hairs are below " +
                     std::to_string(most) + "."};
    const GuideIndex index(groom);
    const TraitLookup lookup(groom);
    const RootSampler::Candidate place = sampler->candidate(source.request.seed, id);
    HairExplanation hair;
    hair.root = rootAt(source, id, place.point);
    const Group& group = (*groom.groups)[hair.root.group];
    hair.group = group.name;
    hair.density = density.at(hair.root.point.triangle, hair.root.uv);
    hair.traits = lookup.at(hair.root);
    addGuides(groom, index, hair);
    addMaps(groom, hair);
    std::optional<SkinGuard> guard;
    if (group.params.general.keepOutside) guard.emplace(surface->sharedSkin());
    hair.stages = referenceStages(groom, index, hair.root, lookup, guard ? &*guard : nullptr, progress);
    if (even != density.isEven(hair.root.group)) {
        hair.why =
            even ? "Hairs of its group do not keep apart, so they have other numbers."
                 : "Hairs of its group keep apart, so they have other numbers: from " + std::to_string(evenId) + " on.";
    } else if (!(hair.density > 0.0f)) {
        hair.why = "The density at its root is zero.";
    } else if (numberOf(id) >= sampler->limitOf(place.code, source.request.rate)) {
        hair.why = "Its root is there for more hair than the density asks for.";
    } else if (hair.guides.empty()) {
        hair.why = hair.separated.empty() ? "Its group has no guides." : "Partings separate it from all guides.";
    } else if (cutEnd(hair.traits.cut, group.params.general.segments).vertices == 0) {
        hair.why = "It is cut away at its root.";
    } else if (!(hair.traits.scale > 0.0f)) {
        hair.why = "Its length is zero.";
    }
    hair.grows = hair.why.empty();
    return hair;
}

std::string explanationText(const HairExplanation& hair) {
    std::string text;
    const auto line = [&](const std::string& name, const std::string& value) { text += name + ": " + value + "\n"; };
    const HairRoot& root = hair.root;
    line("hair", std::to_string(root.id));
    line("grows", hair.grows ? "yes" : "no. " + hair.why);
    line("root", vector(root.position) + " m, triangle " + std::to_string(root.point.triangle));
    line("UV", number(root.uv.x) + " " + number(root.uv.y));
    line("group", hair.group);
    line("density", number(hair.density));
    for (const ExplainedGuide& guide : hair.guides) {
        line("guide",
             std::to_string(guide.id) + ", weight " + number(guide.weight) + ", " + number(guide.distance) + " m away" +
                 (guide.detour > 1.0f ? ", counts " + number(guide.detour) + " times as far round a parting" : ""));
    }
    for (const ExplainedGuide& guide : hair.separated)
        line("guide beyond a parting", std::to_string(guide.id) + ", " + number(guide.distance) + " m away");
    for (const ExplainedMap& map : hair.maps) line("map", map.parameter + " by " + map.map + ": " + number(map.value));
    const HairTraits& t = hair.traits;
    line("cut", number(t.cut));
    line("length", number(t.scale) + " of the guides");
    line("thickness", number(t.rootWidth * 1000.0f) + " to " + number(t.tipWidth * 1000.0f) + " mm");
    line("frizz", number(t.frizzRoot) + " to " + number(t.frizzTip));
    line("kink", number(t.kinkRoot) + " to " + number(t.kinkTip));
    const std::vector<glm::vec3>* before = nullptr;
    for (const HairStage& stage : hair.stages) {
        float length = 0.0f, moved = 0.0f;
        for (std::size_t v = 1; v < stage.points.size(); ++v)
            length += glm::distance(stage.points[v - 1], stage.points[v]);
        for (std::size_t v = 0; before && v < std::min(before->size(), stage.points.size()); ++v)
            moved = std::max(moved, glm::distance((*before)[v], stage.points[v]));
        line("after " + stage.name, std::to_string(stage.points.size()) + " vertices, " + number(length * 1000.0f) +
                                        " mm long" +
                                        (before ? ", moved by up to " + number(moved * 1000.0f) + " mm" : "") +
                                        ", tip at " + vector(stage.points.back()));
        before = &stage.points;
    }
    return text;
}

}  // namespace whorl
