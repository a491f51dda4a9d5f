// SPDX-License-Identifier: Apache-2.0
#include "core/io/hair_formats.h"
#include "core/io/spill_file.h"
#include "core/model/map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace whorl {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as it lies in memory");

struct PlyLook {
    float width;
    std::uint8_t red, green, blue, alpha;
};
static_assert(sizeof(PlyLook) == 8);

struct PlyEdge {
    std::int32_t from, to;
};

std::uint8_t byteOf(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

class PlyWriter : public HairWriter {
public:
    PlyWriter(SafeFile file, SpillFile vertices, SpillFile edges, std::string name, bool normals)
        : m_file(std::move(file)),
          m_vertices(std::move(vertices)),
          m_edges(std::move(edges)),
          m_name(std::move(name)),
          m_normals(normals) {}

    Result<void> add(const Strands& block) override {
        const std::uint64_t base = m_vertices.written() / vertexBytes();
        if (base + block.vertexCount() > std::uint64_t{std::numeric_limits<std::int32_t>::max()})
            return Error{m_name + ": PLY can not count more than 2147483647 vertices; write fewer hairs or parts."};
        std::vector<std::byte> vertices(block.vertexCount() * vertexBytes());
        std::byte* to = vertices.data();
        const auto put = [&](const auto& value) {
            std::memcpy(to, &value, sizeof value);
            to += sizeof value;
        };
        for (std::size_t v = 0; v < block.vertexCount(); ++v) {
            const glm::vec4& colour = block.colours[v];
            put(block.positions[v]);
            if (m_normals) put(block.normals[v]);
            put(PlyLook{block.widths[v], byteOf(srgbFromLinear(std::min(colour.x, 1.0f))),
                        byteOf(srgbFromLinear(std::min(colour.y, 1.0f))),
                        byteOf(srgbFromLinear(std::min(colour.z, 1.0f))), byteOf(colour.w)});
        }
        std::vector<PlyEdge> edges;
        edges.reserve(block.vertexCount());
        for (std::size_t i = 0; i < block.count(); ++i)
            for (std::uint32_t v = block.firstVertex[i]; v + 1 < block.firstVertex[i + 1]; ++v)
                edges.push_back({static_cast<std::int32_t>(base + v), static_cast<std::int32_t>(base + v + 1)});
        if (Result<void> done = m_vertices.write(vertices.data(), vertices.size()); !done) return done;
        return m_edges.write(edges.data(), edges.size() * sizeof(PlyEdge));
    }

    Result<void> finish() override {
        const std::string header =
            "ply\nformat binary_little_endian 1.0\ncomment hair of Whorl, metres, Y up\n"
            "element vertex " +
            std::to_string(m_vertices.written() / vertexBytes()) +
            "\nproperty float x\nproperty float y\nproperty float z\n" +
            (m_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "") +
            "property float width\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "property uchar alpha\nelement edge " +
            std::to_string(m_edges.written() / sizeof(PlyEdge)) +
            "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
        if (Result<void> done = m_file.write(header.data(), header.size()); !done) return done;
        if (Result<void> done = m_vertices.moveTo(m_file); !done) return done;
        if (Result<void> done = m_edges.moveTo(m_file); !done) return done;
        return m_file.commit();
    }

private:
    std::size_t vertexBytes() const { return sizeof(glm::vec3) * (m_normals ? 2 : 1) + sizeof(PlyLook); }

    SafeFile m_file;
    SpillFile m_vertices;
    SpillFile m_edges;
    std::string m_name;
    bool m_normals;
};

}  // namespace

Result<std::unique_ptr<HairWriter>> openHairPly(const std::filesystem::path& file, bool normals) {
    Result<SafeFile> safe = SafeFile::create(file);
    if (!safe) return safe.error();
    Result<SpillFile> vertices = SpillFile::create(file);
    if (!vertices) return vertices.error();
    Result<SpillFile> edges = SpillFile::create(file);
    if (!edges) return edges.error();
    return std::unique_ptr<HairWriter>(
        std::make_unique<PlyWriter>(std::move(*safe), std::move(*vertices), std::move(*edges), file.string(), normals));
}

}  // namespace whorl
