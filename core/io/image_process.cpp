// SPDX-License-Identifier: Apache-2.0
#include "core/io/image_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

namespace whorl {
namespace {

constexpr const char* workerName = "whorl-image-worker";

Result<std::string> findWorker() {
    namespace fs = std::filesystem;
    if (const char* given = std::getenv("WHORL_IMAGE_WORKER"); given != nullptr && *given != '\0') {
        if (access(given, X_OK) == 0) return std::string(given);
        return Error{std::string("the program that WHORL_IMAGE_WORKER names can not be run: ") + given};
    }
    std::error_code ignored;
    const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    for (const char* place : {"", "../bin", "../libexec/whorl", "../lib/whorl"}) {
        const fs::path candidate = (here / place / workerName).lexically_normal();
        if (access(candidate.c_str(), X_OK) == 0) return candidate.string();
    }
    return Error{std::string("the program ") + workerName +
                 ", which reads and writes images, is missing beside this one; install Whorl again"};
}

// Only what a dynamic loader, a sanitizer or a temporary folder may need; nothing that configures image libraries.
std::vector<std::string> smallEnvironment() {
    std::vector<std::string> environment{"LC_ALL=C", "MALLOC_ARENA_MAX=1"};
    for (const char* name :
         {"LD_LIBRARY_PATH", "ASAN_OPTIONS", "LSAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS", "TMPDIR"}) {
        if (const char* value = std::getenv(name)) environment.push_back(std::string(name) + "=" + value);
    }
    return environment;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& text : texts) out.push_back(text.data());
    out.push_back(nullptr);
    return out;
}

bool writeAll(int descriptor, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
    return true;
}

}  // namespace

Descriptor::~Descriptor() {
    reset();
}

void Descriptor::reset() {
    if (m_number >= 0) ::close(m_number);
    m_number = -1;
}

Descriptor memoryFile(std::span<const std::uint8_t> head, std::span<const std::uint8_t> body) {
    Descriptor file(memfd_create("whorl-image", MFD_CLOEXEC));
    if (!file.open() || !writeAll(file.get(), head) || !writeAll(file.get(), body)) return {};
    if (lseek(file.get(), 0, SEEK_SET) != 0) return {};
    return file;
}

Result<ImageProcess> ImageProcess::start(const std::vector<std::string>& arguments, const Descriptor& input) {
    auto worker = findWorker();
    if (!worker) return worker.error();
    int ends[2] = {-1, -1};
    if (pipe2(ends, O_CLOEXEC) != 0) return Error{"no pipe could be made; close other programs and try again"};
    Descriptor readEnd(ends[0]);
    Descriptor writeEnd(ends[1]);

    std::vector<std::string> words{*worker};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<std::string> environment = smallEnvironment();

    // dup2 onto 0 and 1 could trample the other one, so both are first moved out of the way.
    Descriptor safeInput(fcntl(input.get(), F_DUPFD_CLOEXEC, 3));
    Descriptor safeOutput(fcntl(writeEnd.get(), F_DUPFD_CLOEXEC, 3));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, safeInput.get(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, safeOutput.get(), STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions, 3);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);

    pid_t process = -1;
    const int failure = posix_spawn(&process, worker->c_str(), &actions, &attributes, pointers(words).data(),
                                    pointers(environment).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        return Error{std::string("the program ") + workerName + " could not be started (" +
                     std::generic_category().message(failure) + ")"};
    }
    ImageProcess started;
    started.m_output = std::move(readEnd);
    started.m_process = process;
    started.m_deadline = std::chrono::steady_clock::now() + std::chrono::seconds(image_protocol::maxSeconds);
    return started;
}

ImageProcess::ImageProcess(ImageProcess&& other) noexcept
    : m_output(std::move(other.m_output)),
      m_process(std::exchange(other.m_process, -1)),
      m_deadline(other.m_deadline) {}

ImageProcess::~ImageProcess() {
    end();
}

void ImageProcess::end() {
    if (m_process < 0) return;
    ::kill(m_process, SIGKILL);
    int status = 0;
    while (waitpid(m_process, &status, 0) < 0 && errno == EINTR) {
    }
    m_process = -1;
}

Error ImageProcess::whyItDied() {
    // It closed its end, so it ends within moments; a worker that a file has taken over may not.
    int status = 0;
    pid_t ended = 0;
    for (int wait = 0; wait < 500 && ended == 0; ++wait) {
        ended = waitpid(m_process, &status, WNOHANG);
        if (ended < 0 && errno == EINTR) ended = 0;
        if (ended == 0) ::usleep(1000);
    }
    if (ended == 0) end();
    m_process = -1;
    if (ended > 0 && WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
        return {"reading it took more than 20 seconds"};
    }
    if (ended > 0 && WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF) {
        return {"the metadata in its header takes too long to read"};
    }
    return {"it is damaged so badly that the image library failed on it"};
}

Result<void> ImageProcess::receive(void* data, std::size_t bytes) {
    auto* to = static_cast<std::uint8_t*>(data);
    while (bytes > 0) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(m_deadline - std::chrono::steady_clock::now());
        pollfd wait{m_output.get(), POLLIN, 0};
        const int ready = left.count() <= 0 ? 0 : ::poll(&wait, 1, static_cast<int>(left.count()));
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0) {
            end();
            return Error{"reading it took more than 20 seconds"};
        }
        const ssize_t got = ::read(m_output.get(), to, bytes);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return whyItDied();
        to += got;
        bytes -= static_cast<std::size_t>(got);
    }
    return {};
}

Result<image_protocol::Answer> ImageProcess::answer() {
    image_protocol::Answer answer;
    if (auto got = receive(&answer, sizeof answer); !got) return got.error();
    if (answer.magic != image_protocol::answerMagic) {
        return Error{std::string("the program ") + workerName + " is of another version; install Whorl again"};
    }
    if (answer.failed == 0) return answer;
    std::string text(std::min<std::uint64_t>(answer.bytes, image_protocol::maxErrorBytes), '\0');
    if (auto got = receive(text.data(), text.size()); !got) return got.error();
    return Error{text};
}

}  // namespace whorl
