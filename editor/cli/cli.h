// SPDX-License-Identifier: Apache-2.0
// whorl-cli: what its programs share.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/io/document.h"
#include "core/model/groom.h"

#include <CLI/App.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace whorl::cli {

/// What a program gives back: nothing on success, or an error and the exit status that goes with it.
enum class Status { Ok = 0, BadInput = 1, BadUsage = 2 };
struct Outcome {
    Status status = Status::Ok;
    std::string message{};
};
inline Outcome done() {
    return {};
}
inline Outcome badInput(const Error& error) {
    return {Status::BadInput, error.message};
}
inline Outcome badUsage(std::string message) {
    return {Status::BadUsage, std::move(message)};
}

/// Adds a program NAME to the application; `run` is called when it is the one that was asked for.
CLI::App* addProgram(CLI::App& app, const std::string& name, const std::string& help, std::function<Outcome()> run);

// One a source file, in the order of the help.
void addInfo(CLI::App& app);
void addNew(CLI::App& app);
void addSample(CLI::App& app);
void addGenerate(CLI::App& app);
void addHash(CLI::App& app);
void addExplain(CLI::App& app);
void addSingularities(CLI::App& app);
void addRender(CLI::App& app);
void addBakeLic(CLI::App& app);
void addExport(CLI::App& app);
void addRun(CLI::App& app);
void addBench(CLI::App& app);

/// The progress of the one program that runs: written to standard error when that is a terminal, cancelled by Ctrl+C.
Progress& progress();
/// Removes the progress line.
void endProgress();

/// Opens any file that can start a groom; says what was repaired on standard error, one line each.
Result<Groom> open(const std::filesystem::path& file);
/// The same for programs that need hair: a mesh gets evenly placed guides.
Result<Groom> openWithGuides(const std::filesystem::path& file);
/// Makes an image the density map "density" of all groups; does nothing for an empty name.
Result<void> addDensity(Groom& groom, const std::filesystem::path& image);
/// Lines on standard error that do not stop the program.
void note(const std::string& text);
/// Text on standard output; false when it can not be written (a full disk behind a redirection).
bool print(const std::string& text);
Outcome printed(const std::string& text);

/// --lod of programs that make hair: see GenerateOptions::lod.
CLI::Option* addLod(CLI::App& program, float& share);

/// "12,3" and the like: whole text, in range, without looking at the locale.
std::optional<std::uint64_t> wholeNumber(std::string_view text, std::uint64_t low, std::uint64_t high);

}  // namespace whorl::cli
