// SPDX-License-Identifier: Apache-2.0
#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace whorl::testing {
namespace {

// Numbers in the order that they are asked for.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : m_seed(seed) {}
    float unit() { return randomFloat(m_seed, m_next++, 101); }
    int below(int count) { return std::min(count - 1, static_cast<int>(unit() * static_cast<float>(count))); }
    bool chance(float share) { return unit() < share; }
    /// Takes no number from the others: parameters that came later leave random grooms as they were.
    bool chanceApart(float share) { return randomFloat(m_seed, m_next, 102) < share; }

private:
    std::uint32_t m_seed;
    std::uint64_t m_next = 0;
};

// Gives every parameter of a block and its blocks a random value in its range.
struct Randomise {
    Dice& dice;
    std::vector<std::string>& dataMaps;
    std::vector<std::string>& colourMaps;

    float within(const ParamInfo& info) {
        const double top = info.softMax > 0.0 ? info.softMax : info.max;
        const double value = info.min + (top - info.min) * static_cast<double>(dice.unit());
        return static_cast<float>(std::clamp(value, info.min, info.max));
    }
    glm::vec3 threeWithin(const ParamInfo& info) {
        const float x = within(info);
        const float y = within(info);
        return {x, y, within(info)};
    }
    std::string anyOf(std::vector<std::string>& names) {
        if (names.empty() || !dice.chance(0.4f)) return {};
        return names[static_cast<std::size_t>(dice.below(static_cast<int>(names.size())))];
    }

    template <class Block>
    void operator()(const BlockInfo&, Block& block) {
        Block::each(block, *this);
    }
    void operator()(const ParamInfo& info, bool& value) {
        value = info.id == "even" ? dice.chanceApart(0.5f) : dice.chance(0.5f);
    }
    void operator()(const ParamInfo& info, int& value) { value = static_cast<int>(within(info)); }
    void operator()(const ParamInfo& info, float& value) { value = within(info); }
    void operator()(const ParamInfo& info, Driven& value) { value = {within(info), anyOf(dataMaps)}; }
    void operator()(const ParamInfo& info, DrivenVector& value) { value = {threeWithin(info), anyOf(dataMaps)}; }
    void operator()(const ParamInfo& info, DrivenColour& value) { value = {threeWithin(info), anyOf(colourMaps)}; }
    void operator()(const ParamInfo& info, Colour& value) { value = {threeWithin(info)}; }
    void operator()(const ParamInfo& info, Vector& value) { value = {threeWithin(info)}; }
    void operator()(const ParamInfo&, MapName& value) { value = {anyOf(dataMaps)}; }
    void operator()(const ParamInfo& info, Choice& value) {
        value = {dice.below(static_cast<int>(info.choices.size()))};
    }
};

Map randomMap(Dice& dice, int channels) {
    constexpr TexelFormat formats[] = {TexelFormat::U8, TexelFormat::U16, TexelFormat::F32};
    const int width = 3 + dice.below(90);
    const int height = 3 + dice.below(90);
    Map map(width, height, channels, formats[dice.below(3)], 0.0f);
    map.flipV = dice.chance(0.3f);
    map.srgb = channels == 3 && dice.chance(0.5f);
    for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
            for (int channel = 0; channel < channels; ++channel) map.setTexel(x, y, channel, dice.unit());
        }
    }
    return map;
}

// Adds what a value means to a digest.
struct Digest {
    Hasher& hasher;

    template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void number(T value) { hasher.add(&value, sizeof(value)); }
    void text(const std::string& value) {
        number(value.size());
        hasher.add(value.data(), value.size());
    }
    template <class T>
    void array(const std::vector<T>& values) {
        number(values.size());
        if (!values.empty()) hasher.add(values.data(), values.size() * sizeof(T));
    }
    void vector(const glm::vec3& value) { hasher.add(&value, sizeof(value)); }

    template <class Block>
    void operator()(const BlockInfo& info, const Block& block) {
        text(std::string(info.id));
        Block::each(block, *this);
    }
    template <class T>
    void operator()(const ParamInfo& info, const T& value) {
        text(std::string(info.id));
        param(value);
    }
    void param(bool value) { number(value); }
    void param(int value) { number(value); }
    void param(float value) { number(value); }
    void param(const Driven& value) { number(value.value), text(value.map); }
    void param(const DrivenVector& value) { vector(value.value), text(value.map); }
    void param(const DrivenColour& value) { vector(value.value), text(value.map); }
    void param(const Colour& value) { vector(value.value); }
    void param(const Vector& value) { vector(value.value); }
    void param(const MapName& value) { text(value.name); }
    void param(const Choice& value) { number(value.index); }

    void add(const SurfaceMesh& mesh) {
        array(mesh.positions);
        array(mesh.normals);
        array(mesh.triangles);
        array(mesh.cornerUvs);
        number(mesh.parts.size());
        for (const MeshPart& part : mesh.parts) {
            text(part.name);
            number(part.firstTriangle);
            number(part.triangleCount);
            vector(part.baseColour);
            text(part.texture);
        }
        number(mesh.madeAtlas);
    }
    // Nothing at all without partings: digests from before there were any stay.
    void add(const std::vector<Parting>& partings) {
        for (const Parting& parting : partings) {
            number(parting.id);
            text(parting.name);
            number(parting.points.size());
            for (const SurfacePoint& point : parting.points) number(point.triangle), number(point.u), number(point.v);
        }
    }
    void add(const std::vector<FieldStroke>& strokes) {
        for (const FieldStroke& stroke : strokes) {
            number(stroke.id);
            number(static_cast<int>(stroke.kind));
            number(stroke.weight);
            number(stroke.radius);
            number(stroke.points.size());
            for (const SurfacePoint& point : stroke.points) number(point.triangle), number(point.u), number(point.v);
        }
    }
    void add(const GuideSet& guides) {
        number(guides.count());
        number(guides.nextId());
        for (std::size_t i = 0; i < guides.count(); ++i) {
            const SurfacePoint root = guides.root(i);
            number(guides.id(i));
            number(guides.group(i));
            number(root.triangle);
            number(root.u);
            number(root.v);
            number(guides.points(i).size());
            hasher.add(guides.points(i).data(), guides.points(i).size_bytes());
        }
    }
    // Texel by texel: what lies in the tiles beyond the edge of the image means nothing.
    void add(const Map& map) {
        number(map.width());
        number(map.height());
        number(map.channels());
        number(map.format());
        number(map.flipV);
        number(map.srgb);
        for (int y = 0; y < map.height(); ++y) {
            for (int x = 0; x < map.width(); ++x) {
                for (int channel = 0; channel < map.channels(); ++channel) number(map.texel(x, y, channel));
            }
        }
    }
};

std::vector<glm::vec3> bentGuide(Dice& dice, const SurfaceMesh& mesh, const SurfacePoint& root, int segments) {
    const float step = (0.01f + 0.06f * dice.unit()) / static_cast<float>(segments);
    glm::vec3 direction = normalAt(mesh, root);
    std::vector<glm::vec3> points{positionAt(mesh, root)};
    for (int k = 0; k < segments; ++k) {
        points.push_back(points.back() + direction * step);
        const float x = dice.unit() - 0.5f;
        const float y = dice.unit() - 0.7f;
        direction = glm::normalize(direction + 0.5f * glm::vec3(x, y, dice.unit() - 0.5f));
    }
    return points;
}

}  // namespace

Groom randomGroom(std::uint32_t seed) {
    Dice dice(seed);
    const int rings = 5 + dice.below(6);
    SurfaceMesh mesh = sphere(rings, 6 + dice.below(8));
    if (dice.chance(0.5f)) {
        const std::uint32_t half = mesh.triangleCount() / 2;
        mesh.parts = {{.name = "upper", .firstTriangle = 0, .triangleCount = half},
                      {.name = "lower", .firstTriangle = half, .triangleCount = mesh.triangleCount() - half}};
    }
    Groom groom = makeGroom(std::move(mesh));

    std::vector<std::string> dataMaps;
    std::vector<std::string> colourMaps;
    for (int i = dice.below(3); i >= 0; --i) {
        dataMaps.push_back("data" + std::to_string(i));
        groom.maps.set(dataMaps.back(), randomMap(dice, 1));
    }
    if (dice.chance(0.7f)) {
        colourMaps.emplace_back("colour");
        groom.maps.set("colour", randomMap(dice, 3));
    }

    Randomise randomise{dice, dataMaps, colourMaps};
    std::vector<Group>& groups = groom.groups.edit();
    for (int i = dice.below(3); i > 0; --i) groups.push_back({"group" + std::to_string(i), {}});
    for (Group& group : groups) {
        HairParams::each(group.params, randomise);
        group.params.general.segments = 2 + dice.below(14);
        group.params.general.density.value = std::max(group.params.general.density.value, 0.05f);
        group.params.strands.hairs = dice.chance(0.3f) ? 1 + dice.below(4) : 0;
        for (int i = dice.below(4); i > 0; --i) {
            const auto kind = static_cast<std::size_t>(dice.below(static_cast<int>(modifierKindCount)));
            Modifier modifier{freeModifierName(group.params.modifiers, modifierKinds()[kind].id)};
            modifier.params = defaultModifierParams(kind);
            Modifier::each(modifier, randomise);
            modifier.on = dice.chance(0.8f);
            group.params.modifiers.push_back(std::move(modifier));
        }
    }
    CountParams& counts = groom.counts.edit();
    CountParams::each(counts, randomise);
    counts.hairs = 200 + dice.below(800);
    // Around the average density, or not pinned.
    counts.densityTotal = dice.below(2) == 0 ? 0.0f : 0.3f;
    counts.shownHairs = std::min(counts.hairs, 300);
    counts.parts = 1 + dice.below(8);
    if (groom.mesh->parts.size() > 1 && dice.chance(0.5f)) groom.partSettings.edit()[1].growsHair = false;

    const int guides = 5 + dice.below(150);
    for (int i = 0; i < guides; ++i) {
        const auto triangles = static_cast<int>(groom.mesh->triangleCount());
        SurfacePoint root{static_cast<std::uint32_t>(dice.below(triangles)), dice.unit(), dice.unit()};
        if (root.u + root.v > 1.0f) root = {root.triangle, 1.0f - root.u, 1.0f - root.v};
        const int group = dice.below(static_cast<int>(groom.groups->size()));
        const int segments = (*groom.groups)[static_cast<std::size_t>(group)].params.general.segments;
        groom.guides.append(root, static_cast<std::uint8_t>(group), bentGuide(dice, *groom.mesh, root, segments));
    }
    for (int i = dice.below(3); i > 0; --i) {
        Parting parting{nextPartingId(*groom.partings), dice.chance(0.5f) ? "line" : "", {}};
        for (int k = 2 + dice.below(5); k > 0; --k) {
            const auto triangles = static_cast<int>(groom.mesh->triangleCount());
            const float u = 0.5f * dice.unit();
            parting.points.push_back({static_cast<std::uint32_t>(dice.below(triangles)), u, 0.5f * dice.unit()});
        }
        groom.partings.edit().push_back(std::move(parting));
    }
    for (int i = dice.below(4); i > 0; --i) {
        FieldStroke stroke;
        stroke.id = nextStrokeId(*groom.strokes);
        stroke.kind = static_cast<StrokeKind>(dice.below(static_cast<int>(strokeKindNames.size())));
        stroke.weight = 0.1f + 3.0f * dice.unit();
        if (stroke.kind != StrokeKind::Along) stroke.radius = 0.2f * dice.unit();
        for (int k = 2 + dice.below(5); k > 0; --k) {
            const auto triangles = static_cast<int>(groom.mesh->triangleCount());
            const float u = 0.5f * dice.unit();
            stroke.points.push_back({static_cast<std::uint32_t>(dice.below(triangles)), u, 0.5f * dice.unit()});
        }
        groom.strokes.edit().push_back(std::move(stroke));
    }
    if (dice.chance(0.5f)) FieldParams::each(groom.field.edit(), randomise);
    if (dice.chance(0.5f)) LicParams::each(groom.lic.edit(), randomise);
    return groom;
}

std::uint64_t groomDigest(const Groom& groom) {
    Hasher hasher;
    Digest digest{hasher};
    digest.add(*groom.mesh);
    for (const PartSettings& part : *groom.partSettings) {
        digest.number(part.growsHair);
        digest.number(part.visible);
    }
    digest.add(groom.guides);
    digest.number(groom.maps.entries().size());
    for (const MapSet::Entry& entry : groom.maps.entries()) {
        digest.text(entry.name);
        digest.add(*entry.map);
    }
    digest.number(groom.groups->size());
    for (const Group& group : *groom.groups) {
        digest.text(group.name);
        HairParams::eachWithModifiers(group.params, digest);
    }
    CountParams::each(*groom.counts, digest);
    digest.add(*groom.partings);
    digest.add(*groom.strokes);
    if (*groom.field != fieldParamsFor(*groom.mesh)) FieldParams::each(*groom.field, digest);
    if (*groom.lic != licParamsFor(*groom.mesh)) LicParams::each(*groom.lic, digest);
    return hasher.digest();
}

}  // namespace whorl::testing
