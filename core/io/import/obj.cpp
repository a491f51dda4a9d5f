// SPDX-License-Identifier: Apache-2.0
// OBJ: faces of any number of corners, groups, objects and materials, numbers from either end.
#include "core/io/import/lines.h"
#include "core/io/import/obj_materials.h"
#include "core/io/import/polygons.h"
#include "core/io/plain_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whorl::import {
namespace {

constexpr std::uint64_t maxVertices = 100'000'000;

// The largest number used so far and where: faces may come before what they name, so it is judged at the end.
struct Largest {
    std::uint64_t index = 0;
    std::uint64_t line = 0;
    bool any = false;
    void see(std::uint64_t seen, std::uint64_t at) {
        if (any && seen <= index) return;
        index = seen;
        line = at;
        any = true;
    }
};

class ObjReader {
public:
    ObjReader(const std::string& name, const Neighbours& neighbours, const ImportOptions& options, Progress& progress)
        : m_name(name), m_neighbours(neighbours), m_options(options), m_progress(progress) {}

    Result<RawImport> read(std::string_view text) {
        Lines lines(text);
        std::string_view line;
        while (lines.next(line)) {
            m_line = lines.number();
            if (m_line % 16384 == 0 && m_progress.cancelled()) return cancelledError();
            if (auto done = readLine(line); !done) return done.error();
        }
        return finish();
    }

private:
    Error wrong(const std::string& reason) const {
        return meshError(m_name, "line " + std::to_string(m_line) + ": " + reason);
    }

    Result<void> readLine(std::string_view line) {
        const std::string_view keyword = takeWord(line);
        if (keyword.empty() || keyword.front() == '#') return {};
        if (keyword == "v") return readVertex(line);
        if (keyword == "vt") return readUv(line);
        if (keyword == "vn") return readNormal(line);
        if (keyword == "f" || keyword == "fo") return readFace(line);
        if (keyword == "g" || keyword == "o") {
            m_group = trimmed(line);
            m_partKnown = false;
        } else if (keyword == "usemtl") {
            m_material = trimmed(line);
            m_partKnown = false;
        } else if (keyword == "mtllib" && m_libraries < 32) {
            ++m_libraries;
            readMaterials(trimmed(line), m_name, m_neighbours, m_materials, m_out.problems);
        } else if (keyword == "l" || keyword == "p") {
            ++m_linesAndPoints;
        }
        return {};
    }

    // `least` to `most` numbers; more words (colours, weights) are left alone.
    Result<int> numbers(std::string_view line, float* out, int least, int most) const {
        int count = 0;
        for (; count < most; ++count) {
            const std::string_view word = takeWord(line);
            if (word.empty()) break;
            if (const auto number = parseFloat(word)) {
                out[count] = *number;
            } else if (word.find("#IN") != word.npos || word.find("#QNAN") != word.npos) {
                out[count] = std::numeric_limits<float>::quiet_NaN();
            } else {
                const std::string shown = "'" + plainText(word, 40) + "' is not a number";
                return wrong(word.find(',') != word.npos ? shown + " (numbers need a decimal point, not a comma)"
                                                         : shown);
            }
        }
        if (count < least) return wrong("there are fewer than " + std::to_string(least) + " numbers");
        return count;
    }

    Result<void> readVertex(std::string_view line) {
        float p[3];
        if (auto got = numbers(line, p, 3, 3); !got) return got.error();
        if (m_out.mesh.positions.size() >= maxVertices) return wrong("it has more than 100 million vertices");
        m_out.mesh.positions.emplace_back(p[0], p[1], p[2]);
        return {};
    }

    Result<void> readUv(std::string_view line) {
        float uv[2] = {0.0f, 0.0f};
        if (auto got = numbers(line, uv, 1, 2); !got) return got.error();
        if (m_uvs.size() >= maxVertices) return wrong("it has more than 100 million texture coordinates");
        m_uvs.emplace_back(uv[0], uv[1]);
        return {};
    }

    Result<void> readNormal(std::string_view line) {
        float n[3];
        if (auto got = numbers(line, n, 3, 3); !got) return got.error();
        if (m_normals.size() >= maxVertices) return wrong("it has more than 100 million normals");
        m_normals.emplace_back(n[0], n[1], n[2]);
        return {};
    }

    // One of the numbers in "12/-3/4", counted from 0. Negative ones count back from the newest.
    std::optional<std::uint64_t> index(std::string_view word, std::size_t present) const {
        const auto number = parseInteger(word);
        const auto count = static_cast<long long>(present);
        if (!number || *number == 0 || *number < -count || *number > static_cast<long long>(maxVertices)) return {};
        return static_cast<std::uint64_t>(*number > 0 ? *number - 1 : count + *number);
    }

    Result<std::uint32_t> positionIndex(std::string_view word) {
        const std::size_t present = m_out.mesh.positions.size();
        const auto position = index(word, present);
        if (position) {
            m_largestPosition.see(*position, m_line);
            return static_cast<std::uint32_t>(*position);
        }
        if (parseInteger(word).value_or(0) == 0) return wrong("'" + plainText(word, 40) + "' is no number of a vertex");
        return wrong("the face names vertex " + std::string(word) + " of " + std::to_string(present));
    }

    Result<void> readFace(std::string_view line) {
        const std::size_t before = m_polygons.positions.size();
        for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
            if (word.front() == '#') break;
            const std::size_t slash = word.find('/');
            const auto position = positionIndex(word.substr(0, slash));
            if (!position) return position.error();
            std::uint32_t uv = Polygons::noUv;
            if (slash != word.npos) {
                const std::string_view rest = word.substr(slash + 1);
                const std::size_t second = rest.find('/');
                const std::string_view uvWord = rest.substr(0, second);
                // UVs and normals that are not there can be done without, vertices can not.
                if (const auto got = index(uvWord, m_uvs.size())) uv = static_cast<std::uint32_t>(*got);
                if (uv == Polygons::noUv && !uvWord.empty()) ++m_missingUvs;
                if (second != rest.npos && second + 1 < rest.size()) {
                    const auto normal = index(rest.substr(second + 1), m_normals.size());
                    if (normal) m_normalUses.emplace_back(*position, static_cast<std::uint32_t>(*normal));
                    if (!normal) ++m_missingNormals;
                }
            }
            m_polygons.positions.push_back(*position);
            m_polygons.uvs.push_back(uv);
            m_anyUv = m_anyUv || uv != Polygons::noUv;
        }
        const std::size_t corners = m_polygons.positions.size() - before;
        if (corners < 3) {
            m_polygons.positions.resize(before);
            m_polygons.uvs.resize(before);
            ++m_linesAndPoints;
            return {};
        }
        m_polygons.triangles += corners - 2;
        if (m_polygons.triangles > maxTriangles) {
            return meshError(m_name, "it has more than 20 million triangles", "reduce the mesh and export it again");
        }
        if (auto part = choosePart(); !part) return part.error();
        m_polygons.faceEnds.push_back(m_polygons.positions.size());
        return {};
    }

    // A part for each pair of group (or object) and material, in order of first use.
    Result<void> choosePart() {
        if (m_partKnown) return {};
        m_partKnown = true;
        const auto [entry, isNew] =
            m_partOf.try_emplace({m_group, m_material}, static_cast<std::uint32_t>(m_partKeys.size()));
        if (isNew) {
            if (m_partKeys.size() >= maxParts) return wrong("it has more than 100,000 groups");
            m_partKeys.push_back(&entry->first);
        }
        m_polygons.runs.push_back({entry->second, static_cast<std::uint32_t>(m_polygons.faceEnds.size())});
        return {};
    }

    Result<RawImport> finish() {
        if (m_polygons.faceEnds.empty()) {
            return meshError(m_name, "there are no faces in it", "choose a file with a surface that hair can grow on");
        }
        const std::size_t present = m_out.mesh.positions.size();
        if (m_largestPosition.any && m_largestPosition.index >= present) {
            return meshError(m_name, "line " + std::to_string(m_largestPosition.line) + ": the face names vertex " +
                                         std::to_string(m_largestPosition.index + 1) + " of " +
                                         std::to_string(present));
        }
        for (std::uint32_t& uv : m_polygons.uvs) {
            if (uv == Polygons::noUv || uv < m_uvs.size()) continue;
            uv = Polygons::noUv;
            ++m_missingUvs;
        }
        if (!m_normalUses.empty()) {
            m_out.mesh.normals.assign(m_out.mesh.positions.size(), glm::vec3(0.0f));
            for (const auto& [position, normal] : m_normalUses) {
                if (normal < m_normals.size()) {
                    m_out.mesh.normals[position] += m_normals[normal];
                } else {
                    ++m_missingNormals;
                }
            }
        }
        makeParts();
        if (!m_anyUv) m_polygons.uvs.clear();
        cutPolygons(m_polygons, m_uvs, m_out.mesh);
        m_out.sourceTriangles = m_polygons.triangles;
        if (m_missingUvs > 0) {
            m_out.problems.push_back(plainText(m_name) + ": " + counted(m_missingUvs, "corner") +
                                     " without the texture coordinate that the face names.");
        }
        if (m_missingNormals > 0) {
            m_out.problems.push_back(plainText(m_name) + ": " + counted(m_missingNormals, "corner") +
                                     " without the normal that the face names; normals were computed there.");
        }
        if (m_linesAndPoints > 0) {
            m_out.problems.push_back(plainText(m_name) + ": " + counted(m_linesAndPoints, "line or point element") +
                                     " skipped; hair grows on faces only.");
        }
        return std::move(m_out);
    }

    void makeParts() {
        std::map<std::string, std::size_t, std::less<>> materialsOfGroup;
        for (const auto* key : m_partKeys) ++materialsOfGroup[key->first];
        UniqueNames names;
        for (const auto* key : m_partKeys) {
            const auto& [group, materialName] = *key;
            const bool several = materialsOfGroup[group] > 1 && !materialName.empty();
            std::string name = group.empty() ? materialName : several ? group + " / " + materialName : group;
            MeshPart part;
            part.name = names.make(name, "mesh");
            if (const auto material = m_materials.find(materialName); material != m_materials.end()) {
                part.baseColour = material->second.colour;
                part.texture = texture(material->second.image);
                if (!part.texture.empty()) part.baseColour = glm::vec3(1.0f);
            }
            m_out.mesh.parts.push_back(std::move(part));
        }
    }

    // The name of the colour map for an image file; empty when there is none to be had.
    std::string texture(const std::string& image) {
        if (image.empty() || !m_options.textures) return {};
        const auto known = m_textureOf.find(image);
        if (known != m_textureOf.end()) return known->second;
        std::string& name = m_textureOf[image];
        const auto leaveOut = [&](const std::string& reason) {
            m_out.problems.push_back(plainText(m_name) + ": the texture " + plainText(image, 80) +
                                     " is left out: " + reason + ".");
            return std::string();
        };
        if (m_out.textures.size() >= maxTextures) return leaveOut("more than 64 are not read");
        auto bytes = m_neighbours.read(image, maxImageFileBytes);
        if (!bytes) return leaveOut(bytes.error().message);
        if (m_imageBytes + bytes->size() > maxAllImageBytes) return leaveOut("all textures together exceed 1 GiB");
        m_imageBytes += bytes->size();
        name = m_textureNames.make(std::filesystem::path(image).stem().string(), "texture");
        m_out.textures.push_back({name, std::move(*bytes), image});
        return name;
    }

    const std::string& m_name;
    const Neighbours& m_neighbours;
    const ImportOptions& m_options;
    Progress& m_progress;
    RawImport m_out;
    Polygons m_polygons;
    std::vector<glm::vec2> m_uvs;
    std::vector<glm::vec3> m_normals;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> m_normalUses;  ///< position, normal
    Largest m_largestPosition;
    std::uint64_t m_missingUvs = 0;
    std::uint64_t m_missingNormals = 0;
    std::string m_group, m_material;
    bool m_partKnown = false;
    bool m_anyUv = false;
    std::map<std::pair<std::string, std::string>, std::uint32_t> m_partOf;
    std::vector<const std::pair<std::string, std::string>*> m_partKeys;
    ObjMaterials m_materials;
    std::map<std::string, std::string> m_textureOf;
    UniqueNames m_textureNames;
    std::uint64_t m_imageBytes = 0;
    std::uint64_t m_linesAndPoints = 0;
    std::uint64_t m_line = 0;
    int m_libraries = 0;
};

}  // namespace

Result<RawImport> readObj(std::span<const std::uint8_t> bytes, const std::string& name, const Neighbours& neighbours,
                          const ImportOptions& options, Progress& progress) {
    progress.report(0.1f, "Reading the mesh");
    return ObjReader(name, neighbours, options, progress)
        .read({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace whorl::import
