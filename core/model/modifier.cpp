// SPDX-License-Identifier: Apache-2.0
#include "core/model/modifier.h"

#include <algorithm>
#include <utility>

namespace whorl {
namespace {

template <std::size_t... I>
std::vector<BlockInfo> infos(std::index_sequence<I...>) {
    return {std::variant_alternative_t<I, ModifierParams>::info...};
}

template <std::size_t... I>
ModifierParams made(std::size_t kind, std::index_sequence<I...>) {
    ModifierParams params;
    (void)((kind == I ? (params.emplace<I>(), true) : false) || ...);
    return params;
}

bool isNameCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

}  // namespace

std::vector<BlockInfo> modifierKinds() {
    return infos(std::make_index_sequence<modifierKindCount>());
}

std::optional<std::size_t> modifierKind(std::string_view id) {
    const std::vector<BlockInfo> kinds = modifierKinds();
    const auto found = std::ranges::find(kinds, id, &BlockInfo::id);
    if (found == kinds.end()) return std::nullopt;
    return static_cast<std::size_t>(found - kinds.begin());
}

ModifierParams defaultModifierParams(std::size_t kind) {
    return made(kind, std::make_index_sequence<modifierKindCount>());
}

bool isModifierName(std::string_view name) {
    return !name.empty() && std::ranges::all_of(name, isNameCharacter);
}

std::string freeModifierName(const std::vector<Modifier>& list, std::string_view wanted) {
    std::string base;
    for (const char c : wanted) base += isNameCharacter(c) ? c : '-';
    if (base.empty()) base = "modifier";
    std::string name = base;
    for (int i = 2; std::ranges::find(list, name, &Modifier::name) != list.end(); ++i) name = base + std::to_string(i);
    return name;
}

}  // namespace whorl
