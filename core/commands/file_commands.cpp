// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command_list.h"
#include "core/hair/generate.h"
#include "core/io/document.h"
#include "core/io/hair_file.h"
#include "core/io/image.h"
#include "core/io/open.h"
#include "core/io/package.h"

namespace whorl {
namespace {

using Arguments = std::span<const std::string>;

Result<std::string> openInto(CommandContext& context, const std::string& file, Progress& progress) {
    auto opened = openGroom(file, progress);
    if (!opened) return opened.error();
    context.groom = std::move(opened->groom);
    context.hasGroom = true;
    context.problems.insert(context.problems.end(), opened->problems.begin(), opened->problems.end());
    context.view = {};
    return std::string();
}

Result<std::string> open(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.size() != 1) return usageError("open FILE");
    auto done = openInto(context, arguments[0], progress);
    if (done) context.file = fileKind(arguments[0]) == FileKind::Document ? arguments[0] : std::string();
    return done;
}

Result<std::string> newGroom(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.size() != 1) return usageError("new MESH");
    if (fileKind(arguments[0]) == FileKind::Document || fileKind(arguments[0]) == FileKind::Package) {
        return Error{arguments[0] + ": a new groom begins with a mesh; use open for this file."};
    }
    auto done = openInto(context, arguments[0], progress);
    if (done) context.file.clear();
    return done;
}

Result<std::string> save(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.size() > 1) return usageError("save [FILE]");
    if (!context.hasGroom) return noGroomError();
    const std::filesystem::path file = arguments.empty() ? context.file : std::filesystem::path(arguments[0]);
    if (file.empty()) return Error{"This groom has no file yet; write save FILE."};
    if (auto saved = saveDocument(context.groom, file, progress); !saved) return saved.error();
    context.file = file;
    return std::string();
}

Result<std::string> loadMap(CommandContext& context, Arguments arguments, Progress&) {
    const bool colour = arguments.size() == 3 && arguments[2] == "colour";
    if (arguments.size() != (colour ? 3u : 2u)) return usageError("load-map NAME FILE [colour]");
    if (!context.hasGroom) return noGroomError();
    auto map = readImage(arguments[1], colour ? ImageUse::Colour : ImageUse::Data, &context.problems);
    if (!map) return map.error();
    context.groom.maps.set(arguments[0], std::move(*map));
    context.groom.countAnew();
    return std::string();
}

Result<std::string> saveMap(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 2) return usageError("save-map NAME FILE");
    if (!context.hasGroom) return noGroomError();
    const Map* map = context.groom.maps.find(arguments[0]);
    if (map == nullptr) return Error{"The groom has no map \"" + arguments[0] + "\"."};
    if (auto written = writeImage(*map, arguments[1]); !written) return written.error();
    return std::string();
}

Result<std::string> generate(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.empty() || arguments.size() > 2) return usageError("generate FILE [COUNT]");
    if (!context.hasGroom) return noGroomError();
    Groom groom = context.groom;
    if (arguments.size() == 2) {
        const auto hairs = numberFrom<std::uint32_t>(arguments[1], 0, 10000000);
        if (!hairs) return Error{"The number of hairs must be from 0 to 10000000, not \"" + arguments[1] + "\"."};
        groom.setHairs(*hairs);
    }
    const auto count = writeHair(groom, {}, arguments[0], progress, context.surfaces.get(groom.mesh));
    if (!count) return count.error();
    return std::to_string(*count) + " hairs";
}

Result<std::string> hash(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.size() > 1) return usageError("hash [PARTS]");
    if (!context.hasGroom) return noGroomError();
    std::uint32_t parts = 1;
    if (!arguments.empty()) {
        const auto number = numberFrom<std::uint32_t>(arguments[0], 1, 4096);
        if (!number) return Error{"The number of parts must be from 1 to 4096, not \"" + arguments[0] + "\"."};
        parts = *number;
    }
    const auto digest =
        hairDigest(context.groom, parts, std::nullopt, progress, context.surfaces.get(context.groom.mesh));
    if (!digest) return digest.error();
    return hexDigest(*digest);
}

Result<std::string> exportGroom(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.empty() || arguments.size() > 2) return usageError("export NAME.groom [PARTS]");
    if (!context.hasGroom) return noGroomError();
    std::uint32_t parts = 0;
    if (arguments.size() == 2) {
        const auto number = numberFrom<std::uint32_t>(arguments[1], 1, 4096);
        if (!number) return Error{"The number of parts must be from 1 to 4096, not \"" + arguments[1] + "\"."};
        parts = *number;
    }
    if (auto done =
            exportPackage(context.groom, arguments[0], parts, progress, context.surfaces.get(context.groom.mesh));
        !done)
        return done.error();
    return std::string();
}

}  // namespace

void addFileCommands(std::vector<Command>& list) {
    list.push_back({"open", "open FILE", "Opens a document, a package or a mesh.", true, open});
    list.push_back({"new", "new MESH", "Begins a groom on a mesh, without guides.", true, newGroom});
    list.push_back({"save", "save [FILE]", "Saves the document.", false, save});
    list.push_back({"load-map", "load-map NAME FILE [colour]", "Reads an image as a map of numbers or of colours.",
                    true, loadMap});
    list.push_back(
        {"save-map", "save-map NAME FILE", "Writes a map as an image; the format follows the suffix.", false, saveMap});
    list.push_back(
        {"generate", "generate FILE [COUNT]", "Writes the hair; the format follows the suffix.", false, generate});
    list.push_back({"hash", "hash [PARTS]", "Prints the digest of all hair.", false, hash});
    list.push_back(
        {"export", "export NAME.groom [PARTS]", "Exports the package that renderers load.", false, exportGroom});
}

}  // namespace whorl
