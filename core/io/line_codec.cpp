// SPDX-License-Identifier: Apache-2.0
#include "core/io/line_codec.h"

#include "core/io/groom_repair.h"
#include "core/io/json_text.h"

namespace whorl {

using nlohmann::json;

namespace {

static_assert(sizeof(SurfacePoint) == 12, "stored as it is");

template <class Line>
json encodeLines(const std::vector<Line>& lines, ContainerWriter& writer) {
    std::vector<std::uint32_t> ids, sizes;
    std::vector<SurfacePoint> points;
    for (const Line& line : lines) {
        ids.push_back(line.id);
        sizes.push_back(static_cast<std::uint32_t>(line.points.size()));
        points.insert(points.end(), line.points.begin(), line.points.end());
    }
    json object;
    object["ids"] = blobToJson(writer.addOwned(bytesOf(ids)));
    object["sizes"] = blobToJson(writer.addOwned(bytesOf(sizes)));
    object["points"] = blobToJson(writer.addOwned(bytesOf(points)));
    return object;
}

template <class Lines>
void readLines(ManifestReader& reader, Wanted& wanted, Lines& lines) {
    wanted.array(reader.blob("ids"), lines.ids);
    wanted.array(reader.blob("sizes"), lines.sizes);
    wanted.array(reader.blob("points"), lines.points);
}

/// Calls `take(i, points)` for every line; false when sizes and points do not fit together.
template <class Lines, class Take>
bool eachLine(const Lines& lines, Take&& take) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < lines.ids.size(); ++i) {
        if (lines.sizes[i] > lines.points.size() - at) return false;
        const auto first = lines.points.begin() + static_cast<std::ptrdiff_t>(at);
        take(i, std::vector<SurfacePoint>(first, first + static_cast<std::ptrdiff_t>(lines.sizes[i])));
        at += lines.sizes[i];
    }
    return at == lines.points.size();
}

}  // namespace

json encodePartings(const std::vector<Parting>& partings, ContainerWriter& writer) {
    json object = encodeLines(partings, writer);
    std::vector<std::uint8_t> names;
    for (const Parting& parting : partings) appendText(names, parting.name);
    object["names"] = blobToJson(writer.addOwned(std::move(names)));
    return object;
}

json encodeStrokes(const std::vector<FieldStroke>& strokes, ContainerWriter& writer) {
    json object = encodeLines(strokes, writer);
    std::vector<std::uint8_t> kinds;
    std::vector<float> numbers;
    for (const FieldStroke& stroke : strokes) {
        kinds.push_back(static_cast<std::uint8_t>(stroke.kind));
        numbers.push_back(stroke.weight);
        numbers.push_back(stroke.radius);
    }
    object["kinds"] = blobToJson(writer.addOwned(std::move(kinds)));
    object["numbers"] = blobToJson(writer.addOwned(bytesOf(numbers)));
    return object;
}

void LineDecoder::readPartings(const json& object, Wanted& wanted, Problems& problems) {
    reportUnknownKeys(object, {"ids", "sizes", "points", "names"}, "partings", problems);
    ManifestReader reader(object, "its partings", wanted.fault);
    readLines(reader, wanted, m_partings);
    wanted.array(reader.blob("names"), m_names);
    if (wanted.fault.empty() && m_partings.sizes.size() != m_partings.ids.size())
        wanted.fault = "the arrays of its partings do not fit together.";
}

void LineDecoder::readStrokes(const json& object, Wanted& wanted, Problems& problems) {
    reportUnknownKeys(object, {"ids", "sizes", "points", "kinds", "numbers"}, "strokes", problems);
    ManifestReader reader(object, "its strokes", wanted.fault);
    readLines(reader, wanted, m_strokes);
    wanted.array(reader.blob("kinds"), m_kinds);
    wanted.array(reader.blob("numbers"), m_numbers);
    const std::size_t count = m_strokes.ids.size();
    if (wanted.fault.empty() &&
        (m_strokes.sizes.size() != count || m_kinds.size() != count || m_numbers.size() != count * 2))
        wanted.fault = "the arrays of its strokes do not fit together.";
}

Result<void> LineDecoder::finish(Groom& groom, Problems& problems) const {
    std::vector<Parting> partings;
    std::span<const std::uint8_t> names = m_names;
    bool named = true;
    const bool whole = eachLine(m_partings, [&](std::size_t i, std::vector<SurfacePoint> points) {
        std::string name;
        named = named && takeText(names, name);
        partings.push_back({m_partings.ids[i], std::move(name), std::move(points)});
    });
    if (!named) return Error{"the names of its partings are cut short."};
    if (!whole) return Error{"the points of its partings do not fit together."};
    repairPartings(partings, *groom.mesh, problems);
    if (!partings.empty()) groom.partings = Cow<std::vector<Parting>>(std::move(partings));

    std::vector<FieldStroke> strokes;
    const bool fits = eachLine(m_strokes, [&](std::size_t i, std::vector<SurfacePoint> points) {
        strokes.push_back({m_strokes.ids[i], static_cast<StrokeKind>(m_kinds[i]), m_numbers[i * 2],
                           m_numbers[i * 2 + 1], std::move(points)});
    });
    if (!fits) return Error{"the points of its strokes do not fit together."};
    repairStrokes(strokes, *groom.mesh, problems);
    if (!strokes.empty()) groom.strokes = Cow<std::vector<FieldStroke>>(std::move(strokes));
    return {};
}

}  // namespace whorl
