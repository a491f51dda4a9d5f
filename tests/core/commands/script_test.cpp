// SPDX-License-Identifier: Apache-2.0
// Lines into words, words into commands, errors with their line.
#include "core/commands/command.h"

#include <QTest>

using namespace whorl;

class ScriptTest : public QObject {
    Q_OBJECT

    static std::vector<Command> commands(std::vector<std::string>& log) {
        Command say{"say", "say WORD...", "Prints words.", false,
                    [&log](CommandContext&, std::span<const std::string> words, Progress&) -> Result<std::string> {
                        std::string text;
                        for (const std::string& word : words) text += "<" + word + ">";
                        log.push_back(text);
                        return text;
                    }};
        Command fail{"fail", "fail", "Fails.", false, [](CommandContext&, std::span<const std::string>, Progress&) {
                         return Result<std::string>(Error{"It does not work."});
                     }};
        return {say, fail};
    }

private Q_SLOTS:
    void wordsOfALine() {
        using Words = std::vector<std::string>;
        QVERIFY(splitCommandLine("").value() == Words{});
        QVERIFY(splitCommandLine("  # only a comment").value() == Words{});
        QVERIFY(splitCommandLine("a  b\tc\r").value() == (Words{"a", "b", "c"}));
        QVERIFY(splitCommandLine("open \"a file.obj\" # why").value() == (Words{"open", "a file.obj"}));
        QVERIFY(splitCommandLine("a#b \"\" \"#\"").value() == (Words{"a#b", "", "#"}));
        QVERIFY(splitCommandLine("\"say \\\"hi\\\" \\\\ x\"y").value() == Words{"say \"hi\" \\ xy"});
        QVERIFY(!splitCommandLine("open \"a").ok());
    }

    void aScriptRunsLineByLine() {
        std::vector<std::string> log;
        CommandContext context;
        Progress progress;
        const auto output = runScript(commands(log), context, "say a\n\n# no\n  say \"b c\"\r\nsay", "s.txt", progress);
        QVERIFY(output.ok());
        QCOMPARE(*output, std::string("<a>\n<b c>\n"));
        QCOMPARE(log.size(), std::size_t{3});
    }

    void errorsNameFileAndLineAndStop() {
        std::vector<std::string> log;
        CommandContext context;
        Progress progress;
        const auto failed = runScript(commands(log), context, "say a\nfail\nsay b", "s.txt", progress);
        QVERIFY(!failed.ok());
        QCOMPARE(failed.error().message, std::string("s.txt:2: It does not work."));
        QCOMPARE(log.size(), std::size_t{1});
        const auto unknown = runScript(commands(log), context, "\nnonsense", "s.txt", progress);
        QVERIFY(!unknown.ok() && unknown.error().message.starts_with("s.txt:2: ") &&
                unknown.error().message.find("nonsense") != std::string::npos);
        QVERIFY(!runScript(commands(log), context, "say \"", "s.txt", progress).ok());
    }

    void aCancelledScriptSaysSo() {
        std::vector<std::string> log;
        CommandContext context;
        Progress progress;
        progress.cancel();
        const auto cancelled = runScript(commands(log), context, "say a", "s.txt", progress);
        QVERIFY(!cancelled.ok() && cancelled.error().cancelled);
        QVERIFY(log.empty());
    }
};

QTEST_APPLESS_MAIN(ScriptTest)
#include "script_test.moc"
