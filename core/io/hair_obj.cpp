// SPDX-License-Identifier: Apache-2.0
#include "core/io/hair_formats.h"
#include "core/io/safe_file.h"

#include <array>
#include <charconv>
#include <string>

namespace whorl {
namespace {

// Numbers as text, the shortest that reads back equal, whatever the locale.
template <class Number>
void addNumber(std::string& text, Number number) {
    std::array<char, 32> digits;
    const std::to_chars_result done = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text += ' ';
    text.append(digits.data(), done.ptr);
}

class ObjWriter : public HairWriter {
public:
    explicit ObjWriter(SafeFile file) : m_file(std::move(file)) {}

    Result<void> add(const Strands& block) override {
        std::string text = m_vertices == 0 ? "# Hair of Whorl, metres, Y up\no hair\n" : "";
        for (std::size_t i = 0; i < block.count(); ++i) {
            const std::uint32_t first = block.firstVertex[i], end = block.firstVertex[i + 1];
            for (std::uint32_t v = first; v < end; ++v) {
                text += 'v';
                for (int axis = 0; axis < 3; ++axis) addNumber(text, block.positions[v][axis]);
                text += '\n';
            }
            for (std::uint32_t v = first; v + 1 < end; ++v) {
                text += 'l';
                addNumber(text, m_vertices + v + 1);
                addNumber(text, m_vertices + v + 2);
                text += '\n';
            }
        }
        m_vertices += block.vertexCount();
        return m_file.write(text.data(), text.size());
    }

    Result<void> finish() override { return m_file.commit(); }

private:
    SafeFile m_file;
    std::uint64_t m_vertices = 0;
};

}  // namespace

Result<std::unique_ptr<HairWriter>> openHairObj(const std::filesystem::path& file, bool /*normals*/) {
    Result<SafeFile> safe = SafeFile::create(file);
    if (!safe) return safe.error();
    return std::unique_ptr<HairWriter>(std::make_unique<ObjWriter>(std::move(*safe)));
}

}  // namespace whorl
