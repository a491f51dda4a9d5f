// SPDX-License-Identifier: Apache-2.0
// Starting whorl-image-worker, listening to it, and ending it in time. Private to core/io/image.cpp.
#pragma once

#include "core/base/result.h"
#include "core/io/image_protocol.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace whorl {

/// A file descriptor that closes itself.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : m_number(number) {}
    Descriptor(Descriptor&& other) noexcept : m_number(std::exchange(other.m_number, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(m_number, other.m_number);
        return *this;
    }
    ~Descriptor();
    int get() const { return m_number; }
    bool open() const { return m_number >= 0; }
    void reset();

private:
    int m_number = -1;
};

/// Bytes in memory as a descriptor that can be read from the start; not open when the system has no room.
Descriptor memoryFile(std::span<const std::uint8_t> head, std::span<const std::uint8_t> body);

/// One running worker. Errors are half sentences ("it was too slow and ...") for the caller to put a name before.
class ImageProcess {
public:
    /// `input` becomes the worker's descriptor 0; nothing else is inherited.
    static Result<ImageProcess> start(const std::vector<std::string>& arguments, const Descriptor& input);
    ImageProcess(ImageProcess&& other) noexcept;
    ImageProcess& operator=(ImageProcess&&) = delete;
    ~ImageProcess();  ///< ends the worker if it still runs

    /// The worker's answer; its own error text or its death as an Error.
    Result<image_protocol::Answer> answer();
    /// The next `bytes` of pixels.
    Result<void> receive(void* data, std::size_t bytes);

private:
    ImageProcess() = default;
    Error whyItDied();
    void end();

    Descriptor m_output;
    int m_process = -1;
    std::chrono::steady_clock::time_point m_deadline;
};

}  // namespace whorl
