// SPDX-License-Identifier: Apache-2.0
// whorl-image-worker: decodes or encodes one image within limits, so that a bad file ends this program and no other.
#include "core/io/worker/answer.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WHORL_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define WHORL_SANITIZED
#endif
#endif

namespace whorl::image_worker {
namespace {

bool limit(int resource, rlim_t value) {
    rlimit wanted{value, value};
    rlimit now{};
    if (getrlimit(resource, &now) == 0 && now.rlim_max != RLIM_INFINITY && now.rlim_max < value) {
        wanted.rlim_cur = wanted.rlim_max = now.rlim_max;
    }
    return setrlimit(resource, &wanted) == 0;
}

// Before the first byte of the file is looked at.
bool limitMyself() {
    namespace protocol = whorl::image_protocol;
    bool ok = limit(RLIMIT_CORE, 0) && limit(RLIMIT_CPU, protocol::maxSeconds);
#if !defined(WHORL_SANITIZED)
    // The sanitizers reserve terabytes of address space that they never use.
    ok = ok && limit(RLIMIT_AS, protocol::maxMemoryBytes);
#endif
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    std::signal(SIGPIPE, SIG_IGN);
    return ok;
}

}  // namespace

bool send(const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t sent = ::write(STDOUT_FILENO, from, bytes);
        if (sent <= 0) return false;
        from += sent;
        bytes -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool beginHeaderLimit() {
    int milliseconds = image_protocol::maxHeaderMilliseconds;
#if defined(WHORL_SANITIZED)
    milliseconds *= 4;
#endif
    itimerval once{};
    once.it_value = {milliseconds / 1000, milliseconds % 1000 * 1000};
    std::signal(SIGPROF, SIG_DFL);
    return setitimer(ITIMER_PROF, &once, nullptr) == 0;
}

void endHeaderLimit() {
    const itimerval never{};
    setitimer(ITIMER_PROF, &never, nullptr);
}

int fail(const std::string& text) {
    const std::string shown = text.substr(0, image_protocol::maxErrorBytes);
    image_protocol::Answer answer;
    answer.failed = 1;
    answer.bytes = shown.size();
    send(&answer, sizeof answer);
    send(shown.data(), shown.size());
    return 1;
}

}  // namespace whorl::image_worker

int main(int argc, char** argv) {
    using namespace whorl::image_worker;
    if (!limitMyself()) return fail("the limits for memory and time can not be set");
    try {
        const std::string job = argc == 4 ? argv[1] : "";
        if (job == "read") return readImage(argv[2], std::string(argv[3]) == "colour");
        if (job == "write") return writeImage(argv[2], argv[3]);
    } catch (const std::bad_alloc&) {
        return fail("it needs more than 2 GiB of memory");
    } catch (const std::exception& exception) {
        return fail(exception.what());
    }
    std::fputs("whorl-image-worker is started by whorl to read and write images; it is of no use alone.\n", stderr);
    return 2;
}
