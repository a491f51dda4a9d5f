// SPDX-License-Identifier: Apache-2.0
#include "core/io/hair_formats.h"
#include "core/io/safe_file.h"
#include "core/sampling/root_sampler.h"

#include <array>
#include <charconv>
#include <string>

namespace whorl {
namespace {

/// RIB as text. Values are named and classed as the render-time library gives them to RenderMan (ri_curves.cpp).
class RibWriter : public HairWriter {
public:
    RibWriter(SafeFile file, bool normals) : m_file(std::move(file)), m_normals(normals) {}

    Result<void> add(const Strands& block) override {
        if (const Result<void> begun = begin(); !begun) return begun;
        m_text = "Curves \"cubic\" [";
        for (std::size_t i = 0; i < block.count(); ++i) number(block.firstVertex[i + 1] - block.firstVertex[i] + 2);
        m_text += "] \"nonperiodic\"\n\"vertex point P\" [";
        eachVertex(block, 2, [&](std::uint32_t v) { three(block.positions[v]); });
        m_text += "]\n\"vertex float width\" [";
        eachVertex(block, 2, [&](std::uint32_t v) { number(block.widths[v]); });
        if (m_normals) {
            m_text += "]\n\"varying normal N\" [";
            eachVertex(block, 1, [&](std::uint32_t v) { three(block.normals[v]); });
        }
        m_text += "]\n\"varying color Cs\" [";
        eachVertex(block, 1, [&](std::uint32_t v) { three(glm::vec3(block.colours[v])); });
        m_text += "]\n\"varying color Os\" [";
        eachVertex(block, 1, [&](std::uint32_t v) { three(glm::vec3(block.colours[v].w)); });
        m_text += "]\n\"uniform float s\" [";
        for (const glm::vec2& uv : block.rootUvs) number(uv.x);
        m_text += "]\n\"uniform float t\" [";
        for (const glm::vec2& uv : block.rootUvs) number(uv.y);
        m_text += "]\n\"uniform int hair_id\" [";
        for (const std::uint32_t id : block.ids) number(numberOf(id));
        m_text += "]\n\"uniform int hair_member\" [";
        for (const std::uint8_t member : block.members) number(std::uint32_t{member});
        m_text += "]\n\"uniform int hair_group\" [";
        for (const std::uint8_t group : block.groups) number(std::uint32_t{group});
        m_text += "]\n";
        return m_file.write(m_text.data(), m_text.size());
    }

    Result<void> finish() override {
        if (const Result<void> begun = begin(); !begun) return begun;
        constexpr std::string_view end = "AttributeEnd\n";
        if (const Result<void> done = m_file.write(end.data(), end.size()); !done) return done;
        return m_file.commit();
    }

private:
    Result<void> begin() {
        if (std::exchange(m_begun, true)) return {};
        constexpr std::string_view start =
            "##RenderMan RIB-Structure 1.1 Entity\n# Hair of Whorl, metres, Y up\nAttributeBegin\n"
            "Basis \"catmull-rom\" 1 \"catmull-rom\" 1\n";
        return m_file.write(start.data(), start.size());
    }

    /// Ends come `atEnds` times: the curve begins and ends between two vertices that are the same.
    template <class Use>
    static void eachVertex(const Strands& block, int atEnds, const Use& use) {
        for (std::size_t i = 0; i < block.count(); ++i) {
            const std::uint32_t first = block.firstVertex[i], last = block.firstVertex[i + 1] - 1;
            for (std::uint32_t v = first; v <= last; ++v)
                for (int times = v == first || v == last ? atEnds : 1; times > 0; --times) use(v);
        }
    }

    // The shortest text that reads back equal, whatever the locale.
    template <class Number>
    void number(Number value) {
        std::array<char, 32> digits;
        const auto done = std::to_chars(digits.data(), digits.data() + digits.size(), value);
        if (m_text.back() != '[') m_text += ' ';
        m_text.append(digits.data(), done.ptr);
    }
    void three(const glm::vec3& v) {
        for (int axis = 0; axis < 3; ++axis) number(v[axis]);
    }

    SafeFile m_file;
    bool m_normals;
    std::string m_text;
    bool m_begun = false;
};

}  // namespace

Result<std::unique_ptr<HairWriter>> openHairRib(const std::filesystem::path& file, bool normals) {
    Result<SafeFile> safe = SafeFile::create(file);
    if (!safe) return safe.error();
    return std::unique_ptr<HairWriter>(std::make_unique<RibWriter>(std::move(*safe), normals));
}

}  // namespace whorl
