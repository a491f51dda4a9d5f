// SPDX-License-Identifier: Apache-2.0
// PLY: text or binary of either byte order, properties in any order, faces as lists or triangle strips.
#include "core/io/import/ply_header.h"
#include "core/io/import/polygons.h"
#include "core/io/plain_text.h"

#include <cmath>

namespace whorl::import {
namespace {

constexpr std::uint64_t maxCorners = maxTriangles * 4;

class PlyReader {
public:
    PlyReader(const std::string& name, PlyHeader header, std::string_view values, Progress& progress)
        : m_name(name), m_header(std::move(header)), m_values(values, m_header.encoding), m_progress(progress) {}

    Result<RawImport> read() {
        for (const PlyElement& element : m_header.elements) {
            // A header can not claim more than the file holds.
            const std::uint64_t each = element.smallestBytes(m_header.encoding);
            if (each == 0) continue;
            if (element.count > (m_values.bytesLeft() + 1) / each) {
                return meshError(m_name, "it claims " + std::to_string(element.count) + " of the element '" +
                                             plainText(element.name, 40) + "', more than its " +
                                             std::to_string(m_values.bytesLeft()) + " bytes can hold");
            }
            auto done = element.name == "vertex"      ? readVertices(element)
                        : element.name == "face"      ? readFaces(element)
                        : element.name == "tristrips" ? readStrips(element)
                                                      : skip(element);
            if (!done) return done.error();
        }
        return finish();
    }

private:
    Error cutOff(const PlyElement& element, std::uint64_t number) const {
        return meshError(m_name, "the element '" + plainText(element.name, 40) + "' number " +
                                     std::to_string(number + 1) + " is cut off or holds no number");
    }
    bool stopAt(std::uint64_t i) const { return i % 16384 == 0 && m_progress.cancelled(); }

    // The length of a list; nothing where it is negative or not there.
    std::optional<std::uint64_t> length(PlyType type) {
        const auto count = m_values.take(type);
        if (!count || !(*count >= 0.0) || *count > static_cast<double>(m_values.bytesLeft())) return std::nullopt;
        return static_cast<std::uint64_t>(*count);
    }

    bool skipProperty(const PlyProperty& property) {
        if (!property.listCount) return m_values.take(property.type).has_value();
        const auto count = length(*property.listCount);
        if (!count) return false;
        for (std::uint64_t i = 0; i < *count; ++i) {
            if (!m_values.take(property.type)) return false;
        }
        return true;
    }

    Result<void> skip(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (stopAt(i)) return cancelledError();
            for (const PlyProperty& property : element.properties) {
                if (!skipProperty(property)) return cutOff(element, i);
            }
            m_values.endElement();
        }
        return {};
    }

    Result<void> readVertices(const PlyElement& element) {
        const int wanted[8] = {element.find({"x"}),
                               element.find({"y"}),
                               element.find({"z"}),
                               element.find({"nx"}),
                               element.find({"ny"}),
                               element.find({"nz"}),
                               element.find({"s", "u", "texture_u", "texcoord_u"}),
                               element.find({"t", "v", "texture_v", "texcoord_v"})};
        if (wanted[0] < 0 || wanted[1] < 0 || wanted[2] < 0)
            return meshError(m_name, "its vertices have no x, y and z");
        if (!m_out.mesh.positions.empty()) return meshError(m_name, "it has two lists of vertices");
        const bool normals = wanted[3] >= 0 && wanted[4] >= 0 && wanted[5] >= 0;
        const bool uvs = wanted[6] >= 0 && wanted[7] >= 0;
        std::vector<int> slotOf(element.properties.size(), -1);
        for (int slot = 0; slot < 8; ++slot) {
            if (wanted[slot] >= 0) slotOf[static_cast<std::size_t>(wanted[slot])] = slot;
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (stopAt(i)) return cancelledError();
            float value[8] = {};
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                if (property.listCount) {
                    if (!skipProperty(property)) return cutOff(element, i);
                    continue;
                }
                const auto got = m_values.take(property.type);
                if (!got) return cutOff(element, i);
                // Past the range of float a double is as good as infinite.
                const double most = static_cast<double>(std::numeric_limits<float>::max());
                const double safe = *got > most    ? std::numeric_limits<double>::infinity()
                                    : *got < -most ? -std::numeric_limits<double>::infinity()
                                                   : *got;
                if (slotOf[p] >= 0) value[slotOf[p]] = static_cast<float>(safe);
            }
            m_values.endElement();
            m_out.mesh.positions.emplace_back(value[0], value[1], value[2]);
            if (normals) m_out.mesh.normals.emplace_back(value[3], value[4], value[5]);
            if (uvs) m_vertexUvs.emplace_back(value[6], value[7]);
        }
        return {};
    }

    Result<std::uint32_t> index(double value) {
        // Faces may come before the vertices, so only the end of the file tells whether a number is too large.
        if (!(value >= 0.0 && value < 4294967295.0) || value != std::floor(value)) {
            return meshError(m_name, "a face names a vertex that can not be");
        }
        m_largest = std::max(m_largest, static_cast<std::uint64_t>(value));
        return static_cast<std::uint32_t>(value);
    }

    Result<void> readFaces(const PlyElement& element) {
        const int indices = element.find({"vertex_indices", "vertex_index"});
        const int uvList = element.find({"texcoord"});
        if (indices < 0 || !element.properties[static_cast<std::size_t>(indices)].listCount) {
            return meshError(m_name, "its faces have no list of vertices");
        }
        std::vector<float> uvs;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (stopAt(i)) return cancelledError();
            std::uint64_t corners = 0;
            uvs.clear();
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                const bool isIndices = static_cast<int>(p) == indices;
                const bool isUvs = static_cast<int>(p) == uvList && property.listCount;
                if (!isIndices && !isUvs) {
                    if (!skipProperty(property)) return cutOff(element, i);
                    continue;
                }
                const auto count = length(*property.listCount);
                if (!count) return cutOff(element, i);
                if (isIndices) corners = *count;
                for (std::uint64_t k = 0; k < *count; ++k) {
                    const auto value = m_values.take(property.type);
                    if (!value) return cutOff(element, i);
                    if (isUvs) {
                        uvs.push_back(static_cast<float>(std::abs(*value) < 1e30 ? *value : 0.0));
                        continue;
                    }
                    const auto vertex = index(*value);
                    if (!vertex) return vertex.error();
                    m_polygons.positions.push_back(*vertex);
                }
            }
            m_values.endElement();
            if (auto added = addFace(corners, uvs); !added) return added.error();
        }
        return {};
    }

    // Closes the face whose corners were just pushed.
    Result<void> addFace(std::uint64_t corners, const std::vector<float>& uvs) {
        const std::size_t before = m_polygons.positions.size() - corners;
        if (corners < 3) {
            m_polygons.positions.resize(before);
            ++m_tooSmall;
            return {};
        }
        if (uvs.size() == corners * 2) {
            m_polygons.uvs.resize(before, Polygons::noUv);
            for (std::uint64_t k = 0; k < corners; ++k) {
                m_polygons.uvs.push_back(static_cast<std::uint32_t>(m_faceUvs.size()));
                m_faceUvs.emplace_back(uvs[k * 2], uvs[k * 2 + 1]);
            }
        }
        m_polygons.triangles += corners - 2;
        m_polygons.faceEnds.push_back(m_polygons.positions.size());
        if (m_polygons.triangles > maxTriangles || m_polygons.positions.size() > maxCorners) {
            return meshError(m_name, "it has more than 20 million triangles", "reduce the mesh and export it again");
        }
        return {};
    }

    // Strips of triangles, -1 between them, as old scanners write.
    Result<void> readStrips(const PlyElement& element) {
        const int indices = element.find({"vertex_indices", "vertex_index"});
        if (indices < 0 || !element.properties[static_cast<std::size_t>(indices)].listCount) return skip(element);
        std::vector<std::uint32_t> strip;
        const auto close = [&]() -> Result<void> {
            for (std::size_t k = 2; k < strip.size(); ++k) {
                const std::uint32_t a = strip[k - 2], b = strip[k - 1];
                const std::uint32_t first = k % 2 == 0 ? a : b, second = k % 2 == 0 ? b : a;
                m_polygons.positions.insert(m_polygons.positions.end(), {first, second, strip[k]});
                if (auto added = addFace(3, {}); !added) return added.error();
            }
            strip.clear();
            return {};
        };
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                if (static_cast<int>(p) != indices) {
                    if (!skipProperty(property)) return cutOff(element, i);
                    continue;
                }
                const auto count = length(*property.listCount);
                if (!count) return cutOff(element, i);
                for (std::uint64_t k = 0; k < *count; ++k) {
                    const auto value = m_values.take(property.type);
                    if (!value) return cutOff(element, i);
                    if (*value == -1.0) {
                        if (auto closed = close(); !closed) return closed.error();
                        continue;
                    }
                    const auto vertex = index(*value);
                    if (!vertex) return vertex.error();
                    strip.push_back(*vertex);
                }
                if (auto closed = close(); !closed) return closed.error();
            }
        }
        return {};
    }

    Result<RawImport> finish() {
        if (m_polygons.faceEnds.empty()) {
            return meshError(m_name, "there are no faces in it", "choose a file with a surface that hair can grow on");
        }
        if (m_largest >= m_out.mesh.positions.size()) {
            return meshError(m_name, "a face names vertex " + std::to_string(m_largest) + " of " +
                                         std::to_string(m_out.mesh.positions.size()) + " (counted from 0)");
        }
        MeshPart part;
        part.name = "mesh";
        m_out.mesh.parts.push_back(part);
        if (!m_faceUvs.empty()) {
            m_polygons.uvs.resize(m_polygons.positions.size(), Polygons::noUv);
            cutPolygons(m_polygons, m_faceUvs, m_out.mesh);
        } else {
            if (!m_vertexUvs.empty()) m_polygons.uvs = m_polygons.positions;
            cutPolygons(m_polygons, m_vertexUvs, m_out.mesh);
        }
        m_out.sourceTriangles = m_polygons.triangles;
        if (m_tooSmall > 0) {
            m_out.problems.push_back(plainText(m_name) + ": " + counted(m_tooSmall, "face") +
                                     " with fewer than three corners skipped.");
        }
        return std::move(m_out);
    }

    const std::string& m_name;
    PlyHeader m_header;
    PlyValues m_values;
    Progress& m_progress;
    RawImport m_out;
    Polygons m_polygons;
    std::vector<glm::vec2> m_vertexUvs;
    std::vector<glm::vec2> m_faceUvs;
    std::uint64_t m_largest = 0;
    std::uint64_t m_tooSmall = 0;
};

}  // namespace

Result<RawImport> readPly(std::span<const std::uint8_t> bytes, const std::string& name, Progress& progress) {
    progress.report(0.1f, "Reading the mesh");
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    auto header = readPlyHeader(text);
    if (!header) return meshError(name, header.error().message);
    const std::string_view values = text.substr(header->bytes);
    return PlyReader(name, std::move(*header), values, progress).read();
}

}  // namespace whorl::import
