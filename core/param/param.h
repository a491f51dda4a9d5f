// SPDX-License-Identifier: Apache-2.0
// A parameter, declared once: everything that reads or writes parameters goes through these references.
#pragma once

#include "core/base/result.h"

#include <glm/vec3.hpp>

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

// A block of parameters is a plain struct with member defaults and one `each`:
//
//     struct FrizzParams {
//         Driven tip{0.0f};
//         template <class Self, class Visit>
//         static void each(Self& self, Visit&& visit) {
//             visit(ParamInfo{.id = "tip", .label = "Tip amount", .max = 0.05, .unit = "mm", .shownScale = 1000,
//                             .tip = "How far the noise moves the tip."}, self.tip);
//         }
//     };
//
// JSON, paths for scripts and undo texts, the parameter reference, the editor's forms and equality read that list.
// Ids are for ever.

namespace whorl {

/// A number that a map may modulate: the value used at a root is `value` times the map's texel there. An empty name
/// means no map (white).
struct Driven {
    float value = 0.0f;
    std::string map{};
    bool operator==(const Driven&) const = default;
};

/// A vector (frequencies along x, y, z) times an optional map.
struct DrivenVector {
    glm::vec3 value{0.0f};
    std::string map{};
    bool operator==(const DrivenVector&) const = default;
};

/// A linear RGB colour times an optional colour map.
struct DrivenColour {
    glm::vec3 value{0.0f};
    std::string map{};
    bool operator==(const DrivenColour&) const = default;
};

/// A linear RGB colour without a map.
struct Colour {
    glm::vec3 value{0.0f};
    bool operator==(const Colour&) const = default;
};

/// A direction or another vector without a map.
struct Vector {
    glm::vec3 value{0.0f};
    bool operator==(const Vector&) const = default;
};

/// The name of a map of the groom, or empty.
struct MapName {
    std::string name{};
    bool operator==(const MapName&) const = default;
};

/// One of the texts in ParamInfo::choices, by its place in that list.
struct Choice {
    int index = 0;
    bool operator==(const Choice&) const = default;
};

/// What a stranger needs to know of one parameter. All texts are literals.
struct ParamInfo {
    std::string_view id{};                        ///< in JSON and paths; for ever
    std::string_view label{};                     ///< in the editor
    double min = 0.0;                             ///< smallest value accepted
    double max = 1.0;                             ///< largest value accepted
    double softMax = 0.0;                         ///< where the slider ends, if below `max` (0: at `max`)
    std::string_view unit{};                      ///< as shown: "mm", "degrees", "%"; empty for plain numbers
    double shownScale = 1.0;                      ///< shown number = stored number * shownScale
    std::string_view tip{};                       ///< one or two sentences for the artist
    std::span<const std::string_view> choices{};  ///< for Choice
    bool logarithmic = false;                     ///< the slider moves by ratio
    bool kept = false;                            ///< Whorl sets it on its own; forms leave it out
};

/// The same for a block.
struct BlockInfo {
    std::string_view id{};
    std::string_view label{};
    std::string_view tip{};
};

/// A parameter of a living block: its declaration and where its value is. Good while the block lives in its place.
struct ParamRef {
    using Target =
        std::variant<bool*, int*, float*, Driven*, DrivenVector*, DrivenColour*, Colour*, Vector*, MapName*, Choice*>;
    ParamInfo info;
    Target target;
};

/// True for a value that a map multiplies; a bare MapName is none.
bool isDriven(const ParamRef& param);

/// Multiplies lengths ("mm") by `factor` and divides frequencies ("per metre") by it, within their ranges: defaults are
/// for a head of 0.35 m.
void scaleLengths(std::span<const ParamRef> params, float factor);

/// A value on its way in or out: from a script, a file, a form or to an undo text.
using ParamValue = std::variant<bool, double, glm::vec3, std::string>;

/// All parameters of a block, in declared order.
template <class Block>
std::vector<ParamRef> paramsOf(Block& block) {
    std::vector<ParamRef> refs;
    Block::each(block, [&](const ParamInfo& info, auto& member) { refs.push_back({info, &member}); });
    return refs;
}

/// The parameter's own value (for Driven types: without the map; for Choice: its text).
ParamValue paramValue(const ParamRef& param);

/// Sets it. A number out of range, a wrong type or an unknown choice is refused with a sentence that names the range.
/// A number is taken for bool (0 or 1) and three equal components; text is parsed ("0.5", "0.1 0.2 0.3", "#c08040",
/// "on", "off").
Result<void> setParamValue(const ParamRef& param, const ParamValue& value);

/// The map's name for Driven types and MapName; null for others.
std::string* paramMap(const ParamRef& param);

/// "0.5", "0.1 0.2 0.3", "on", "Grid": what setParamValue takes as text, shortest form that reads back equal.
std::string paramText(const ParamValue& value);

}  // namespace whorl
