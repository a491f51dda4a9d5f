// SPDX-License-Identifier: Apache-2.0
#include "core/io/groom_repair.h"

#include "core/surface/surface_point.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_set>

namespace whorl {
namespace {

bool finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void say(Problems& problems, std::size_t count, const std::string& what) {
    if (count > 0) problems.push_back(std::to_string(count) + " " + what);
}

/// True when a root was put back onto its triangle. The tolerance is that of checkGroom.
bool repairRoot(SurfacePoint& root) {
    if (root.u >= 0.0f && root.v >= 0.0f && root.u + root.v <= 1.0001f) return false;
    const auto within = [](float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1.0f / 3.0f; };
    root.u = within(root.u);
    root.v = std::min(within(root.v), 1.0f - root.u);
    return true;
}

/// Puts points that are not finite onto the ones before them, the first onto `start`. True when there were any.
bool makeFinite(std::vector<glm::vec3>& points, glm::vec3 start) {
    if (std::all_of(points.begin(), points.end(), finite)) return false;
    glm::vec3 last = finite(start) ? start : glm::vec3(0.0f);
    for (glm::vec3& point : points) last = point = finite(point) ? point : last;
    return true;
}

}  // namespace

Result<void> repairMesh(SurfaceMesh& mesh, std::vector<PartSettings>& settings, Problems& problems) {
    const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::uvec3& t : mesh.triangles) {
        if (t.x >= vertices || t.y >= vertices || t.z >= vertices)
            return Error{"a triangle of its mesh refers to a vertex that is not there."};
    }
    if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), finite))
        return Error{"a vertex of its mesh is not a finite number."};
    std::size_t badNormals = 0, badUvs = 0;
    for (glm::vec3& normal : mesh.normals) {
        if (finite(normal)) continue;
        normal = {0.0f, 1.0f, 0.0f};
        ++badNormals;
    }
    for (glm::vec2& uv : mesh.cornerUvs) {
        if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
        uv = {0.0f, 0.0f};
        ++badUvs;
    }
    say(problems, badNormals, "normals of the mesh were not finite numbers; they point up now.");
    say(problems, badUvs, "texture coordinates of the mesh were not finite numbers; they are zero now.");

    std::uint64_t next = 0;
    bool inOrder = true;
    std::size_t badColours = 0;
    for (MeshPart& part : mesh.parts) {
        inOrder = inOrder && part.firstTriangle == next;
        next += part.triangleCount;
        if (finite(part.baseColour)) continue;
        part.baseColour = clayColour;
        ++badColours;
    }
    say(problems, badColours, "colours of parts were not finite numbers; they are grey now.");
    if (!inOrder || next != mesh.triangles.size()) {
        problems.push_back("The parts of the mesh did not cover it; it has one part now.");
        mesh.parts = {MeshPart{.name = "mesh", .firstTriangle = 0, .triangleCount = mesh.triangleCount()}};
    }
    if (settings.size() != mesh.parts.size()) {
        problems.push_back("There were settings for " + std::to_string(settings.size()) +
                           " parts of the mesh, which has " + std::to_string(mesh.parts.size()) +
                           "; parts without one grow hair.");
        settings.resize(mesh.parts.size());
    }
    return {};
}

void repairGroups(std::vector<Group>& groups, Problems& problems) {
    if (groups.empty()) {
        problems.emplace_back("There were no groups; there is one named hair now.");
        groups.push_back(Group{"hair"});
    }
    std::set<std::string> names;
    for (Group& group : groups) {
        std::string name = group.name.empty() ? "group" : group.name;
        for (char& c : name) {
            const bool allowed =
                (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
            if (!allowed) c = '_';
        }
        const std::string start = name;
        for (int i = 2; names.contains(name); ++i) name = start + "-" + std::to_string(i);
        names.insert(name);
        if (name == group.name) continue;
        problems.push_back("The group named \"" + group.name + "\" is named " + name + " now.");
        group.name = name;
    }
}

GuideSet repairedGuides(const StoredGuides& stored, const SurfaceMesh& mesh, const std::vector<Group>& groups,
                        Problems& problems) {
    GuideSet guides;
    std::unordered_set<std::uint32_t> ids;
    std::uint32_t fresh = std::max<std::uint32_t>(stored.nextId, 1);
    for (const std::uint32_t id : stored.ids) {
        if (id != UINT32_MAX) fresh = std::max(fresh, id + 1);
    }
    std::size_t lost = 0, moved = 0, regrouped = 0, renumbered = 0, straightened = 0, resampledCount = 0, at = 0;
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < stored.ids.size(); ++i) {
        points.assign(stored.points.begin() + static_cast<std::ptrdiff_t>(at),
                      stored.points.begin() + static_cast<std::ptrdiff_t>(at + stored.sizes[i]));
        at += stored.sizes[i];
        SurfacePoint root = stored.roots[i];
        if (points.size() < 2 || root.triangle >= mesh.triangleCount()) {
            ++lost;
            continue;
        }
        moved += repairRoot(root);
        std::uint8_t group = stored.groups[i];
        if (group >= groups.size()) {
            group = 0;
            ++regrouped;
        }
        std::uint32_t id = stored.ids[i];
        if (id == UINT32_MAX || !ids.insert(id).second) {
            id = fresh++;
            ids.insert(id);
            ++renumbered;
        }
        straightened += makeFinite(points, positionAt(mesh, root));
        const int segments = groups[group].params.general.segments;
        if (points.size() != static_cast<std::size_t>(segments) + 1) {
            const glm::vec3 first = points.front();
            points = resampled(points, segments);
            makeFinite(points, first);  // lengths of absurd but finite guides overflow
            ++resampledCount;
        }
        guides.appendWithId(id, root, group, points);
    }
    guides.setNextId(std::max(fresh, guides.nextId()));
    say(problems, lost, "guides did not stand on the mesh or had no length; they are left out.");
    say(problems, moved, "guides had roots outside their triangles; they were moved onto them.");
    say(problems, regrouped, "guides belonged to groups that are not there; they are in the first one now.");
    say(problems, renumbered, "guides shared their number with another; they have new ones.");
    say(problems, straightened, "guides had points that are not finite numbers; these lie on their neighbours now.");
    say(problems, resampledCount, "guides had another number of points than their group; they were resampled.");
    return guides;
}

namespace {

/// Leaves out what can not be on the mesh; `fewest` points a line, `most` lines.
template <class Line>
void repairLines(std::vector<Line>& lines, const SurfaceMesh& mesh, const std::string& what, std::size_t most,
                 std::size_t (*fewest)(const Line&), Problems& problems) {
    std::size_t moved = 0, lostPoints = 0, lost = 0, renumbered = 0;
    std::set<std::uint32_t> given, ids;
    for (const Line& line : lines) given.insert(line.id);
    std::uint32_t fresh = 1;
    std::vector<Line> kept;
    for (Line& line : lines) {
        lostPoints += std::erase_if(line.points,
                                    [&](const SurfacePoint& point) { return point.triangle >= mesh.triangleCount(); });
        for (SurfacePoint& point : line.points) moved += repairRoot(point);
        if (line.points.size() > Line::maxPoints) {
            lostPoints += line.points.size() - Line::maxPoints;
            line.points.resize(Line::maxPoints);
        }
        if (line.points.size() < fewest(line) || kept.size() == most) {
            ++lost;
            continue;
        }
        if (line.id == 0 || !ids.insert(line.id).second) {
            while (given.contains(fresh)) ++fresh;
            line.id = fresh++;
            ids.insert(line.id);
            ++renumbered;
        }
        kept.push_back(std::move(line));
    }
    lines = std::move(kept);
    say(problems, moved, "points of " + what + " lay outside their triangles; they were moved onto them.");
    say(problems, lostPoints, "points of " + what + " did not lie on the mesh or were too many; they are left out.");
    say(problems, lost, what + " had too few points or were too many; they are left out.");
    say(problems, renumbered, what + " shared their number with another; they have new ones.");
}

}  // namespace

void repairPartings(std::vector<Parting>& partings, const SurfaceMesh& mesh, Problems& problems) {
    repairLines<Parting>(
        partings, mesh, "partings", Parting::maxPartings, [](const Parting&) { return std::size_t{2}; }, problems);
}

void repairStrokes(std::vector<FieldStroke>& strokes, const SurfaceMesh& mesh, Problems& problems) {
    std::size_t wrong = 0;
    for (FieldStroke& stroke : strokes) {
        const FieldStroke was = stroke;
        if (static_cast<std::size_t>(stroke.kind) >= strokeKindNames.size()) stroke.kind = StrokeKind::Along;
        stroke.weight = std::isfinite(stroke.weight) ? FieldStroke::weightInRange(stroke.weight) : 1.0f;
        stroke.radius = std::isfinite(stroke.radius) ? std::clamp(stroke.radius, 0.0f, FieldStroke::maxRadius) : 0.0f;
        wrong += stroke.kind != was.kind || stroke.weight != was.weight || stroke.radius != was.radius;
    }
    say(problems, wrong, "strokes had a kind, weight or radius that none can have; it was changed.");
    repairLines<FieldStroke>(
        strokes, mesh, "strokes", FieldStroke::maxStrokes,
        [](const FieldStroke& stroke) { return stroke.fewestPoints(); }, problems);
}

}  // namespace whorl
