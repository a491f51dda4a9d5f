// SPDX-License-Identifier: Apache-2.0
// Checked reading of glTF accessors. Private to the importers.
#pragma once

#include "core/base/result.h"

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

namespace whorl::import {

/// Values of one accessor. Everything was checked when it was opened; after that every element below `count` can be
/// read. The model must live as long.
class GltfAccessor {
public:
    /// Errors are half sentences that name the accessor. `components`: how many numbers an element must have.
    static Result<GltfAccessor> open(const tinygltf::Model& model, int number, int components);

    std::uint64_t count() const { return m_count; }
    std::uint64_t sparseCount() const { return m_sparse.size(); }
    int componentType() const { return m_type; }
    bool normalised() const { return m_normalised; }

    /// Number `component` of `element`; integers divided by their largest value when the accessor is normalised.
    double value(std::uint64_t element, int component) const;
    /// For indices.
    std::uint32_t index(std::uint64_t element) const { return static_cast<std::uint32_t>(value(element, 0)); }

private:
    struct Block {
        const std::uint8_t* data = nullptr;
        std::uint64_t stride = 0;
    };
    static Result<Block> block(const tinygltf::Model& model, int view, std::int64_t offset, std::uint64_t count,
                               std::uint64_t elementBytes, bool strided);
    Result<void> openSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor);
    const std::uint8_t* at(std::uint64_t element) const;

    Block m_block;
    std::uint64_t m_count = 0;
    int m_type = 0;
    int m_components = 1;
    bool m_normalised = false;
    std::vector<std::uint32_t> m_sparse;  ///< replaced elements, ascending
    Block m_sparseValues;
};

}  // namespace whorl::import
