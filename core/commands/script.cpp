// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command.h"

#include <algorithm>

namespace whorl {

Result<std::vector<std::string>> splitCommandLine(std::string_view line) {
    std::vector<std::string> words;
    std::string word;
    bool inWord = false, quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted) {
            if (c == '"') {
                quoted = false;
            } else if (c == '\\' && i + 1 < line.size() && (line[i + 1] == '"' || line[i + 1] == '\\')) {
                word += line[++i];
            } else {
                word += c;
            }
        } else if (c == '"') {
            inWord = quoted = true;
        } else if (c == ' ' || c == '\t' || c == '\r') {
            if (inWord) words.push_back(std::move(word));
            word.clear();
            inWord = false;
        } else if (c == '#' && !inWord) {
            break;
        } else {
            inWord = true;
            word += c;
        }
    }
    if (quoted) return Error{"A quoted text has no end; add the missing \"."};
    if (inWord) words.push_back(std::move(word));
    return words;
}

Result<std::string> runScript(std::span<const Command> commands, CommandContext& context, std::string_view script,
                              const std::string& name, Progress& progress) {
    std::string output;
    for (std::size_t number = 1; !script.empty(); ++number) {
        const std::size_t end = std::min(script.find('\n'), script.size());
        const std::string_view line = script.substr(0, end);
        script.remove_prefix(std::min(end + 1, script.size()));
        const auto failed = [&](const Error& error) {
            return Error{name + ":" + std::to_string(number) + ": " + error.message, error.cancelled};
        };
        const auto words = splitCommandLine(line);
        if (!words) return failed(words.error());
        if (words->empty()) continue;
        const auto command = std::ranges::find(commands, words->front(), &Command::name);
        if (command == commands.end()) {
            std::string names;
            for (const Command& known : commands) names += (names.empty() ? "" : ", ") + known.name;
            return failed({"There is no command \"" + words->front() + "\"; commands are " + names + "."});
        }
        if (progress.cancelled()) return cancelledError();
        auto text = command->run(context, std::span(*words).subspan(1), progress);
        if (!text) return failed(text.error());
        if (text->empty()) continue;
        output += *text;
        if (output.back() != '\n') output += '\n';
    }
    return output;
}

}  // namespace whorl
