// SPDX-License-Identifier: Apache-2.0
#include "core/io/groom_codec.h"

#include "core/io/codec_pieces.h"
#include "core/io/groom_repair.h"
#include "core/io/json_text.h"
#include "core/io/line_codec.h"
#include "core/io/map_codec.h"
#include "core/param/json.h"

namespace whorl {
namespace {

using nlohmann::json;

static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12 && sizeof(glm::vec2) == 8, "stored as they are");

/// A part without its texts.
struct StoredPart {
    std::uint32_t firstTriangle;
    std::uint32_t triangleCount;
    glm::vec3 baseColour;
};
static_assert(sizeof(StoredPart) == 20, "stored as it is");

json encodeMesh(const SurfaceMesh& mesh, const std::vector<PartSettings>& settings, ContainerWriter& writer) {
    std::vector<StoredPart> parts;
    std::vector<std::uint8_t> texts;
    for (const MeshPart& part : mesh.parts) {
        parts.push_back({part.firstTriangle, part.triangleCount, part.baseColour});
        appendText(texts, part.name);
        appendText(texts, part.texture);
    }
    std::vector<std::uint8_t> flags;
    for (const PartSettings& part : settings)
        flags.push_back(static_cast<std::uint8_t>((part.growsHair ? 1 : 0) | (part.visible ? 2 : 0)));
    return {{"made_atlas", mesh.madeAtlas},
            {"positions", blobToJson(writer.addArray(mesh.positions))},
            {"normals", blobToJson(writer.addArray(mesh.normals))},
            {"triangles", blobToJson(writer.addArray(mesh.triangles))},
            {"corner_uvs", blobToJson(writer.addArray(mesh.cornerUvs))},
            {"parts", blobToJson(writer.addOwned(bytesOf(parts)))},
            {"part_texts", blobToJson(writer.addOwned(std::move(texts)))},
            {"part_settings", blobToJson(writer.addOwned(std::move(flags)))}};
}

json encodeGuides(const GuideSet& guides, ContainerWriter& writer) {
    StoredGuides stored;
    for (std::size_t b = 0; b < guides.blockCount(); ++b) {
        const GuideBlock& block = guides.block(b);
        stored.ids.insert(stored.ids.end(), block.ids.begin(), block.ids.end());
        stored.roots.insert(stored.roots.end(), block.roots.begin(), block.roots.end());
        stored.groups.insert(stored.groups.end(), block.groups.begin(), block.groups.end());
        for (std::size_t i = 0; i < block.count(); ++i)
            stored.sizes.push_back(block.firstPoint[i + 1] - block.firstPoint[i]);
        stored.points.insert(stored.points.end(), block.points.begin(), block.points.end());
    }
    return {{"next_id", guides.nextId()},
            {"ids", blobToJson(writer.addOwned(bytesOf(stored.ids)))},
            {"roots", blobToJson(writer.addOwned(bytesOf(stored.roots)))},
            {"groups", blobToJson(writer.addOwned(std::move(stored.groups)))},
            {"sizes", blobToJson(writer.addOwned(bytesOf(stored.sizes)))},
            {"points", blobToJson(writer.addOwned(bytesOf(stored.points)))}};
}

struct StoredMesh {
    SurfaceMesh mesh;
    std::vector<StoredPart> parts;
    std::vector<std::uint8_t> texts;
    std::vector<std::uint8_t> settings;
};

void readMesh(ManifestReader reader, Wanted& wanted, StoredMesh& stored) {
    stored.mesh.madeAtlas = reader.flag("made_atlas");
    wanted.array(reader.blob("positions"), stored.mesh.positions);
    wanted.array(reader.blob("normals"), stored.mesh.normals);
    wanted.array(reader.blob("triangles"), stored.mesh.triangles);
    wanted.array(reader.blob("corner_uvs"), stored.mesh.cornerUvs);
    wanted.array(reader.blob("parts"), stored.parts);
    wanted.array(reader.blob("part_texts"), stored.texts);
    wanted.array(reader.blob("part_settings"), stored.settings);
    if (!wanted.fault.empty()) return;
    if (stored.mesh.normals.size() != stored.mesh.positions.size() ||
        stored.mesh.cornerUvs.size() != stored.mesh.triangles.size() * 3)
        wanted.fault = "the arrays of its mesh do not fit together.";
}

void readGuides(ManifestReader reader, Wanted& wanted, StoredGuides& stored) {
    stored.nextId = static_cast<std::uint32_t>(reader.number("next_id", UINT32_MAX));
    wanted.array(reader.blob("ids"), stored.ids);
    wanted.array(reader.blob("roots"), stored.roots);
    wanted.array(reader.blob("groups"), stored.groups);
    wanted.array(reader.blob("sizes"), stored.sizes);
    wanted.array(reader.blob("points"), stored.points);
    if (!wanted.fault.empty()) return;
    const std::size_t count = stored.ids.size();
    if (stored.roots.size() != count || stored.groups.size() != count || stored.sizes.size() != count)
        wanted.fault = "the arrays of its guides do not fit together.";
}

Result<void> finishMesh(StoredMesh& stored, Groom& groom, Problems& problems) {
    std::span<const std::uint8_t> texts = stored.texts;
    for (const StoredPart& part : stored.parts) {
        MeshPart whole{.name = {},
                       .firstTriangle = part.firstTriangle,
                       .triangleCount = part.triangleCount,
                       .baseColour = part.baseColour,
                       .texture = {}};
        if (!takeText(texts, whole.name) || !takeText(texts, whole.texture))
            return Error{"the names of its parts are cut short."};
        stored.mesh.parts.push_back(std::move(whole));
    }
    std::vector<PartSettings> settings;
    for (const std::uint8_t flags : stored.settings)
        settings.push_back({.growsHair = (flags & 1) != 0, .visible = (flags & 2) != 0});
    if (auto repaired = repairMesh(stored.mesh, settings, problems); !repaired) return repaired;
    groom.mesh = Cow<SurfaceMesh>(std::move(stored.mesh));
    groom.partSettings = Cow<std::vector<PartSettings>>(std::move(settings));
    return {};
}

template <class Block>
json paramsToJson(Block block) {
    return blockToJson(paramsOf(block));
}

/// Groups and counts: all that needs no pieces.
Result<void> readParameters(const json& manifest, Groom& groom, Problems& problems, std::string& fault) {
    ManifestReader reader(manifest, "its table of contents", fault);
    if (const json* counts = reader.object("counts")) countsFromJson(groom.counts.edit(), *counts, "counts", problems);
    std::vector<Group> groups;
    if (const json* list = reader.array("groups")) {
        if (list->size() > Groom::maxGroups)
            return Error{"it has " + std::to_string(list->size()) + " groups; the most is " +
                         std::to_string(Groom::maxGroups) + "."};
        for (const json& entry : *list) {
            ManifestReader group(entry, "a group", fault);
            groups.push_back({group.text("name"), {}});
            const std::string where = "groups/" + groups.back().name;
            reportUnknownKeys(entry, {"name", "params"}, where, problems);
            if (const json* params = group.object("params"))
                hairParamsFromJson(groups.back().params, *params, where, problems);
        }
    }
    if (!fault.empty()) return {};
    repairGroups(groups, problems);
    groom.groups = Cow<std::vector<Group>>(std::move(groups));
    return {};
}

}  // namespace

json encodeGroom(const Groom& groom, ContainerWriter& writer) {
    json groups = json::array();
    for (const Group& group : *groom.groups)
        groups.push_back({{"name", group.name}, {"params", hairParamsToJson(group.params)}});
    json manifest{{"mesh", encodeMesh(*groom.mesh, *groom.partSettings, writer)},
                  {"guides", encodeGuides(groom.guides, writer)},
                  {"maps", encodeMaps(groom.maps, writer)},
                  {"groups", std::move(groups)},
                  {"counts", countsToJson(*groom.counts)}};
    // Left out when there are none, so that such documents stay the same, byte for byte.
    if (!groom.partings->empty()) manifest["partings"] = encodePartings(*groom.partings, writer);
    if (!groom.strokes->empty()) manifest["strokes"] = encodeStrokes(*groom.strokes, writer);
    if (*groom.field != fieldParamsFor(*groom.mesh)) manifest["field"] = paramsToJson(*groom.field);
    if (*groom.lic != licParamsFor(*groom.mesh)) manifest["lic"] = paramsToJson(*groom.lic);
    return manifest;
}

Result<OpenedDocument> decodeGroom(Container& container, const json& manifest, const std::string& name,
                                   Progress& progress) {
    const auto broken = [&](const std::string& what) { return Error{name + " is broken: " + what}; };
    OpenedDocument opened;
    Problems& problems = opened.problems;
    std::string fault;
    ManifestReader reader(manifest, "its table of contents", fault);
    Wanted wanted{container, fault};
    StoredMesh mesh;
    StoredGuides guides;
    if (const json* object = reader.object("mesh")) {
        reportUnknownKeys(
            *object,
            {"made_atlas", "positions", "normals", "triangles", "corner_uvs", "parts", "part_texts", "part_settings"},
            "mesh", problems);
        readMesh({*object, "its mesh", fault}, wanted, mesh);
    }
    if (const json* object = reader.object("guides")) {
        reportUnknownKeys(*object, {"next_id", "ids", "roots", "groups", "sizes", "points"}, "guides", problems);
        readGuides({*object, "its guides", fault}, wanted, guides);
    }
    LineDecoder lines;
    const auto optional = [&](const char* key) {
        return manifest.is_object() && manifest.contains(key) ? reader.object(key) : nullptr;
    };
    if (const json* object = optional("partings")) lines.readPartings(*object, wanted, problems);
    if (const json* object = optional("strokes")) lines.readStrokes(*object, wanted, problems);
    const json* const field = optional("field");
    const json* const lic = optional("lic");
    MapDecoder maps(container, fault);
    if (const json* list = reader.array("maps")) maps.read(*list, problems, wanted.requests);
    if (auto done = readParameters(manifest, opened.groom, problems, fault); !done) return broken(done.error().message);
    if (!fault.empty()) return broken(fault);
    if (const std::uint32_t rest = container.unclaimed())
        problems.push_back("It holds " + std::to_string(rest) +
                           " pieces of data that this version does not know; they are left out.");

    if (auto done = container.inflate(wanted.requests, progress); !done) return done.error();
    std::uint64_t points = 0;
    for (const std::uint32_t size : guides.sizes) points += size;
    if (points != guides.points.size()) return broken("the points of its guides do not fit together.");
    if (auto done = finishMesh(mesh, opened.groom, problems); !done) return broken(done.error().message);
    opened.groom.guides = repairedGuides(guides, *opened.groom.mesh, *opened.groom.groups, problems);
    opened.groom.setDefaults();
    if (field) blockFromJson(paramsOf(opened.groom.field.edit()), *field, "field", problems);
    if (lic) blockFromJson(paramsOf(opened.groom.lic.edit()), *lic, "lic", problems);
    if (auto done = lines.finish(opened.groom, problems); !done) return broken(done.error().message);
    if (auto done = maps.finish(opened.groom.maps, problems); !done) return broken(done.error().message);
    if (progress.cancelled()) return cancelledError();
    return opened;
}

json blobToJson(const Blob& blob) {
    return json::array({blob.first, blob.count, blob.bytes});
}

ManifestReader::ManifestReader(const json& object, std::string where, std::string& fault)
    : m_object(&object), m_where(std::move(where)), m_fault(fault) {
    if (!object.is_object() && m_fault.empty()) m_fault = m_where + " is not an object.";
}

const json* ManifestReader::find(const char* key) {
    if (!m_fault.empty()) return nullptr;
    const auto found = m_object->find(key);
    if (found != m_object->end()) return &*found;
    wrong(key);
    return nullptr;
}

void ManifestReader::wrong(const char* key) {
    if (m_fault.empty()) m_fault = m_where + " has no right entry \"" + key + "\".";
}

std::uint64_t ManifestReader::number(const char* key, std::uint64_t max) {
    const json* value = find(key);
    if (!value) return 0;
    if (value->is_number_unsigned() && value->get<std::uint64_t>() <= max) return value->get<std::uint64_t>();
    wrong(key);
    return 0;
}

bool ManifestReader::flag(const char* key) {
    const json* value = find(key);
    if (value && value->is_boolean()) return value->get<bool>();
    wrong(key);
    return false;
}

std::string ManifestReader::text(const char* key) {
    const json* value = find(key);
    if (value && value->is_string()) return value->get<std::string>();
    wrong(key);
    return {};
}

Blob ManifestReader::blob(const char* key) {
    const json* value = find(key);
    const auto fits = [&](std::size_t i, std::uint64_t max) {
        return (*value)[i].is_number_unsigned() && (*value)[i].get<std::uint64_t>() <= max;
    };
    if (value && value->is_array() && value->size() == 3 && fits(0, UINT32_MAX) && fits(1, UINT32_MAX) &&
        fits(2, UINT64_MAX))
        return {(*value)[0].get<std::uint32_t>(), (*value)[1].get<std::uint32_t>(), (*value)[2].get<std::uint64_t>()};
    wrong(key);
    return {};
}

const json* ManifestReader::object(const char* key) {
    const json* value = find(key);
    if (value && value->is_object()) return value;
    wrong(key);
    return nullptr;
}

const json* ManifestReader::array(const char* key) {
    const json* value = find(key);
    if (value && value->is_array()) return value;
    wrong(key);
    return nullptr;
}

}  // namespace whorl
