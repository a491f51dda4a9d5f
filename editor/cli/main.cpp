// SPDX-License-Identifier: Apache-2.0
// whorl-cli: everything that the editor does with files, without a window.
#include "editor/cli/cli.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <csignal>
#include <cstdio>
#include <exception>

namespace whorl::cli {
namespace {

Outcome outcome;
Progress* running = nullptr;

extern "C" void cancelRunning(int) {
    running->cancel();
}

/// One sentence on one line, whatever the names in it contain.
void complain(const std::string& message) {
    std::string line = message;
    for (char& c : line) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    std::fprintf(stderr, "whorl-cli: %s\n", line.c_str());
}

int run(int argc, char** argv) {
    // A file size limit then is an error of write, and the old file stays.
    std::signal(SIGXFSZ, SIG_IGN);
    running = &progress();
    struct sigaction action {};
    action.sa_handler = cancelRunning;
    action.sa_flags = SA_RESETHAND;  // the second Ctrl+C ends the program at once
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);

    CLI::App app("Whorl without a window: grooms hair from meshes, documents and packages.", "whorl-cli");
    app.require_subcommand(1);
    app.set_version_flag("--version", "whorl-cli " WHORL_VERSION);
    app.failure_message([](const CLI::App*, const CLI::Error& error) { return std::string(error.what()); });
    addInfo(app);
    addNew(app);
    addSample(app);
    addGenerate(app);
    addHash(app);
    addExplain(app);
    addSingularities(app);
    addRender(app);
    addBakeLic(app);
    addExport(app);
    addRun(app);
    addBench(app);
    if (argc > 1 && argv[1][0] != '-') {
        std::string names;
        bool known = false;
        for (const CLI::App* program : app.get_subcommands([](CLI::App*) { return true; })) {
            names += (names.empty() ? "" : ", ") + program->get_name();
            known = known || program->get_name() == argv[1];
        }
        if (!known) {
            complain("There is no program \"" + std::string(argv[1]) + "\"; programs are " + names + ".");
            return static_cast<int>(Status::BadUsage);
        }
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        complain(std::string(error.what()) + "; see whorl-cli --help.");
        return static_cast<int>(Status::BadUsage);
    }
    endProgress();
    if (outcome.status != Status::Ok) complain(outcome.message);
    return static_cast<int>(outcome.status);
}

}  // namespace

CLI::App* addProgram(CLI::App& app, const std::string& name, const std::string& help, std::function<Outcome()> run) {
    CLI::App* program = app.add_subcommand(name, help);
    program->callback([run = std::move(run)] { outcome = run(); });
    return program;
}

}  // namespace whorl::cli

int main(int argc, char** argv) {
    try {
        return whorl::cli::run(argc, argv);
    } catch (const std::bad_alloc&) {
        std::fputs("whorl-cli: There is not enough memory for this; try a smaller file or fewer hairs.\n", stderr);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "whorl-cli: Something unexpected happened: %s.\n", error.what());
    }
    return 1;
}
