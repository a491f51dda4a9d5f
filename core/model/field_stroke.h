// SPDX-License-Identifier: Apache-2.0
// What the artist draws on the skin to say which way hair lies.
#pragma once

#include "core/model/surface_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace whorl {

/// How a stroke sets directions. The numbers are in documents, for ever.
enum class StrokeKind : std::uint8_t {
    Along = 0,    ///< hair lies along the line, from its first point to its last
    Attract = 1,  ///< hair points to the line, or to its one point
    Repel = 2,    ///< hair points away from it
    Whorl = 3,    ///< hair turns around its first point, anticlockwise seen from outside
    ClockwiseWhorl = 4,
};
inline constexpr std::array<std::string_view, 5> strokeKindNames{"along", "attract", "repel", "whorl",
                                                                 "clockwise-whorl"};
inline constexpr bool turns(StrokeKind kind) {
    return kind == StrokeKind::Whorl || kind == StrokeKind::ClockwiseWhorl;
}

/// A line on the skin that sets the direction of the hair around it (core/field). One point is enough for all kinds
/// but Along.
struct FieldStroke {
    static constexpr std::size_t maxPoints = 4096;
    static constexpr std::size_t maxStrokes = 10000;
    static constexpr float minWeight = 0.01f, maxWeight = 100.0f;
    static constexpr float maxRadius = 1000.0f;  ///< metres
    static float weightInRange(float weight) { return std::clamp(weight, minWeight, maxWeight); }

    std::uint32_t id = 0;  ///< unique in the groom, above zero
    StrokeKind kind = StrokeKind::Along;
    float weight = 1.0f;               ///< against other strokes and the default; minWeight to maxWeight
    float radius = 0.0f;               ///< metres around a line within which Attract, Repel and Whorl act; 0 for Along
    std::vector<SurfacePoint> points;  ///< 1 (Along: 2) to maxPoints; see tracedParting for how dense
    std::size_t fewestPoints() const { return kind == StrokeKind::Along ? 2 : 1; }
    bool operator==(const FieldStroke&) const = default;
};

/// The id that a new stroke gets: one more than the largest.
std::uint32_t nextStrokeId(std::span<const FieldStroke> strokes);

}  // namespace whorl
