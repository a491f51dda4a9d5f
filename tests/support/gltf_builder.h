// SPDX-License-Identifier: Apache-2.0
// Makes small glTF files for tests, one accessor after another.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace whorl::testing {

class GltfBuilder {
public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::uint8_t> bytes;

    template <class T>
    int addView(const std::vector<T>& values, int stride = 0) {
        while (bytes.size() % 4 != 0) bytes.push_back(0);
        nlohmann::json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}};
        if (stride != 0) view["byteStride"] = stride;
        const auto* raw = reinterpret_cast<const std::uint8_t*>(values.data());
        bytes.insert(bytes.end(), raw, raw + values.size() * sizeof(T));
        return add("bufferViews", view);
    }

    int addAccessor(int view, int componentType, const std::string& type, std::size_t count, std::size_t offset = 0,
                    bool normalized = false) {
        nlohmann::json accessor = {{"componentType", componentType}, {"type", type}, {"count", count}};
        if (view >= 0) accessor["bufferView"] = view;
        if (view >= 0) accessor["byteOffset"] = offset;
        if (normalized) accessor["normalized"] = true;
        return add("accessors", accessor);
    }

    int addFloats(const std::vector<float>& values, const std::string& type, std::size_t components) {
        return addAccessor(addView(values), 5126, type, values.size() / components);
    }

    /// Adds to an array of the root and gives the number.
    int add(const char* list, const nlohmann::json& item) {
        json[list].push_back(item);
        return static_cast<int>(json[list].size()) - 1;
    }

    /// One mesh with one primitive, shown by one node.
    void show(const nlohmann::json& primitive) {
        add("meshes", {{"primitives", nlohmann::json::array({primitive})}});
        add("nodes", {{"mesh", json["meshes"].size() - 1}});
        json["scenes"] = nlohmann::json::array({{{"nodes", nlohmann::json::array({0})}}});
        json["scene"] = 0;
    }

    std::vector<std::uint8_t> glb() const {
        nlohmann::json whole = json;
        if (!bytes.empty()) whole["buffers"] = nlohmann::json::array({{{"byteLength", bytes.size()}}});
        std::string text = whole.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::vector<std::uint8_t> data = bytes;
        data.resize((data.size() + 3) / 4 * 4);
        std::vector<std::uint8_t> out;
        const auto word = [&](std::size_t value) {
            for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
        };
        word(0x46546c67);
        word(2);
        word(12 + 8 + text.size() + (data.empty() ? 0 : 8 + data.size()));
        word(text.size());
        word(0x4e4f534a);
        out.insert(out.end(), text.begin(), text.end());
        if (data.empty()) return out;
        word(data.size());
        word(0x004e4942);
        out.insert(out.end(), data.begin(), data.end());
        return out;
    }

    /// JSON whose only buffer is the file `uri`.
    std::string gltf(const std::string& uri) const {
        nlohmann::json whole = json;
        whole["buffers"] = nlohmann::json::array({{{"byteLength", bytes.size()}, {"uri", uri}}});
        return whole.dump();
    }
};

}  // namespace whorl::testing
