// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command_list.h"
#include "core/io/bake_files.h"

namespace whorl {
namespace {

using Arguments = std::span<const std::string>;

constexpr const char* usage =
    "bake-lic FILE [colour] [opacity] [flow] [height] [size TEXELS] [margin TEXELS] [bits 8|16|32]";

Result<std::string> bake(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.empty()) return usageError(usage);
    if (!context.hasGroom) return noGroomError();
    BakeRequest request;
    request.file = arguments[0];
    std::vector<std::string> names;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        if (arguments[i] == "bits") {
            const auto bits = i + 1 < arguments.size() ? numberFrom<int>(arguments[++i], 8, 32) : std::optional<int>();
            if (!bits) return Error{"A channel has 8 or 16 bits in PNG, and 16 (half floats) or 32 in EXR."};
            request.bits = *bits;
            continue;
        }
        const bool size = arguments[i] == "size";
        if (!size && arguments[i] != "margin") {
            names.push_back(arguments[i]);
            continue;
        }
        const int most = size ? BakeOptions::maxSize : BakeOptions::maxMargin;
        const auto value =
            i + 1 < arguments.size() ? numberFrom<int>(arguments[++i], size ? 1 : 0, most) : std::optional<int>();
        if (!value)
            return Error{std::string("The ") + (size ? "size" : "margin") + " must be from " + (size ? "1" : "0") +
                         " to " + std::to_string(most) + " texels."};
        (size ? request.options.size : request.options.margin) = *value;
    }
    auto maps = bakeMapsNamed(names);
    if (!maps) return maps.error();
    request.maps = std::move(*maps);
    const auto files = bakeToFiles(context.groom, context.surfaces.get(context.groom.mesh), request, progress);
    if (!files) return files.error();
    return std::string();
}

}  // namespace

void addBakeCommands(std::vector<Command>& list) {
    list.push_back({"bake-lic", usage,
                    "Bakes hair texture in the mesh's UVs: colour with opacity in alpha, or the maps named, one file "
                    "each (FILE_colour.png). PNG has 8 or 16 bits a channel, EXR 16 (half floats) or 32.",
                    false, bake});
}

}  // namespace whorl
