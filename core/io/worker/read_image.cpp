// SPDX-License-Identifier: Apache-2.0
// Decoding: header first, then one or three channels, repaired.
#include "core/io/worker/answer.h"

#include <OpenImageIO/imageio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace whorl::image_worker {
namespace {

using image_protocol::Answer;
constexpr const char* inputName = "/proc/self/fd/0";

// OpenImageIO's reason in one line, without the name that the file has in here.
std::string reason(std::string text, const char* otherwise) {
    if (const std::size_t line = text.find('\n'); line != std::string::npos) text.resize(line);
    for (std::size_t at = text.find(inputName); at != std::string::npos; at = text.find(inputName)) {
        text.replace(at, std::strlen(inputName), "the file");
    }
    return text.empty() ? otherwise : text;
}

// Which channels make the answer: up to three colours, never alpha or depth.
std::vector<int> wantedChannels(const OIIO::ImageSpec& spec) {
    const auto named = [&](const char* name) {
        for (int c = 0; c < spec.nchannels; ++c) {
            if (OIIO::Strutil::iequals(spec.channel_name(c), name)) return c;
        }
        return -1;
    };
    const int r = named("R"), g = named("G"), b = named("B");
    if (r >= 0 && g >= 0 && b >= 0) return {r, g, b};
    if (const int y = named("Y"); y >= 0) return {y};
    std::vector<int> plain;
    for (int c = 0; c < spec.nchannels && plain.size() < 3; ++c) {
        if (c != spec.alpha_channel && c != spec.z_channel) plain.push_back(c);
    }
    if (plain.empty()) return {0};
    if (plain.size() == 2) plain.pop_back();
    return plain;
}

// A texel that is not-a-number becomes 0, a negative one 0, an infinite one the largest sane one.
float repaired(float value, float largest, Answer& answer) {
    if (std::isnan(value)) {
        ++answer.notANumber;
        return 0.0f;
    }
    if (value < 0.0f) {
        ++answer.negative;
        return 0.0f;
    }
    if (value > largest) {
        ++answer.infinite;
        return largest;
    }
    return value;
}

// Picks `wanted` out of each pixel of `stride` values. Data: their mean; colour: three.
template <class T>
std::vector<T> pick(const std::vector<T>& pixels, std::size_t stride, const std::vector<int>& wanted, bool colour) {
    const std::size_t count = pixels.size() / stride;
    std::vector<T> out(count * (colour ? 3 : 1));
    for (std::size_t i = 0; i < count; ++i) {
        const T* from = &pixels[i * stride];
        if (colour) {
            for (std::size_t c = 0; c < 3; ++c) {
                out[i * 3 + c] = from[wanted[wanted.size() == 3 ? c : 0]];
            }
        } else {
            double sum = 0.0;
            for (const int c : wanted) sum += static_cast<double>(from[c]);
            const double mean = sum / static_cast<double>(wanted.size());
            out[i] = static_cast<T>(std::is_integral_v<T> ? std::floor(mean + 0.5) : mean);
        }
    }
    return out;
}

template <class T>
int decode(OIIO::ImageInput& input, OIIO::TypeDesc type, const std::vector<int>& wanted, bool colour, Answer answer) {
    const OIIO::ImageSpec& spec = input.spec();
    const int last = *std::max_element(wanted.begin(), wanted.end()) + 1;
    std::vector<T> pixels(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                          static_cast<std::size_t>(last));
    if (!input.read_image(0, 0, 0, last, type, pixels.data())) {
        return fail(reason(input.geterror(), "its pixels are damaged"));
    }
    if constexpr (std::is_floating_point_v<T>) {
        // Beyond the range of half floats a number is no colour and no density.
        constexpr float sane = 65504.0f;
        float largest = 0.0f;
        for (const float value : pixels) {
            if (value <= sane) largest = std::max(largest, value);
        }
        for (float& value : pixels) value = repaired(value, largest > 0.0f ? largest : 1.0f, answer);
    }
    const std::vector<T> out = pick(pixels, static_cast<std::size_t>(last), wanted, colour);
    answer.bytes = out.size() * sizeof(T);
    return send(&answer, sizeof answer) && send(out.data(), answer.bytes) ? 0 : 1;
}

}  // namespace

int readImage(const std::string& plugin, bool colour) {
    if (!beginHeaderLimit()) return fail("the limits for memory and time can not be set");
    if (!leaveOutMetadata(plugin)) return fail("there is not enough memory");
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", 1);
    auto input = OIIO::ImageInput::create(plugin);
    if (!input) return fail("this build of OpenImageIO can not read the format " + plugin);
    OIIO::ImageSpec wish;
    wish.attribute("oiio:UnassociatedAlpha", 1);  // colours of hidden texels count: seams are padded there
    OIIO::ImageSpec spec;
    if (!input->open(inputName, spec, wish)) return fail(reason(input->geterror(), "its header is damaged"));

    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1) {
        return fail("its header says " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels");
    }
    constexpr int most = static_cast<int>(image_protocol::maxSize);
    const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height);
    if (spec.width > most || spec.height > most) {
        return fail("it is " + size + " pixels; at most 16,384 x 16,384 are read");
    }
    const std::vector<int> wanted = wantedChannels(spec);
    const auto used = static_cast<std::uint64_t>(*std::max_element(wanted.begin(), wanted.end()) + 1);
    Answer answer;
    answer.width = static_cast<std::uint32_t>(spec.width);
    answer.height = static_cast<std::uint32_t>(spec.height);
    answer.channels = colour ? 3 : 1;
    answer.format = spec.format == OIIO::TypeDesc::UINT8 ? 0u : spec.format == OIIO::TypeDesc::UINT16 ? 1u : 2u;
    const std::uint64_t needed = std::uint64_t{answer.width} * answer.height *
                                 image_protocol::formatBytes(answer.format) *
                                 std::max<std::uint64_t>(used, answer.channels);
    if (needed > image_protocol::maxDecodedBytes) {
        return fail("it is " + size + " pixels and needs " + std::to_string(needed >> 20) +
                    " MiB of memory; at most 512 MiB are read");
    }
    // No format here packs more than about a thousand to one (deflate's own limit is 1,032), so a small file with a
    // huge picture is a lie. Small pictures may be as empty as they like.
    struct stat file {};
    if (fstat(STDIN_FILENO, &file) != 0) return fail("it can not be read");
    const auto present = static_cast<std::uint64_t>(std::max<off_t>(file.st_size, 0));
    if (needed > (64ull << 20) && needed / 1100 > present) {
        return fail("its header says " + size + " pixels, more than a file of " + std::to_string(present) +
                    " bytes can hold");
    }
    endHeaderLimit();
    if (answer.format == 0) return decode<std::uint8_t>(*input, OIIO::TypeDesc::UINT8, wanted, colour, answer);
    if (answer.format == 1) return decode<std::uint16_t>(*input, OIIO::TypeDesc::UINT16, wanted, colour, answer);
    return decode<float>(*input, OIIO::TypeDesc::FLOAT, wanted, colour, answer);
}

}  // namespace whorl::image_worker
