// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command.h"
#include "core/io/safe_file.h"
#include "editor/cli/cli.h"
#include "editor/cli/picture_commands.h"

#include <nlohmann/json.hpp>

namespace whorl::cli {
namespace {

struct Options {
    std::string script;
    bool json = false;
};

std::vector<Command> allCommands() {
    std::vector<Command> commands = coreCommands();
    for (Command& command : pictureCommands()) commands.push_back(std::move(command));
    return commands;
}

Outcome runFile(const Options& options) {
    const auto bytes = readFile(options.script, 16u << 20);
    if (!bytes) return badInput(bytes.error());
    const std::string text(bytes->begin(), bytes->end());
    CommandContext context;
    const std::vector<Command> commands = allCommands();
    const auto output = runScript(commands, context, text, options.script, progress());
    if (!options.json) {
        for (const std::string& problem : context.problems) note(problem);
    }
    if (!output) return badInput(output.error());
    endProgress();
    if (!options.json) return printed(*output);
    nlohmann::ordered_json json{{"output", nlohmann::ordered_json::array()}, {"problems", context.problems}};
    for (std::size_t at = 0; at < output->size();) {
        const std::size_t end = output->find('\n', at);
        json["output"].push_back(output->substr(at, end - at));
        at = end + 1;
    }
    return printed(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::string commandHelp() {
    std::string text = "Commands, one a line; # starts a comment, \"quotes\" keep blanks:\n";
    for (const Command& command : allCommands()) text += "  " + command.usage + "\n      " + command.help + "\n";
    return text;
}

}  // namespace

void addRun(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program =
        addProgram(app, "run", "Runs a script of named commands", [options] { return runFile(*options); });
    program->add_option("SCRIPT", options->script, "Text file, a command a line")->required();
    program->add_flag("--json", options->json, "Prints output and problems as a JSON object");
    program->footer(commandHelp());
}

}  // namespace whorl::cli
