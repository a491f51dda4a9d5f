// SPDX-License-Identifier: Apache-2.0
#include "core/io/hair_formats.h"
#include "core/io/spill_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

namespace whorl {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as it lies in memory");

// http://www.cemyuksel.com/research/hairmodels/
struct Header {
    char magic[4] = {'H', 'A', 'I', 'R'};
    std::uint32_t strands = 0;
    std::uint32_t points = 0;
    std::uint32_t arrays = 0;
    std::uint32_t segments = 0;
    float thickness = 0.0f;
    float transparency = 0.0f;
    float colour[3] = {1.0f, 1.0f, 1.0f};
    char information[88] = {};
};
static_assert(sizeof(Header) == 128);

enum Array : std::uint32_t { Segments = 1, Points = 2, Thickness = 4, Transparency = 8, Colours = 16 };

constexpr std::uint64_t maxFileBytes = std::uint64_t{4} << 30;

class YukselWriter : public HairWriter {
public:
    static Result<std::unique_ptr<HairWriter>> open(const std::filesystem::path& file) {
        Result<SafeFile> safe = SafeFile::create(file);
        if (!safe) return safe.error();
        auto writer = std::unique_ptr<YukselWriter>(new YukselWriter(std::move(*safe), file.string()));
        for (std::optional<SpillFile>* array : writer->arrays()) {
            Result<SpillFile> spill = SpillFile::create(file);
            if (!spill) return spill.error();
            *array = std::move(*spill);
        }
        return std::unique_ptr<HairWriter>(std::move(writer));
    }

    Result<void> add(const Strands& block) override {
        if (m_points + block.vertexCount() > std::numeric_limits<std::uint32_t>::max())
            return Error{m_name + ": a .hair file can not count more than 4294967295 points; write fewer hairs."};
        m_strands += block.count();
        m_points += block.vertexCount();
        std::vector<std::uint16_t> segments;
        segments.reserve(block.count());
        for (std::size_t i = 0; i < block.count(); ++i)
            segments.push_back(static_cast<std::uint16_t>(block.firstVertex[i + 1] - block.firstVertex[i] - 1));
        std::vector<float> transparency;
        std::vector<glm::vec3> colours;
        transparency.reserve(block.vertexCount());
        colours.reserve(block.vertexCount());
        for (const glm::vec4& colour : block.colours) {
            transparency.push_back(1.0f - colour.w);
            colours.emplace_back(colour.x, colour.y, colour.z);
        }
        Result<void> done = write(m_segments, segments);
        if (done) done = write(m_positions, block.positions);
        if (done) done = write(m_thickness, block.widths);
        if (done) done = write(m_transparency, transparency);
        if (done) done = write(m_colours, colours);
        return done;
    }

    Result<void> finish() override {
        Header header;
        header.strands = static_cast<std::uint32_t>(m_strands);
        header.points = static_cast<std::uint32_t>(m_points);
        header.arrays = Segments | Points | Thickness | Transparency | Colours;
        static constexpr char information[] = "Hair of Whorl, metres, Y up";
        std::memcpy(header.information, information, sizeof information);
        if (Result<void> done = m_file.write(&header, sizeof header); !done) return done;
        for (std::optional<SpillFile>* array : arrays())
            if (Result<void> done = (*array)->moveTo(m_file); !done) return done;
        return m_file.commit();
    }

private:
    YukselWriter(SafeFile file, std::string name) : m_file(std::move(file)), m_name(std::move(name)) {}

    // In the order of the file.
    std::vector<std::optional<SpillFile>*> arrays() {
        return {&m_segments, &m_positions, &m_thickness, &m_transparency, &m_colours};
    }

    template <class T, class Memory>
    static Result<void> write(std::optional<SpillFile>& array, const std::vector<T, Memory>& values) {
        return array->write(values.data(), values.size() * sizeof(T));
    }

    SafeFile m_file;
    std::string m_name;
    std::optional<SpillFile> m_segments, m_positions, m_thickness, m_transparency, m_colours;
    std::uint64_t m_strands = 0;
    std::uint64_t m_points = 0;
};

}  // namespace

Result<std::unique_ptr<HairWriter>> openHairYuksel(const std::filesystem::path& file, bool /*normals*/) {
    return YukselWriter::open(file);
}

Result<std::vector<std::vector<glm::vec3>>> readHairFile(const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    const auto bad = [&](const std::string& what) {
        return Error{name + " can not be read as hair: " + what + ". Export it again from the program that made it."};
    };
    const Result<std::vector<std::uint8_t>> read = readFile(file, maxFileBytes);
    if (!read) return read.error();
    const std::vector<std::uint8_t>& bytes = *read;
    Header header;
    if (bytes.size() < sizeof header) return bad("it is shorter than the header of a .hair file");
    std::memcpy(&header, bytes.data(), sizeof header);
    if (std::memcmp(header.magic, "HAIR", 4) != 0) return bad("it does not start with HAIR");
    if ((header.arrays & Points) == 0) return bad("it holds no points");

    const std::uint64_t strands = header.strands, points = header.points;
    const std::uint64_t segmentBytes = (header.arrays & Segments) ? strands * 2 : 0;
    std::uint64_t wanted = sizeof header + segmentBytes + points * 12;
    if (header.arrays & Thickness) wanted += points * 4;
    if (header.arrays & Transparency) wanted += points * 4;
    if (header.arrays & Colours) wanted += points * 12;
    if (bytes.size() < wanted) {
        return bad("it promises " + std::to_string(wanted) + " bytes but has only " + std::to_string(bytes.size()));
    }

    const auto segmentsOf = [&](std::uint64_t strand) -> std::uint64_t {
        if ((header.arrays & Segments) == 0) return header.segments;
        std::uint16_t segments = 0;
        std::memcpy(&segments, bytes.data() + sizeof header + strand * 2, sizeof segments);
        return segments;
    };
    // Strands without a list of their segments are alike; counting them one by one would take as long as a liar likes.
    std::uint64_t counted = 0;
    if ((header.arrays & Segments) == 0) {
        counted = strands * (std::uint64_t{header.segments} + 1);
    } else {
        for (std::uint64_t i = 0; i < strands; ++i) counted += segmentsOf(i) + 1;
    }
    if (counted != points) {
        return bad("its strands need " + std::to_string(counted) + " points but it has " + std::to_string(points));
    }

    std::vector<std::vector<glm::vec3>> curves;
    const std::uint8_t* from = bytes.data() + sizeof header + segmentBytes;
    for (std::uint64_t i = 0; i < strands; ++i) {
        const std::size_t count = static_cast<std::size_t>(segmentsOf(i)) + 1;
        std::vector<glm::vec3> curve(count);
        std::memcpy(curve.data(), from, count * sizeof(glm::vec3));
        from += count * sizeof(glm::vec3);
        for (const glm::vec3& p : curve)
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                return bad("strand " + std::to_string(i + 1) + " has a point that is not a number");
        if (count >= 2) curves.push_back(std::move(curve));
    }
    return curves;
}

}  // namespace whorl
