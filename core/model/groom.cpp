// SPDX-License-Identifier: Apache-2.0
#include "core/model/groom.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace whorl {
namespace {

bool finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool standsOn(const SurfacePoint& point) {
    return point.u >= 0.0f && point.v >= 0.0f && point.u + point.v <= 1.0001f;
}

void checkMesh(const SurfaceMesh& mesh, Problems& problems) {
    if (mesh.triangles.empty()) problems.push_back("The mesh has no triangles.");
    if (mesh.normals.size() != mesh.positions.size()) {
        problems.push_back("The mesh has " + std::to_string(mesh.positions.size()) + " vertices but " +
                           std::to_string(mesh.normals.size()) + " normals.");
    }
    if (mesh.cornerUvs.size() != mesh.triangles.size() * 3) {
        problems.push_back("The mesh has " + std::to_string(mesh.triangles.size()) + " triangles but " +
                           std::to_string(mesh.cornerUvs.size()) + " corner UVs.");
    }
    const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::uvec3& t : mesh.triangles) {
        if (t.x >= vertices || t.y >= vertices || t.z >= vertices) {
            problems.push_back("A triangle of the mesh refers to a vertex that is not there.");
            break;
        }
    }
    if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), finite)) {
        problems.push_back("A vertex of the mesh is not a finite number.");
    }
    if (!std::all_of(mesh.normals.begin(), mesh.normals.end(), finite)) {
        problems.push_back("A normal of the mesh is not a finite number.");
    }
    std::uint64_t next = 0;
    bool inOrder = true;
    for (const MeshPart& part : mesh.parts) {
        inOrder = inOrder && part.firstTriangle == next;
        next += part.triangleCount;
    }
    if (!inOrder || next != mesh.triangles.size()) problems.push_back("The parts do not cover the mesh in order.");
}

void checkGuides(const Groom& groom, Problems& problems) {
    const auto& groups = *groom.groups;
    const std::uint32_t triangles = groom.mesh->triangleCount();
    std::size_t badRoots = 0, badGroups = 0, badCounts = 0, badPoints = 0, repeated = 0;
    std::set<std::uint32_t> ids;
    for (std::size_t b = 0; b < groom.guides.blockCount(); ++b) {
        const GuideBlock& block = groom.guides.block(b);
        for (std::size_t i = 0; i < block.count(); ++i) {
            const SurfacePoint& root = block.roots[i];
            if (root.triangle >= triangles || !standsOn(root)) ++badRoots;
            if (!ids.insert(block.ids[i]).second) ++repeated;
            const std::uint32_t points = block.firstPoint[i + 1] - block.firstPoint[i];
            if (block.groups[i] >= groups.size()) {
                ++badGroups;
            } else if (points != static_cast<std::uint32_t>(groups[block.groups[i]].params.general.segments) + 1) {
                ++badCounts;
            }
        }
        badPoints += static_cast<std::size_t>(
            std::count_if(block.points.begin(), block.points.end(), [](const glm::vec3& p) { return !finite(p); }));
    }
    const auto say = [&](std::size_t count, const char* what) {
        if (count > 0) problems.push_back(std::to_string(count) + what);
    };
    say(badRoots, " guides do not stand on the mesh.");
    say(repeated, " guides share their number with another.");
    say(badGroups, " guides belong to a group that is not there.");
    say(badCounts, " guides have another number of points than their group.");
    say(badPoints, " guide points are not finite numbers.");
}

/// What partings and strokes have in common; `name` with a capital.
template <class Line>
void checkLines(const Groom& groom, const std::vector<Line>& lines, const std::string& name, std::size_t most,
                std::size_t (*fewest)(const Line&), Problems& problems) {
    const std::uint32_t triangles = groom.mesh->triangleCount();
    if (lines.size() > most) {
        problems.push_back("A groom has at most " + std::to_string(most) + " of this kind: " + name +
                           "; this one has " + std::to_string(lines.size()) + ".");
    }
    std::set<std::uint32_t> ids;
    for (const Line& line : lines) {
        const std::string which = name + " " + std::to_string(line.id);
        if (line.id == 0 || !ids.insert(line.id).second)
            problems.push_back(which + " shares its number with another, or has none.");
        if (line.points.size() < fewest(line) || line.points.size() > Line::maxPoints)
            problems.push_back(which + " has " + std::to_string(line.points.size()) + " points; " +
                               std::to_string(fewest(line)) + " to " + std::to_string(Line::maxPoints) + " are right.");
        const bool on = std::all_of(line.points.begin(), line.points.end(), [&](const SurfacePoint& point) {
            return point.triangle < triangles && standsOn(point);
        });
        if (!on) problems.push_back(which + " does not lie on the mesh.");
    }
}

void checkPartings(const Groom& groom, Problems& problems) {
    checkLines<Parting>(
        groom, *groom.partings, "Parting", Parting::maxPartings, [](const Parting&) { return std::size_t{2}; },
        problems);
}

void checkStrokes(const Groom& groom, Problems& problems) {
    checkLines<FieldStroke>(
        groom, *groom.strokes, "Stroke", FieldStroke::maxStrokes,
        [](const FieldStroke& stroke) { return stroke.fewestPoints(); }, problems);
    for (const FieldStroke& stroke : *groom.strokes) {
        const bool right = static_cast<std::size_t>(stroke.kind) < strokeKindNames.size() &&
                           stroke.weight >= FieldStroke::minWeight && stroke.weight <= FieldStroke::maxWeight &&
                           stroke.radius >= 0.0f && stroke.radius <= FieldStroke::maxRadius;
        if (!right)
            problems.push_back("Stroke " + std::to_string(stroke.id) +
                               " has a kind, weight or radius that none can have.");
    }
}

void checkGroups(const Groom& groom, Problems& problems) {
    const auto& groups = *groom.groups;
    if (groups.empty() || groups.size() > Groom::maxGroups) {
        problems.push_back("A groom has 1 to 30 groups; this one has " + std::to_string(groups.size()) + ".");
    }
    const auto checkMap = [&](const std::string& where, const std::string& map) {
        if (!map.empty() && !groom.maps.find(map)) {
            problems.push_back(where + " is driven by map \"" + map + "\", which is not there; it counts as white.");
        }
    };
    std::set<std::string> names;
    for (const Group& group : groups) {
        if (!names.insert(group.name).second) problems.push_back("Two groups are named \"" + group.name + "\".");
        HairParams params = group.params;
        std::set<std::string> modifierNames;
        for (const Modifier& modifier : params.modifiers) {
            if (!isModifierName(modifier.name) || !modifierNames.insert(modifier.name).second)
                problems.push_back("Group " + group.name + " has a modifier \"" + modifier.name +
                                   "\" whose name is none or another's.");
        }
        HairParams::eachWithModifiers(params, [&](const BlockInfo& block, auto& values) {
            for (const ParamRef& ref : paramsOf(values)) {
                if (const std::string* map = paramMap(ref)) {
                    checkMap("groups/" + group.name + "/" + std::string(block.id) + "/" + std::string(ref.info.id),
                             *map);
                }
            }
        });
    }
    Groom::eachBlock(groom, [&](const BlockInfo& block, const auto& values) {
        auto copy = *values;
        for (const ParamRef& ref : paramsOf(copy)) {
            if (const std::string* map = paramMap(ref))
                checkMap(std::string(block.id) + "/" + std::string(ref.info.id), *map);
        }
    });
    for (const MeshPart& part : groom.mesh->parts) checkMap("The texture of part " + part.name, part.texture);
}

float largestSide(const SurfaceMesh& mesh) {
    if (mesh.positions.empty()) return 0.0f;
    glm::vec3 low = mesh.positions[0], high = low;
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec3 size = high - low;
    return std::max({size.x, size.y, size.z});
}

}  // namespace

bool Groom::sameAs(const Groom& other) const {
    return mesh.sameAs(other.mesh) && partSettings.sameAs(other.partSettings) && guides.sameAs(other.guides) &&
           maps.sameAs(other.maps) && groups.sameAs(other.groups) && counts.sameAs(other.counts) &&
           partings.sameAs(other.partings) && strokes.sameAs(other.strokes) && field.sameAs(other.field) &&
           lic.sameAs(other.lic);
}

std::size_t Groom::bytesNotSharedWith(const Groom& before) const {
    std::size_t bytes = sizeof(Groom) + guides.bytesNotSharedWith(before.guides) + maps.bytesNotSharedWith(before.maps);
    if (!mesh.sameAs(before.mesh)) {
        bytes += mesh->positions.size() * sizeof(glm::vec3) * 2 + mesh->triangles.size() * sizeof(glm::uvec3) +
                 mesh->cornerUvs.size() * sizeof(glm::vec2);
    }
    if (!partSettings.sameAs(before.partSettings)) bytes += partSettings->size() * sizeof(PartSettings);
    if (!groups.sameAs(before.groups)) {
        for (const Group& group : *groups) bytes += sizeof(Group) + group.params.modifiers.size() * sizeof(Modifier);
    }
    if (!counts.sameAs(before.counts)) bytes += sizeof(CountParams);
    if (!partings.sameAs(before.partings)) {
        for (const Parting& parting : *partings)
            bytes += sizeof(Parting) + parting.points.size() * sizeof(SurfacePoint);
    }
    if (!strokes.sameAs(before.strokes)) {
        for (const FieldStroke& stroke : *strokes)
            bytes += sizeof(FieldStroke) + stroke.points.size() * sizeof(SurfacePoint);
    }
    if (!field.sameAs(before.field)) bytes += sizeof(FieldParams);
    if (!lic.sameAs(before.lic)) bytes += sizeof(LicParams);
    return bytes;
}

void Groom::countAnew() {
    if (counts->densityTotal != 0.0f) counts.edit().densityTotal = 0.0f;
}

void Groom::setHairs(std::uint32_t hairs) {
    const auto wanted = static_cast<int>(std::min(hairs, 0x7fffffffu));
    if (counts->hairs != wanted) counts.edit().hairs = wanted;
    countAnew();
}

int Groom::groupIndex(std::string_view name) const {
    for (std::size_t i = 0; i < groups->size(); ++i) {
        if ((*groups)[i].name == name) return static_cast<int>(i);
    }
    return -1;
}

bool Groom::growsHair(std::uint32_t part) const {
    return part >= partSettings->size() || (*partSettings)[part].growsHair;
}

float lengthScale(const SurfaceMesh& mesh) {
    const float size = largestSide(mesh);
    return size > 0.0f && (size < 0.1f || size > 0.6f) ? size / 0.35f : 1.0f;
}

FieldParams fieldParamsFor(const SurfaceMesh& mesh) {
    FieldParams params;
    if (const float factor = lengthScale(mesh); factor != 1.0f) scaleLengths(paramsOf(params), factor);
    return params;
}

LicParams licParamsFor(const SurfaceMesh& mesh) {
    LicParams params;
    if (const float factor = lengthScale(mesh); factor != 1.0f) scaleLengths(paramsOf(params), factor);
    return params;
}

void Groom::setDefaults() {
    if (const FieldParams params = fieldParamsFor(*mesh); *field != params) field = Cow<FieldParams>(params);
    if (const LicParams params = licParamsFor(*mesh); *lic != params) lic = Cow<LicParams>(params);
}

Groom makeGroom(SurfaceMesh mesh) {
    Groom groom;
    if (const float factor = lengthScale(mesh); factor != 1.0f) {
        HairParams::each(groom.groups.edit()[0].params,
                         [&](const BlockInfo&, auto& block) { scaleLengths(paramsOf(block), factor); });
    }
    groom.partSettings = Cow<std::vector<PartSettings>>(std::vector<PartSettings>(mesh.parts.size()));
    groom.mesh = Cow<SurfaceMesh>(std::move(mesh));
    groom.setDefaults();
    return groom;
}

Problems checkGroom(const Groom& groom) {
    Problems problems;
    checkMesh(*groom.mesh, problems);
    if (groom.partSettings->size() != groom.mesh->parts.size()) {
        problems.push_back("The mesh has " + std::to_string(groom.mesh->parts.size()) + " parts but settings for " +
                           std::to_string(groom.partSettings->size()) + ".");
    }
    checkGroups(groom, problems);
    checkGuides(groom, problems);
    checkPartings(groom, problems);
    checkStrokes(groom, problems);
    return problems;
}

}  // namespace whorl
