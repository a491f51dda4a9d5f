// SPDX-License-Identifier: Apache-2.0
#include "core/io/image.h"

#include "core/io/image_process.h"
#include "core/io/plain_text.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>

namespace whorl {
namespace {

namespace protocol = image_protocol;
constexpr std::uint64_t maxFileBytes = 1ull << 30;

std::string lowerSuffix(const std::string& name) {
    std::string suffix = std::filesystem::path(name).extension().string();
    for (char& c : suffix) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return suffix;
}

Error imageError(const std::string& name, const std::string& reason) {
    return {plainText(name) + ": " + plainText(reason, 300) +
            "; save the image again as PNG, TIFF or EXR and choose that file."};
}

// TGA has no magic bytes, so the fixed fields must make sense and the suffix must say so.
bool looksLikeTga(std::span<const std::uint8_t> head) {
    if (head.size() < 18) return false;
    const int kind = head[2] & ~8;
    const int depth = head[16];
    return head[1] <= 1 && kind >= 1 && kind <= 3 &&
           (depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32);
}

// The OpenImageIO format of the first bytes; nothing for anything that is not on the list.
std::optional<std::string> pluginFor(std::span<const std::uint8_t> head, const std::string& name) {
    const auto starts = [&](std::string_view magic) {
        return head.size() >= magic.size() && std::memcmp(head.data(), magic.data(), magic.size()) == 0;
    };
    using namespace std::string_view_literals;
    if (starts("\x89PNG\r\n\x1a\n"sv)) return "png";
    if (starts("\xff\xd8\xff"sv)) return "jpeg";
    if (starts("\x76\x2f\x31\x01"sv)) return "openexr";
    if (starts("II*\0"sv) || starts("MM\0*"sv) || starts("II+\0"sv) || starts("MM\0+"sv)) return "tiff";
    if (starts("#?RADIANCE"sv) || starts("#?RGBE"sv)) return "hdr";
    if (starts("PF\n"sv) || starts("Pf\n"sv) || starts("PF "sv) || starts("Pf "sv) || starts("PF\r"sv) ||
        starts("Pf\r"sv)) {
        return "pnm";
    }
    if (starts("BM"sv) && head.size() >= 26) return "bmp";
    const std::string suffix = lowerSuffix(name);
    if ((suffix == ".tga" || suffix == ".tpic") && looksLikeTga(head)) return "targa";
    return std::nullopt;
}

void say(std::vector<std::string>* repairs, const std::string& name, std::uint64_t count, const char* what) {
    if (repairs == nullptr || count == 0) return;
    repairs->push_back(plainText(name) + ": " + std::to_string(count) + (count == 1 ? " texel was " : " texels were ") +
                       what + ".");
}

Result<Map> decode(const Descriptor& input, std::span<const std::uint8_t> head, const std::string& name, ImageUse use,
                   std::vector<std::string>* repairs) {
    const auto plugin = pluginFor(head, name);
    if (!plugin) {
        return imageError(
            name, head.empty() ? "the file is empty" : "this is no PNG, EXR, TIFF, JPEG, TGA, BMP, PFM or HDR image");
    }
    auto worker = ImageProcess::start({"read", *plugin, use == ImageUse::Colour ? "colour" : "data"}, input);
    if (!worker) return Error{plainText(name) + ": " + worker.error().message + "."};
    const auto answer = worker->answer();
    if (!answer) return imageError(name, answer.error().message);

    const std::uint32_t channels = use == ImageUse::Colour ? 3 : 1;
    const std::uint64_t texel = std::uint64_t{channels} * protocol::formatBytes(answer->format);
    const std::uint64_t row = answer->width * texel;
    if (answer->width < 1 || answer->width > protocol::maxSize || answer->height < 1 ||
        answer->height > protocol::maxSize || answer->channels != channels || answer->format > 2 ||
        answer->bytes != row * answer->height || answer->bytes > protocol::maxDecodedBytes) {
        return imageError(name, "it is damaged so badly that the image library failed on it");
    }

    Map map(static_cast<int>(answer->width), static_cast<int>(answer->height), static_cast<int>(channels),
            static_cast<TexelFormat>(answer->format), 0.0f);
    map.srgb = use == ImageUse::Colour && map.format() != TexelFormat::F32;
    std::vector<std::uint8_t> band(row * Map::tileSize);
    for (int tileRow = 0; tileRow < map.tileRows(); ++tileRow) {
        const int rows = std::min(Map::tileSize, map.height() - tileRow * Map::tileSize);
        if (auto got = worker->receive(band.data(), row * static_cast<std::uint64_t>(rows)); !got) {
            return imageError(name, got.error().message);
        }
        for (int column = 0; column < map.tileColumns(); ++column) {
            auto& tile = map.editTileBytes(column, tileRow);
            const auto left = static_cast<std::uint64_t>(column) * Map::tileSize;
            const std::uint64_t bytes = std::min<std::uint64_t>(Map::tileSize, answer->width - left) * texel;
            for (std::uint64_t y = 0; y < static_cast<std::uint64_t>(rows); ++y) {
                std::memcpy(tile.data() + y * Map::tileSize * texel, band.data() + y * row + left * texel, bytes);
            }
        }
    }
    say(repairs, name, answer->notANumber, "not a number and became 0");
    say(repairs, name, answer->infinite, "infinite or absurdly large and became the image's largest sane value");
    say(repairs, name, answer->negative, "negative and became 0");
    return map;
}

// A file that is made beside `target` and takes its name only when everything is on the disk.
Result<void> encode(const protocol::Request& request, std::span<const std::uint8_t> pixels, const std::string& plugin,
                    const std::filesystem::path& target) {
    const std::string name = target.filename().string();
    const auto failed = [&](const std::string& reason) {
        return Error{plainText(name) + " could not be written: " + plainText(reason, 300) +
                     "; the old file, if any, is as it was."};
    };
    std::error_code ignored;
    const std::filesystem::path real =
        std::filesystem::is_symlink(target, ignored) ? std::filesystem::weakly_canonical(target, ignored) : target;
    static std::atomic<unsigned> number{0};
    const std::string own = ".whorl-image-" + std::to_string(::getpid()) + "-" + std::to_string(number++);
    const std::filesystem::path temporary = real.parent_path() / own;
    const Descriptor file(::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!file.open()) return failed(std::generic_category().message(errno));

    const auto write = [&]() -> Result<void> {
        const auto* head = reinterpret_cast<const std::uint8_t*>(&request);
        const Descriptor input = memoryFile({head, sizeof request}, pixels);
        if (!input.open()) return failed("there is not enough memory");
        auto worker = ImageProcess::start({"write", plugin, temporary.string()}, input);
        if (!worker) return failed(worker.error().message);
        if (const auto answer = worker->answer(); !answer) return failed(answer.error().message);
        struct stat old {};
        if (::stat(real.c_str(), &old) == 0) fchmod(file.get(), old.st_mode & 0777);
        if (fsync(file.get()) != 0 || ::rename(temporary.c_str(), real.c_str()) != 0) {
            return failed(std::generic_category().message(errno));
        }
        return {};
    };
    const auto written = write();
    if (!written) ::unlink(temporary.c_str());
    return written;
}

// Copies the texels out, row by row, changing format and encoding where the file's format asks for it.
std::vector<std::uint8_t> flatten(const Map& map, TexelFormat format, float (*convert)(float)) {
    const auto channels = static_cast<std::size_t>(map.channels());
    const std::size_t values =
        static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()) * channels;
    std::vector<std::uint8_t> out(values * texelBytes(format));
    std::size_t at = 0;
    for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
            for (int c = 0; c < map.channels(); ++c, ++at) {
                float value = map.texel(x, y, c);
                if (convert != nullptr) value = convert(std::clamp(value, 0.0f, 1.0f));
                if (format == TexelFormat::F32) {
                    std::memcpy(&out[at * 4], &value, 4);
                } else if (format == TexelFormat::U16) {
                    const auto whole = static_cast<std::uint16_t>(std::clamp(value, 0.0f, 1.0f) * 65535.0f + 0.5f);
                    std::memcpy(&out[at * 2], &whole, 2);
                } else {
                    out[at] = static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
                }
            }
        }
    }
    return out;
}

struct OutputFormat {
    const char* suffix;
    const char* plugin;
    TexelFormat widest;
    bool linear;  ///< colours are stored linear
};
constexpr OutputFormat outputFormats[] = {
    {".png", "png", TexelFormat::U16, false},   {".tif", "tiff", TexelFormat::F32, false},
    {".tiff", "tiff", TexelFormat::F32, false}, {".exr", "openexr", TexelFormat::F32, true},
    {".jpg", "jpeg", TexelFormat::U8, false},   {".jpeg", "jpeg", TexelFormat::U8, false},
    {".tga", "targa", TexelFormat::U8, false},
};

Result<OutputFormat> outputFormat(const std::filesystem::path& file) {
    const std::string suffix = lowerSuffix(file.string());
    for (const OutputFormat& format : outputFormats) {
        if (suffix == format.suffix) return format;
    }
    return Error{plainText(file.filename().string()) +
                 ": images are written as .png, .exr, .tif, .jpg or .tga; choose one of these endings."};
}

Result<void> checkPixels(std::size_t values, int width, int height, int channels, const std::filesystem::path& file) {
    const bool possible = width >= 1 && height >= 1 && width <= Map::maxSize && height <= Map::maxSize &&
                          (channels == 3 || channels == 4);
    if (possible && values == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                                  static_cast<std::size_t>(channels))
        return {};
    return Error{plainText(file.filename().string()) + ": " + std::to_string(width) + " x " + std::to_string(height) +
                 " pixels with " + std::to_string(channels) +
                 " channels can not be written; choose 1 to 16,384 pixels a side."};
}

}  // namespace

Result<Map> readImage(const std::filesystem::path& file, ImageUse use, std::vector<std::string>* repairs) {
    const std::string name = file.filename().string();
    // O_NONBLOCK: opening a pipe that nobody writes to must not wait for ever.
    const Descriptor input(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!input.open()) {
        return Error{plainText(name) + ": the file can not be opened (" + std::generic_category().message(errno) +
                     "); check that it is there and that you may read it."};
    }
    struct stat facts {};
    if (fstat(input.get(), &facts) != 0 || !S_ISREG(facts.st_mode)) return imageError(name, "this is not a file");
    if (static_cast<std::uint64_t>(facts.st_size) > maxFileBytes) {
        return imageError(name, "the file is larger than 1 GiB");
    }
    std::uint8_t head[32];
    const ssize_t got = ::pread(input.get(), head, sizeof head, 0);
    return decode(input, {head, static_cast<std::size_t>(std::max<ssize_t>(got, 0))}, name, use, repairs);
}

Result<Map> readImage(std::span<const std::uint8_t> bytes, const std::string& name, ImageUse use,
                      std::vector<std::string>* repairs) {
    const auto head = bytes.first(std::min<std::size_t>(bytes.size(), 32));
    if (!pluginFor(head, name)) return decode({}, head, name, use, repairs);
    const Descriptor input = memoryFile(bytes, {});
    if (!input.open()) return imageError(name, "there is not enough memory");
    return decode(input, head, name, use, repairs);
}

Result<void> writeImage(const Map& map, const std::filesystem::path& file, ImageUse use, ImageFloats floats) {
    const auto output = outputFormat(file);
    if (!output) return output.error();
    if (map.empty())
        return Error{plainText(file.filename().string()) + ": the map is empty; there is nothing to write."};
    const bool colour = map.channels() == 3 && use == ImageUse::Colour;
    const bool encodedNow = colour && map.srgb;
    TexelFormat format = std::min(map.format(), output->widest);
    float (*convert)(float) = nullptr;
    bool srgb = encodedNow;
    if (output->linear) {
        format = TexelFormat::F32;
        if (encodedNow) convert = linearFromSrgb;
        srgb = false;
    } else if (colour && !encodedNow && format != TexelFormat::F32) {
        convert = srgbFromLinear;
        srgb = true;
    }
    protocol::Request request;
    request.width = static_cast<std::uint32_t>(map.width());
    request.height = static_cast<std::uint32_t>(map.height());
    request.channels = static_cast<std::uint32_t>(map.channels());
    request.format = static_cast<std::uint32_t>(format);
    request.srgb = srgb ? 1 : 0;
    request.half = output->linear && floats == ImageFloats::Half ? 1 : 0;
    return encode(request, flatten(map, format, convert), output->plugin, file);
}

Result<void> writePixels(std::span<const std::uint8_t> pixels, int width, int height, int channels,
                         const std::filesystem::path& file) {
    const auto output = outputFormat(file);
    if (!output) return output.error();
    if (auto possible = checkPixels(pixels.size(), width, height, channels, file); !possible) return possible.error();
    protocol::Request request;
    request.width = static_cast<std::uint32_t>(width);
    request.height = static_cast<std::uint32_t>(height);
    request.channels = static_cast<std::uint32_t>(channels);
    request.srgb = 1;
    return encode(request, pixels, output->plugin, file);
}

Result<void> writeFloats(std::span<const float> values, int width, int height, int channels,
                         const std::filesystem::path& file, ImageFloats floats) {
    const auto output = outputFormat(file);
    if (!output) return output.error();
    if (!output->linear)
        return Error{plainText(file.filename().string()) + ": floats are written as .exr; choose this ending."};
    if (auto possible = checkPixels(values.size(), width, height, channels, file); !possible) return possible.error();
    protocol::Request request;
    request.width = static_cast<std::uint32_t>(width);
    request.height = static_cast<std::uint32_t>(height);
    request.channels = static_cast<std::uint32_t>(channels);
    request.format = static_cast<std::uint32_t>(TexelFormat::F32);
    request.half = floats == ImageFloats::Half ? 1 : 0;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
    return encode(request, {bytes, values.size_bytes()}, output->plugin, file);
}

}  // namespace whorl
