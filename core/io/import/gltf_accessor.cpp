// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace whorl::import {
namespace {

// 0 for what is no component type.
std::uint64_t componentBytes(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

template <class T>
double number(const std::uint8_t* bytes, bool normalised) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    if (!normalised) return static_cast<double>(value);
    return std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

double decode(const std::uint8_t* bytes, int type, bool normalised) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return number<std::int8_t>(bytes, normalised);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return number<std::uint8_t>(bytes, normalised);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return number<std::int16_t>(bytes, normalised);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return number<std::uint16_t>(bytes, normalised);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return number<std::uint32_t>(bytes, normalised);
        default:
            return number<float>(bytes, false);
    }
}

}  // namespace

Result<GltfAccessor::Block> GltfAccessor::block(const tinygltf::Model& model, int view, std::int64_t offset,
                                                std::uint64_t count, std::uint64_t elementBytes, bool strided) {
    if (view < 0 || static_cast<std::size_t>(view) >= model.bufferViews.size()) {
        return Error{"names buffer view " + std::to_string(view) + " of " + std::to_string(model.bufferViews.size())};
    }
    const tinygltf::BufferView& window = model.bufferViews[static_cast<std::size_t>(view)];
    if (window.extensions.count("EXT_meshopt_compression") != 0 ||
        window.extensions.count("KHR_meshopt_compression") != 0) {
        return Error{"is compressed with EXT_meshopt_compression, which is not read"};
    }
    if (window.buffer < 0 || static_cast<std::size_t>(window.buffer) >= model.buffers.size()) {
        return Error{"names buffer " + std::to_string(window.buffer) + " of " + std::to_string(model.buffers.size())};
    }
    const auto& bytes = model.buffers[static_cast<std::size_t>(window.buffer)].data;
    const std::uint64_t present = bytes.size();
    const std::uint64_t viewOffset = window.byteOffset;
    const std::uint64_t viewLength = window.byteLength;
    if (viewOffset > present || viewLength > present - viewOffset) {
        return Error{"lies in a buffer view that ends past its buffer of " + std::to_string(present) + " bytes"};
    }
    if (offset < 0 || static_cast<std::uint64_t>(offset) > viewLength) return Error{"starts outside its buffer view"};
    const std::uint64_t room = viewLength - static_cast<std::uint64_t>(offset);
    const std::uint64_t stride = strided && window.byteStride != 0 ? window.byteStride : elementBytes;
    if (stride < elementBytes || stride > 65536) return Error{"has a stride that is no good"};
    // (count - 1) * stride + elementBytes <= room, without overflow
    if (count > 0 && (room < elementBytes || count - 1 > (room - elementBytes) / stride)) {
        return Error{"claims " + std::to_string(count) + " elements, more than the bytes that are there"};
    }
    return Block{bytes.data() + viewOffset + static_cast<std::uint64_t>(offset), stride};
}

Result<GltfAccessor> GltfAccessor::open(const tinygltf::Model& model, int number, int components) {
    const std::string label = "accessor " + std::to_string(number) + " ";
    if (number < 0 || static_cast<std::size_t>(number) >= model.accessors.size()) {
        return Error{label + "is not there"};
    }
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(number)];
    GltfAccessor out;
    out.m_count = accessor.count;
    out.m_type = accessor.componentType;
    out.m_components = components;
    out.m_normalised = accessor.normalized;
    const std::uint64_t size = componentBytes(accessor.componentType);
    const std::int32_t present = accessor.type == TINYGLTF_TYPE_SCALAR ? 1
                                 : accessor.type == TINYGLTF_TYPE_VEC2 ? 2
                                 : accessor.type == TINYGLTF_TYPE_VEC3 ? 3
                                 : accessor.type == TINYGLTF_TYPE_VEC4 ? 4
                                                                       : 0;
    if (size == 0) return Error{label + "has an unknown component type"};
    if (present != components) return Error{label + "has elements of the wrong kind"};
    if (out.m_count > 400'000'000) return Error{label + "claims " + std::to_string(out.m_count) + " elements"};
    const std::uint64_t elementBytes = size * static_cast<std::uint64_t>(components);
    if (accessor.bufferView >= 0) {
        if (accessor.byteOffset > (1ull << 40)) return Error{label + "starts outside its buffer view"};
        auto block = GltfAccessor::block(model, accessor.bufferView, static_cast<std::int64_t>(accessor.byteOffset),
                                         out.m_count, elementBytes, true);
        if (!block) return Error{label + block.error().message};
        out.m_block = *block;
    } else if (!accessor.sparse.isSparse) {
        return Error{label + "has no data"};
    }
    if (accessor.sparse.isSparse) {
        if (auto sparse = out.openSparse(model, accessor); !sparse) return Error{label + sparse.error().message};
    }
    return out;
}

Result<void> GltfAccessor::openSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor) {
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<std::uint64_t>(std::max(sparse.count, 0));
    const std::uint64_t indexBytes = componentBytes(sparse.indices.componentType);
    const bool unsignedIndices = sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                 sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                                 sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (sparse.count < 0 || count > m_count || !unsignedIndices) return Error{"has sparse values that do not fit it"};
    const auto indices = block(model, sparse.indices.bufferView, sparse.indices.byteOffset, count, indexBytes, false);
    if (!indices) return Error{"has sparse indices and " + indices.error().message};
    const auto values = block(model, sparse.values.bufferView, sparse.values.byteOffset, count,
                              componentBytes(m_type) * static_cast<std::uint64_t>(m_components), false);
    if (!values) return Error{"has sparse values and " + values.error().message};
    m_sparse.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const double index = decode(indices->data + i * indices->stride, sparse.indices.componentType, false);
        if (index >= static_cast<double>(m_count) || (i > 0 && index <= static_cast<double>(m_sparse.back()))) {
            return Error{"has sparse indices out of order or range"};
        }
        m_sparse.push_back(static_cast<std::uint32_t>(index));
    }
    m_sparseValues = *values;
    return {};
}

const std::uint8_t* GltfAccessor::at(std::uint64_t element) const {
    if (!m_sparse.empty()) {
        const auto found = std::lower_bound(m_sparse.begin(), m_sparse.end(), element);
        if (found != m_sparse.end() && *found == element) {
            return m_sparseValues.data + static_cast<std::uint64_t>(found - m_sparse.begin()) * m_sparseValues.stride;
        }
    }
    return m_block.data == nullptr ? nullptr : m_block.data + element * m_block.stride;
}

double GltfAccessor::value(std::uint64_t element, int component) const {
    const std::uint8_t* bytes = at(element);
    if (bytes == nullptr) return 0.0;  // sparse over nothing: zeros
    return decode(bytes + componentBytes(m_type) * static_cast<std::uint64_t>(component), m_type, m_normalised);
}

}  // namespace whorl::import
