// SPDX-License-Identifier: Apache-2.0
// One step of a group's list of modifiers.
#pragma once

#include "core/model/modifiers/bend.h"
#include "core/model/modifiers/clump.h"
#include "core/model/modifiers/curl.h"
#include "core/model/modifiers/length.h"
#include "core/model/modifiers/noise.h"
#include "core/model/modifiers/smooth.h"
#include "core/model/modifiers/taper.h"

#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace whorl {

/// All kinds of modifiers, in the order of menus. The one list: JSON, paths, commands and forms follow from it, and
/// core/hair/modifiers/modifiers.cpp names what each does.
using ModifierParams = std::variant<ClumpParams, CurlParams, NoiseParams, BendParams, LengthParams, SmoothParams,
                                    StraightenParams, TaperParams>;
inline constexpr std::size_t modifierKindCount = std::variant_size_v<ModifierParams>;

/// A modifier works on hairs after interpolation, scale, frizz and kink, in the order of its group's list.
struct Modifier {
    static constexpr std::size_t most = 32;  ///< of a group

    std::string name;  ///< unique in its group; letters, digits, '_' and '-'
    bool on = true;
    Driven amount{1.0f};  ///< 0 changes nothing
    ModifierParams params{};

    std::size_t kind() const { return params.index(); }
    /// All parameters, those that every modifier has first.
    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "on", .label = "On", .tip = "Off leaves hair as it is."}, self.on);
        visit(ParamInfo{.id = "amount", .label = "Amount", .tip = "How much of what it does. A map says where."},
              self.amount);
        std::visit([&](auto& block) { std::remove_cvref_t<decltype(block)>::each(block, visit); }, self.params);
    }
    bool operator==(const Modifier&) const = default;
};

/// Ids, labels and tips of all kinds, by kind.
std::vector<BlockInfo> modifierKinds();
/// The kind of that id ("clump").
std::optional<std::size_t> modifierKind(std::string_view id);
/// Default parameters of a kind below modifierKindCount.
ModifierParams defaultModifierParams(std::size_t kind);
/// True for a name of letters, digits, '_' and '-'.
bool isModifierName(std::string_view name);
/// `wanted`, with a number at the end when one of the list has that name, and other characters replaced. Never empty.
std::string freeModifierName(const std::vector<Modifier>& list, std::string_view wanted);

}  // namespace whorl
