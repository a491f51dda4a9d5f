// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

namespace whorl::testing {

RunResult run(const std::string& program, const std::vector<std::string>& arguments, double timeoutSeconds) {
    const char* folder = std::getenv("WHORL_BIN");
    const std::string path = (folder ? std::string(folder) + "/" : std::string()) + program;
    std::vector<char*> argv{const_cast<char*>(path.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);

    RunResult result;
    int out[2], err[2];
    if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) return result;
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const pid_t child = fork();
    if (child == 0) {
        const int nothing = open("/dev/null", O_RDONLY);
        dup2(nothing, 0);
        dup2(out[1], 1);
        dup2(err[1], 2);
        execv(path.c_str(), argv.data());
        _exit(127);
    }
    close(out[1]);
    close(err[1]);
    pollfd ends[2] = {{out[0], POLLIN, 0}, {err[0], POLLIN, 0}};
    std::string* texts[2] = {&result.out, &result.err};
    bool killed = false;
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
        if (!killed && elapsed() > timeoutSeconds) {
            kill(child, SIGKILL);
            killed = true;
        }
        if (killed && elapsed() > timeoutSeconds + 5.0) break;
        poll(ends, 2, 100);
        for (int i = 0; i < 2; ++i) {
            if (ends[i].fd < 0 || ends[i].revents == 0) continue;
            char buffer[65536];
            const ssize_t got = read(ends[i].fd, buffer, sizeof buffer);
            if (got <= 0) {
                ends[i].fd = -1;
            } else if (texts[i]->size() < (16u << 20)) {
                texts[i]->append(buffer, static_cast<std::size_t>(got));
            }
        }
    }
    close(out[0]);
    close(err[0]);
    int state = 0;
    rusage usage{};
    wait4(child, &state, 0, &usage);
    result.seconds = elapsed();
    result.peakMegabytes = static_cast<double>(usage.ru_maxrss) / 1024.0;
    if (WIFEXITED(state)) result.status = WEXITSTATUS(state);
    if (WIFSIGNALED(state)) result.signal = WTERMSIG(state);
    return result;
}

}  // namespace whorl::testing
