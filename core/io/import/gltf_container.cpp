// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/gltf_container.h"

#include <cstring>

namespace whorl::import {
namespace {

constexpr int maxDepth = 64;
constexpr std::uint64_t maxValues = 4'000'000;

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
    return bytes[at] | (std::uint32_t{bytes[at + 1]} << 8) | (std::uint32_t{bytes[at + 2]} << 16) |
           (std::uint32_t{bytes[at + 3]} << 24);
}

// Counts brackets outside of strings. What is no JSON at all is left to the parser.
Result<void> checkJson(std::string_view json) {
    int depth = 0;
    std::uint64_t values = 0;
    bool inText = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (inText) {
            if (c == '\\') ++i;
            inText = c != '"';
            continue;
        }
        if (c == '"') {
            inText = true;
        } else if (c == '[' || c == '{') {
            ++values;
            if (++depth > maxDepth) return Error{"its JSON is nested deeper than 64"};
        } else if (c == ']' || c == '}') {
            --depth;
        } else if (c == ',') {
            ++values;
        }
    }
    if (values > maxValues) return Error{"its JSON holds more than four million values"};
    return {};
}

}  // namespace

Result<GltfContainer> openContainer(std::span<const std::uint8_t> bytes) {
    GltfContainer container;
    container.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) {
        container.binary = true;
        if (bytes.size() < 20) return Error{"the file is cut off in its header"};
        const std::uint32_t version = word(bytes, 4);
        const std::uint64_t length = word(bytes, 8);
        const std::uint64_t jsonLength = word(bytes, 12);
        if (version != 2) return Error{"it is glTF version " + std::to_string(version) + ", only version 2 is read"};
        if (length > bytes.size()) {
            return Error{"it claims " + std::to_string(length) + " bytes but has " + std::to_string(bytes.size())};
        }
        if (length < 20 || jsonLength > length - 20 || std::memcmp(&bytes[16], "JSON", 4) != 0) {
            return Error{"the sizes in its header do not fit together"};
        }
        const std::uint64_t next = 20 + jsonLength;
        if (length - next >= 8) {
            if (word(bytes, next) > length - next - 8) return Error{"the sizes in its header do not fit together"};
        } else if (length != next) {
            return Error{"the file is cut off after its JSON"};
        }
        container.json = container.json.substr(20, jsonLength);
        container.usedBytes = length;
    } else if (const std::size_t first = container.json.find_first_not_of(" \t\r\n");
               container.json.substr(0, 3) != "\xef\xbb\xbf" &&
               (first == container.json.npos || container.json[first] != '{')) {
        return Error{"it is no glTF file"};
    }
    if (auto checked = checkJson(container.json); !checked) return checked.error();
    return container;
}

bool knownExtension(std::string_view name) {
    // None of these moves a triangle: materials, textures, lights, names. Quantised positions are read as they are.
    for (const std::string_view prefix :
         {"KHR_materials_", "KHR_texture_", "KHR_lights_", "KHR_xmp", "KHR_animation_", "ADOBE_materials_",
          "EXT_texture_", "MSFT_texture_", "EXT_lights_", "VRM", "KHR_technique", "KHR_node_visibility", "KHR_audio"}) {
        if (name.substr(0, prefix.size()) == prefix) return true;
    }
    return name == "KHR_mesh_quantization" || name == "MSFT_lod" || name == "MSFT_packing_occlusionRoughnessMetallic";
}

}  // namespace whorl::import
