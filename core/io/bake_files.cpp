// SPDX-License-Identifier: Apache-2.0
#include "core/io/bake_files.h"

#include "core/field/groom_field.h"
#include "core/io/image.h"

#include <algorithm>

namespace whorl {
namespace {

std::string formatOf(const BakeRequest& request) {
    if (!request.format.empty()) return request.format;
    std::string suffix = request.file.extension().string();
    std::ranges::transform(suffix, suffix.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return suffix == ".exr" ? "exr" : "png";
}

TexelFormat texelsOf(BakeMap map, const BakeRequest& request) {
    if (formatOf(request) == "exr") return TexelFormat::F32;
    const bool fine = map == BakeMap::Flow || map == BakeMap::Height;
    return request.bits == 16 || (request.bits != 8 && fine) ? TexelFormat::U16 : TexelFormat::U8;
}

std::filesystem::path fileOf(BakeMap map, const BakeRequest& request) {
    std::filesystem::path file = request.file;
    const std::string suffix = file.extension().string();
    if (suffix == ".png" || suffix == ".exr" || suffix == ".PNG" || suffix == ".EXR") file.replace_extension();
    file += "_" + std::string(bakeMapNames[static_cast<std::size_t>(map)]) + "." + formatOf(request);
    return file;
}

ImageFloats floatsOf(const BakeRequest& request) {
    return request.bits == 16 ? ImageFloats::Half : ImageFloats::Whole;
}

Result<void> writeTogether(const LicBake& bake, const BakeRequest& request) {
    if (formatOf(request) == "exr") {
        std::vector<float> values;
        values.reserve(bake.colour.size() * 4);
        for (std::size_t i = 0; i < bake.colour.size(); ++i) {
            for (int c = 0; c < 3; ++c) values.push_back(bake.colour[i][c]);
            values.push_back(bake.opacity[i]);
        }
        return writeFloats(values, bake.size, bake.size, 4, request.file, floatsOf(request));
    }
    std::vector<std::uint8_t> pixels;
    pixels.reserve(bake.colour.size() * 4);
    const auto byte = [](float value) {
        return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
    };
    for (std::size_t i = 0; i < bake.colour.size(); ++i) {
        for (int c = 0; c < 3; ++c) pixels.push_back(byte(srgbFromLinear(std::min(bake.colour[i][c], 1.0f))));
        pixels.push_back(byte(bake.opacity[i]));
    }
    return writePixels(pixels, bake.size, bake.size, 4, request.file);
}

}  // namespace

Result<std::vector<BakeMap>> bakeMapsNamed(std::span<const std::string> names) {
    std::vector<BakeMap> maps;
    for (const std::string& name : names) {
        const auto at = std::ranges::find(bakeMapNames, name);
        if (at == bakeMapNames.end())
            return Error{"There is no map \"" + name + "\" to bake; choose colour, opacity, flow or height."};
        const auto map = static_cast<BakeMap>(at - bakeMapNames.begin());
        if (std::ranges::find(maps, map) == maps.end()) maps.push_back(map);
    }
    return maps;
}

std::vector<std::filesystem::path> bakedFiles(const BakeRequest& request) {
    if (request.maps.empty()) return {request.file};
    std::vector<std::filesystem::path> files;
    for (const BakeMap map : request.maps) files.push_back(fileOf(map, request));
    return files;
}

Result<std::vector<std::filesystem::path>> bakeToFiles(const Groom& groom, std::shared_ptr<const Surface> surface,
                                                       const BakeRequest& request, Progress& progress) {
    const int other = formatOf(request) == "exr" ? 32 : 8;
    if (request.bits != 0 && request.bits != 16 && request.bits != other)
        return Error{"A channel of " + std::string(other == 32 ? "EXR" : "PNG") + " has " +
                     (other == 32 ? "16 or 32" : "8 or 16") + " bits, not " + std::to_string(request.bits) +
                     "; choose one of these."};
    const auto field = groomField(groom, surface, progress);
    if (!field) return field.error();
    const auto bake = bakeLic(groom, surface, *field, request.options, progress);
    if (!bake) return bake.error();
    if (request.maps.empty()) {
        if (auto written = writeTogether(*bake, request); !written) return written.error();
    }
    for (const BakeMap map : request.maps) {
        if (progress.cancelled()) return cancelledError();
        const TexelFormat format = texelsOf(map, request);
        const Map image = imageOf(*bake, map, format, format != TexelFormat::F32);
        const ImageUse use = map == BakeMap::Colour ? ImageUse::Colour : ImageUse::Data;
        if (auto written = writeImage(image, fileOf(map, request), use, floatsOf(request)); !written)
            return written.error();
    }
    return bakedFiles(request);
}

}  // namespace whorl
