// SPDX-License-Identifier: Apache-2.0
// Adding, ordering, renaming and removing the modifiers of a group, and presets of whole lists.
#pragma once

#include "core/base/result.h"
#include "core/model/groom.h"

#include <string>
#include <string_view>
#include <vector>

namespace whorl {

/// Adds a modifier of kind `kind` at place `place` of the list of group `group` (the end for a negative place), with
/// lengths that fit the mesh, and gives its place. `name`: empty for one that follows from the kind. Fails for an
/// unknown kind (the sentence names all), a bad or taken name, and when there are Modifier::most already.
Result<int> addModifier(Groom& groom, int group, std::string_view kind, std::string_view name = {}, int place = -1);
Result<void> removeModifier(Groom& groom, int group, std::string_view name);
/// Moves it to place `to` (0 is first; beyond the end: last); the others close up.
Result<void> moveModifier(Groom& groom, int group, std::string_view name, int to);
Result<void> renameModifier(Groom& groom, int group, std::string_view name, std::string_view to);

/// A preset: a list of modifiers and values of blocks, for a head of 0.35 m.
struct Preset {
    std::string id;     ///< "ringlets"
    std::string label;  ///< "Ringlets"
    std::string tip;    ///< one sentence
    std::string text;   ///< its JSON
};

/// The presets of the program, from resources/presets, by label.
const std::vector<Preset>& presets();

/// Replaces the modifiers of the group by those of the preset and sets the values that it names, with lengths that fit
/// the mesh; guides, colours and counts that it does not name stay. `text` is the JSON of a preset (see Preset), `name`
/// stands in front of errors. Unknown keys are errors here: nothing is changed then.
Result<void> applyPreset(Groom& groom, int group, std::string_view text, const std::string& name);

}  // namespace whorl
