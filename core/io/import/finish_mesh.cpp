// SPDX-License-Identifier: Apache-2.0
// From any file's triangles to a SurfaceMesh that keeps its promises.
#include "core/base/random.h"
#include "core/io/import/raw_mesh.h"
#include "core/io/plain_text.h"
#include "core/surface/atlas.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace whorl::import {
namespace {

// Metres from the origin up to which areas and volumes stay inside the range of float.
constexpr float farthest = 1e9f;
// Meshes that reach less far than this are in the wrong unit: their areas would vanish in float.
constexpr float smallest = 1e-9f;
// Repeats of the texture inside one triangle beyond which UVs mean nothing.
constexpr float mostRepeats = 1024.0f;
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

bool usable(const glm::vec3& p) {
    return std::abs(p.x) <= farthest && std::abs(p.y) <= farthest && std::abs(p.z) <= farthest;  // false for NaN
}

glm::dvec3 areaVector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

bool finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// Meshes in wild units, where areas overflow or vanish in float, are brought to about a metre by a power of two. One
// stray corner is no reason: more than half of the finite triangles must lie outside.
void rescale(RawMesh& raw, const std::string& name, Problems& problems) {
    float largest = 0.0f;
    std::uint64_t all = 0;
    std::uint64_t outside = 0;
    for (std::size_t i = 0; i + 2 < raw.corners.size(); i += 3) {
        const glm::vec3* corner[3];
        for (std::size_t k = 0; k < 3; ++k) corner[k] = &raw.positions[raw.corners[i + k]];
        if (!finite(*corner[0]) || !finite(*corner[1]) || !finite(*corner[2])) continue;
        ++all;
        bool inside = true;
        for (const glm::vec3* p : corner) {
            inside = inside && usable(*p);
            largest = std::max(largest, std::max(std::abs(p->x), std::max(std::abs(p->y), std::abs(p->z))));
        }
        if (!inside) ++outside;
    }
    const bool tooLarge = outside * 2 > all;
    if (!tooLarge && !(largest < smallest && largest > 0.0f)) return;
    const int power = -std::ilogb(largest);
    for (glm::vec3& p : raw.positions) {
        for (int k = 0; k < 3; ++k) p[k] = std::ldexp(p[k], power);
    }
    problems.push_back(plainText(name) + ": its coordinates are too " + (tooLarge ? "large" : "small") +
                       " to be metres, so the mesh was scaled by 2 to the power of " + std::to_string(power) + ".");
}

// Gives bit-identical positions one number, in order of first use.
class Welder {
public:
    explicit Welder(const std::vector<glm::vec3>& source) : m_source(source), m_weldedOf(source.size(), none) {
        std::size_t size = 1024;
        while (size < source.size() * 2) size *= 2;
        m_slots.assign(size, none);
    }

    std::uint32_t add(std::uint32_t vertex) {
        if (m_weldedOf[vertex] != none) return m_weldedOf[vertex];
        const glm::vec3 p = m_source[vertex] + glm::vec3(0.0f);  // -0 becomes 0
        std::uint32_t bits[3];
        std::memcpy(bits, &p, sizeof bits);
        std::uint64_t slot = mix64(mix64((std::uint64_t{bits[0]} << 32) | bits[1]) ^ bits[2]) & (m_slots.size() - 1);
        while (m_slots[slot] != none && positions[m_slots[slot]] != p) slot = (slot + 1) & (m_slots.size() - 1);
        if (m_slots[slot] == none) {
            m_slots[slot] = static_cast<std::uint32_t>(positions.size());
            positions.push_back(p);
        }
        return m_weldedOf[vertex] = m_slots[slot];
    }

    /// `none` for vertices that no kept triangle uses.
    std::uint32_t welded(std::size_t vertex) const { return m_weldedOf[vertex]; }

    std::vector<glm::vec3> positions;

private:
    const std::vector<glm::vec3>& m_source;
    std::vector<std::uint32_t> m_weldedOf;
    std::vector<std::uint32_t> m_slots;
};

// Not-a-number becomes 0; triangles that repeat the texture absurdly often lose their UVs.
void repairUvs(std::vector<glm::vec2>& uvs, const std::string& name, Problems& problems) {
    std::uint64_t notFinite = 0;
    std::uint64_t tooFar = 0;
    for (std::size_t i = 0; i + 2 < uvs.size(); i += 3) {
        glm::vec2* uv = &uvs[i];
        bool finite = true;
        for (int k = 0; k < 3; ++k) finite = finite && std::isfinite(uv[k].x) && std::isfinite(uv[k].y);
        if (!finite) {
            ++notFinite;
            uv[0] = uv[1] = uv[2] = glm::vec2(0.0f);
            continue;
        }
        const glm::vec2 low = glm::min(uv[0], glm::min(uv[1], uv[2]));
        const glm::vec2 high = glm::max(uv[0], glm::max(uv[1], uv[2]));
        if (high.x - low.x > mostRepeats || high.y - low.y > mostRepeats) {
            ++tooFar;
            uv[0] = uv[1] = uv[2] = glm::vec2(0.0f);
        } else if (glm::abs(low.x) > mostRepeats || glm::abs(low.y) > mostRepeats) {
            const glm::vec2 whole = glm::floor(low);  // images repeat, so whole steps change nothing
            for (int k = 0; k < 3; ++k) uv[k] -= whole;
        }
    }
    const std::string shown = plainText(name);
    if (notFinite > 0) {
        problems.push_back(shown + ": the UVs of " + counted(notFinite, "triangle") + " are not finite and became 0.");
    }
    if (tooFar > 0) {
        problems.push_back(shown + ": the UVs of " + counted(tooFar, "triangle") +
                           " repeat the texture more than 1,024 times and became 0.");
    }
}

double cornerAngle(const glm::vec3& at, const glm::vec3& next, const glm::vec3& last) {
    const glm::dvec3 a = glm::dvec3(next) - glm::dvec3(at);
    const glm::dvec3 b = glm::dvec3(last) - glm::dvec3(at);
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// The file's normals where it has good ones, else the angle-weighted mean of the triangles (Thuermer and Wuethrich
// 1998).
void makeNormals(SurfaceMesh& mesh, const RawMesh& raw, const Welder& welder) {
    std::vector<glm::dvec3> given(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < raw.normals.size(); ++i) {
        const std::uint32_t vertex = welder.welded(i);
        const glm::dvec3 normal(raw.normals[i]);
        const double length = glm::length(normal);
        if (vertex != none && std::isfinite(length) && length > 1e-20) given[vertex] += normal / length;
    }
    std::vector<glm::dvec3> made(mesh.positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3& a = mesh.positions[t.x];
        const glm::vec3& b = mesh.positions[t.y];
        const glm::vec3& c = mesh.positions[t.z];
        const glm::dvec3 normal = glm::normalize(areaVector(a, b, c));
        made[t.x] += normal * cornerAngle(a, b, c);
        made[t.y] += normal * cornerAngle(b, c, a);
        made[t.z] += normal * cornerAngle(c, a, b);
    }
    mesh.normals.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const bool own = glm::length(given[i]) > 0.1;
        const glm::dvec3& sum = own ? given[i] : made[i];
        const double length = glm::length(sum);
        mesh.normals[i] = length > 1e-9 ? glm::vec3(sum / length) : glm::vec3(0.0f, 1.0f, 0.0f);
    }
}

}  // namespace

Result<SurfaceMesh> finishMesh(RawMesh raw, const std::string& name, Problems& problems, Progress& progress) {
    const std::size_t count = raw.corners.size() / 3;
    if (count == 0) {
        return meshError(name, "there are no triangles in it", "choose a file with a surface that hair can grow on");
    }
    if (count > maxTriangles) {
        return meshError(name, "it has more than 20 million triangles", "reduce the mesh and export it again");
    }
    repairUvs(raw.cornerUvs, name, problems);
    rescale(raw, name, problems);

    SurfaceMesh mesh;
    mesh.triangles.reserve(count);
    if (!raw.cornerUvs.empty()) mesh.cornerUvs.reserve(count * 3);
    Welder welder(raw.positions);
    std::uint64_t notFinite = 0;
    std::uint64_t noArea = 0;
    for (MeshPart& part : raw.parts) {
        const auto first = static_cast<std::uint32_t>(mesh.triangles.size());
        for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
            if (t % 65536 == 0 && progress.cancelled()) return cancelledError();
            const std::uint32_t* corner = &raw.corners[std::size_t{t} * 3];
            const glm::vec3& a = raw.positions[corner[0]];
            const glm::vec3& b = raw.positions[corner[1]];
            const glm::vec3& c = raw.positions[corner[2]];
            if (!usable(a) || !usable(b) || !usable(c)) {
                ++notFinite;
                continue;
            }
            const glm::dvec3 area = areaVector(a, b, c);
            if (!(glm::dot(area, area) > 0.0)) {
                ++noArea;
                continue;
            }
            const std::uint32_t x = welder.add(corner[0]);
            const std::uint32_t y = welder.add(corner[1]);
            const std::uint32_t z = welder.add(corner[2]);
            mesh.triangles.emplace_back(x, y, z);
            for (std::size_t k = 0; k < 3 && !raw.cornerUvs.empty(); ++k) {
                mesh.cornerUvs.push_back(raw.cornerUvs[std::size_t{t} * 3 + k]);
            }
        }
        part.firstTriangle = first;
        part.triangleCount = mesh.triangleCount() - first;
        if (part.triangleCount > 0) mesh.parts.push_back(std::move(part));
    }
    if (mesh.triangles.empty()) {
        return meshError(name,
                         notFinite > 0 ? "none of its triangles has finite corners" : "none of its triangles has area",
                         "choose a file with a surface that hair can grow on");
    }
    const std::string shown = plainText(name);
    if (notFinite > 0) {
        problems.push_back(shown + ": " + counted(notFinite, "triangle") + (notFinite == 1 ? " was" : " were") +
                           " skipped because of corners that are not finite or farther than a million kilometres.");
    }
    if (noArea > 0) {
        problems.push_back(shown + ": " + counted(noArea, "triangle") + (noArea == 1 ? " was" : " were") +
                           " skipped for having no area.");
    }
    mesh.positions = std::move(welder.positions);
    progress.report(0.6f, "Making normals");
    makeNormals(mesh, raw, welder);
    raw = {};

    glm::vec3 low(farthest), high(-farthest);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec3 size = high - low;
    const float longest = std::max(size.x, std::max(size.y, size.z));
    if (longest < 1e-4f || longest > 1e5f) {
        problems.push_back(shown + ": the mesh is " +
                           (longest < 1.0f ? "smaller than a tenth of a millimetre" : "larger than 100 kilometres") +
                           "; Whorl works in metres, so scale it before grooming.");
    }
    if (progress.cancelled()) return cancelledError();
    if (needsAtlas(mesh)) {
        progress.report(0.7f, "Making UVs");
        bool hadTexture = false;
        for (MeshPart& part : mesh.parts) {
            hadTexture = hadTexture || !part.texture.empty();
            part.texture.clear();
        }
        makeAtlas(mesh);
        problems.push_back(shown + ": it has no usable UVs, so Whorl made some" +
                           (hadTexture ? "; its textures do not fit them and are not shown." : "."));
    }
    return mesh;
}

}  // namespace whorl::import
