// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/gltf_scene.h"
#include "core/io/plain_text.h"

#include <algorithm>

namespace whorl::import {
namespace {

// The encoded bytes of an image, from its own store or a checked buffer view.
Result<std::vector<std::uint8_t>> imageBytes(const tinygltf::Model& model, const tinygltf::Image& image) {
    if (image.bufferView < 0) {
        if (image.image.empty()) return Error{"it could not be read from the folder of the mesh"};
        return image.image;
    }
    if (static_cast<std::size_t>(image.bufferView) >= model.bufferViews.size())
        return Error{"its buffer view is not there"};
    const auto& view = model.bufferViews[static_cast<std::size_t>(image.bufferView)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
        return Error{"its buffer is not there"};
    const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
        return Error{"its buffer view ends past the buffer"};
    }
    const auto* first = data.data() + view.byteOffset;
    return std::vector<std::uint8_t>(first, first + view.byteLength);
}

}  // namespace

GltfMaterials::GltfMaterials(const tinygltf::Model& model, const std::string& name, const ImportOptions& options,
                             RawImport& out)
    : m_model(model), m_name(name), m_options(options), m_out(out) {}

const GltfMaterial& GltfMaterials::get(int number) {
    const auto [entry, isNew] = m_known.try_emplace(number);
    GltfMaterial& material = entry->second;
    if (!isNew || number < 0 || static_cast<std::size_t>(number) >= m_model.materials.size()) return material;
    const tinygltf::Material& source = m_model.materials[static_cast<std::size_t>(number)];
    const auto& pbr = source.pbrMetallicRoughness;
    if (pbr.baseColorFactor.size() >= 3) {
        for (int i = 0; i < 3; ++i) {
            const double value = pbr.baseColorFactor[static_cast<std::size_t>(i)];
            material.colour[i] = value >= 0.0 ? static_cast<float>(std::min(value, 1.0)) : 0.0f;
        }
    }
    const auto& info = pbr.baseColorTexture;
    if (info.index < 0) return material;
    material.uvSet = std::clamp(info.texCoord, 0, 31);
    material.texture = texture(info.index, source.name);
    if (info.extensions.count("KHR_texture_transform") != 0 && !m_transformNoted && !material.texture.empty()) {
        m_transformNoted = true;
        m_out.problems.push_back(
            plainText(m_name) +
            ": KHR_texture_transform is left out, so textures may sit elsewhere than in other programs.");
    }
    return material;
}

std::string GltfMaterials::texture(int number, const std::string& materialName) {
    if (!m_options.textures || static_cast<std::size_t>(number) >= m_model.textures.size()) return {};
    const int source = m_model.textures[static_cast<std::size_t>(number)].source;
    if (source < 0 || static_cast<std::size_t>(source) >= m_model.images.size()) return {};
    const auto [entry, isNew] = m_textureOfImage.try_emplace(source);
    if (!isNew) return entry->second;
    const tinygltf::Image& image = m_model.images[static_cast<std::size_t>(source)];
    const std::string stem = std::filesystem::path(image.uri).stem().string();
    const std::string wanted = !image.name.empty() ? image.name : !stem.empty() ? stem : materialName;
    const auto leaveOut = [&](const std::string& reason) {
        m_out.problems.push_back(plainText(m_name) + ": the texture " + plainText(wanted, 80) +
                                 " is left out: " + reason + ".");
        return std::string();
    };
    if (m_out.textures.size() >= maxTextures) return leaveOut("more than 64 are not read");
    auto bytes = imageBytes(m_model, image);
    if (!bytes) return leaveOut(bytes.error().message);
    if (bytes->size() > maxImageFileBytes || m_bytes + bytes->size() > maxAllImageBytes) {
        return leaveOut("it is too large");
    }
    m_bytes += bytes->size();
    entry->second = m_names.make(wanted, "texture");
    const std::string shown = image.uri.empty() ? m_name + ", image " + entry->second : image.uri;
    m_out.textures.push_back({entry->second, std::move(*bytes), shown});
    return entry->second;
}

}  // namespace whorl::import
