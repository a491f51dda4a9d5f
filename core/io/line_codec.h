// SPDX-License-Identifier: Apache-2.0
// Partings and strokes as pieces of a container. Include in codec sources only.
#pragma once

#include "core/base/result.h"
#include "core/io/codec_pieces.h"
#include "core/io/groom_codec.h"
#include "core/model/groom.h"

#include <nlohmann/json.hpp>

namespace whorl {

nlohmann::json encodePartings(const std::vector<Parting>& partings, ContainerWriter& writer);
nlohmann::json encodeStrokes(const std::vector<FieldStroke>& strokes, ContainerWriter& writer);

/// Partings and strokes on their way back: `read` asks for their pieces, `finish` makes lines of what was inflated
/// and repairs them (groom_repair.h).
class LineDecoder {
public:
    void readPartings(const nlohmann::json& object, Wanted& wanted, Problems& problems);
    void readStrokes(const nlohmann::json& object, Wanted& wanted, Problems& problems);
    Result<void> finish(Groom& groom, Problems& problems) const;

private:
    struct Lines {
        std::vector<std::uint32_t> ids;
        std::vector<std::uint32_t> sizes;  // points of each line
        std::vector<SurfacePoint> points;
    };
    Lines m_partings;
    std::vector<std::uint8_t> m_names;  // of partings: 32-bit length and bytes each
    Lines m_strokes;
    std::vector<std::uint8_t> m_kinds;
    std::vector<float> m_numbers;  // weight and radius of each stroke
};

}  // namespace whorl
