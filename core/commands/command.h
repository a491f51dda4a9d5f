// SPDX-License-Identifier: Apache-2.0
// Named commands on a groom: one list for scripts, tests, the command line and the editor's menus.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/brushes/brush.h"
#include "core/model/groom.h"
#include "core/surface/surface.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace whorl {

/// What a command works on.
struct CommandContext {
    Groom groom;
    bool hasGroom = false;
    std::filesystem::path file{};  ///< where the groom came from or was saved last
    SurfaceCache surfaces{};
    BrushSettings brush{};
    StrokeView view{};  ///< for strokes; the command "view" sets it
    Problems problems{};
};

struct Command {
    std::string name;   ///< "place-guides"
    std::string usage;  ///< "place-guides [COUNT]"
    std::string help;   ///< one sentence
    bool edits = true;  ///< changes the groom (one undo step in the editor)
    /// Gives a line to print, often empty.
    std::function<Result<std::string>(CommandContext&, std::span<const std::string> arguments, Progress&)> run;
};

/// core's commands: open, save, new, set, get, info, place-guides, clear-guides, fill-map, load-map, save-map,
/// stroke, brush, view, generate, hash, export, grow, parts, add-parting, remove-parting, clear-partings, those of
/// modifiers and presets. Programs add their own (render).
std::vector<Command> coreCommands();

/// Words of a line; "double quotes" keep blanks, # starts a comment.
Result<std::vector<std::string>> splitCommandLine(std::string_view line);

/// Runs a script, a command a line; stops at the first error, which then begins with file and line number.
Result<std::string> runScript(std::span<const Command> commands, CommandContext& context, std::string_view script,
                              const std::string& name, Progress& progress);

// The operations behind the commands, for callers with typed arguments.

/// Replaces (or, with `keep`, tops up) guides with `count` evenly spread ones that stand along the normal with `length`
/// metres (0: a tenth of the mesh's size).
Result<void> placeGuides(Groom& groom, const Surface& surface, std::size_t count, float length, bool keep,
                         Progress& progress);
/// One guide at a place; takes its shape from its nearest neighbours, or stands along the normal.
std::uint32_t addGuide(Groom& groom, const Surface& surface, const SurfacePoint& root, std::uint8_t group,
                       float length);
/// A data map of the groom that drives density and can be painted; made (filled with `fill`) when there is none yet.
/// Gives its name.
std::string ensureDensityMap(Groom& groom, std::size_t group, int size, float fill);
/// Name of the group map; made, `size` texels a side and all of the first group, when there is none to paint.
std::string ensureGroupMap(Groom& groom, int size);

}  // namespace whorl
