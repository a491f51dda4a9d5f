// SPDX-License-Identifier: Apache-2.0
// Maps as pieces of a container. Include in sources only.
#pragma once

#include "core/io/container.h"
#include "core/model/groom.h"

#include <nlohmann/json_fwd.hpp>

namespace whorl {

/// Tiles in their own format; the most frequent tile of one value is not stored but named as the map's fill.
nlohmann::json encodeMaps(const MapSet& maps, ContainerWriter& writer);

/// The way back in two steps, so that all pieces of a file inflate together.
class MapDecoder {
public:
    MapDecoder(Container& container, std::string& fault) : m_container(container), m_fault(fault) {}

    /// Checks and claims; adds what is to be inflated to `requests`.
    void read(const nlohmann::json& list, Problems& problems, std::vector<Container::Request>& requests);
    /// After inflating. Texels that are not finite become zero, with a sentence.
    Result<void> finish(MapSet& maps, Problems& problems);

private:
    struct Stored {
        std::string name;
        Map map;
        std::vector<std::uint32_t> places;  ///< a tile: 0 for the fill, or 1 + its place among the stored tiles
        std::vector<std::uint8_t> tiles;
    };
    Container& m_container;
    std::string& m_fault;
    std::vector<Stored> m_stored;
};

}  // namespace whorl
