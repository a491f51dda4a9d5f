// SPDX-License-Identifier: Apache-2.0
#include "editor/app/paint_map.h"

#include "core/commands/command.h"
#include "editor/app/document.h"
#include "editor/app/editor_state.h"

#include <QObject>
#include <algorithm>

namespace whorl {
namespace {

constexpr int mapSize = 1024;

std::size_t activeGroup(const Groom& groom, const EditorState& state) {
    return std::min(static_cast<std::size_t>(std::max(state.group(), 0)), groom.groups->size() - 1);
}

bool paintable(const Groom& groom, const std::string& name) {
    const Map* map = groom.maps.find(name);
    return !name.empty() && map && map->channels() == 1;
}

void choose(EditorState& state, const std::string& map) {
    BrushOptions options = state.brushOptions();
    options.map.name = map;
    state.setBrushOptions(options);
}

}  // namespace

std::string paintDensityMap(Document& document, EditorState& state) {
    Groom after = document.committed();
    // Black where nothing grows yet; with guides there, hair is to be taken away rather than added.
    const float fill = after.guides.empty() ? 0.0f : 1.0f;
    const std::string map = ensureDensityMap(after, activeGroup(after, state), mapSize, fill);
    if (!after.sameAs(document.committed())) document.edit(std::move(after), QObject::tr("New density map"));
    choose(state, map);
    return map;
}

std::string paintGroupMap(Document& document) {
    Groom after = document.committed();
    const std::string map = ensureGroupMap(after, mapSize);
    if (!after.sameAs(document.committed())) document.edit(std::move(after), QObject::tr("New group map"));
    return map;
}

void choosePaintMap(Document& document, EditorState& state, const BrushInfo& brush, bool make) {
    if (!document.hasGroom() || !brush.paintsMap) return;
    if (brush.paintsGroups) {
        if (make) paintGroupMap(document);
        return;
    }
    const Groom& groom = document.groom();
    if (paintable(groom, state.brushOptions().map.name)) return;
    const std::string& density = (*groom.groups)[activeGroup(groom, state)].params.general.density.map;
    if (paintable(groom, density)) {
        choose(state, density);
    } else if (make) {
        paintDensityMap(document, state);
    } else {
        choose(state, {});
    }
}

}  // namespace whorl
