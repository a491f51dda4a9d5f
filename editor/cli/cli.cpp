// SPDX-License-Identifier: Apache-2.0
#include "editor/cli/cli.h"

#include "core/commands/command.h"
#include "core/io/image.h"
#include "core/io/open.h"

#include <unistd.h>

#include <charconv>
#include <cstdio>

namespace whorl::cli {
namespace {

bool errorsGoToTerminal() {
    static const bool terminal = isatty(STDERR_FILENO) == 1;
    return terminal;
}

}  // namespace

Progress& progress() {
    static Progress shared([](float fraction, std::string_view what) {
        if (!errorsGoToTerminal()) return;
        std::fprintf(stderr, "\r%3d %%  %.*s\033[K", static_cast<int>(fraction * 100.0f), static_cast<int>(what.size()),
                     what.data());
    });
    return shared;
}

void endProgress() {
    if (errorsGoToTerminal()) std::fputs("\r\033[K", stderr);
}

void note(const std::string& text) {
    endProgress();
    std::fprintf(stderr, "note: %s\n", text.c_str());
}

bool print(const std::string& text) {
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
}

Outcome printed(const std::string& text) {
    if (!print(text)) return badInput({"Standard output can not be written; is the disk full?"});
    return done();
}

Result<Groom> open(const std::filesystem::path& file) {
    auto opened = openGroom(file, progress());
    if (!opened) return opened.error();
    for (const std::string& problem : opened->problems) note(problem);
    return std::move(opened->groom);
}

Result<Groom> openWithGuides(const std::filesystem::path& file) {
    auto groom = open(file);
    if (!groom || fileKind(file) != FileKind::Mesh || !groom->guides.empty()) return groom;
    const Surface surface(groom->mesh);
    const auto count = static_cast<std::size_t>(groom->counts->guides);
    if (auto placed = placeGuides(*groom, surface, count, 0.0f, false, progress()); !placed) return placed.error();
    note(file.string() + ": a mesh has no guides; placed " + std::to_string(groom->guides.count()) + ".");
    return groom;
}

Result<void> addDensity(Groom& groom, const std::filesystem::path& image) {
    if (image.empty()) return {};
    std::vector<std::string> repairs;
    auto map = readImage(image, ImageUse::Data, &repairs);
    if (!map) return map.error();
    for (const std::string& repair : repairs) note(repair);
    groom.maps.set("density", std::move(*map));
    for (Group& group : groom.groups.edit()) group.params.general.density.map = "density";
    groom.countAnew();
    return {};
}

CLI::Option* addLod(CLI::App& program, float& share) {
    return program
        .add_option("--lod", share, "Level of detail: this share of the hairs, a subset of all, and as much wider")
        ->check(CLI::Range(0.001, 1.0));
}

std::optional<std::uint64_t> wholeNumber(std::string_view text, std::uint64_t low, std::uint64_t high) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < low || number > high) return std::nullopt;
    return number;
}

}  // namespace whorl::cli
