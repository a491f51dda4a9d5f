// SPDX-License-Identifier: Apache-2.0
// Images in and out of maps, decoded by a separate program so that a bad file can not end this one.
#pragma once

#include "core/base/result.h"
#include "core/model/map.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace whorl {

enum class ImageUse { Data, Colour };
/// How EXR stores numbers. Half: three digits, half the size.
enum class ImageFloats { Whole, Half };

/// Reads PNG, EXR, TIFF, JPEG, TGA, BMP, PFM or HDR. Data: one channel (mean of the colours, or the only channel); 8
/// and 16 bit stay, others become float. Colour: three channels; integer formats are sRGB. At most 16,384 x 16,384 and
/// 512 MiB decoded; the header is checked first. The child process (whorl-image-worker, beside the running program or
/// in $WHORL_IMAGE_WORKER) may take 2 GiB and 20 s, less than a second of it for the header; it leaves out the metadata
/// of PNG and JPEG. Not-a-number becomes 0, infinite and negative texels are clamped;
/// `repairs` (may be null) then gets a sentence.
Result<Map> readImage(const std::filesystem::path& file, ImageUse use, std::vector<std::string>* repairs = nullptr);

/// The same for an image inside another file (glTF buffer views and data URIs). `name` is for error texts.
Result<Map> readImage(std::span<const std::uint8_t> bytes, const std::string& name, ImageUse use,
                      std::vector<std::string>* repairs = nullptr);

/// Format by suffix: png (8 or 16 bit), exr, tif, jpg, tga. Written beside the file and renamed. Colour: three channels
/// are colour, encoded or not as the format wants it. Data: they are numbers and stay. `floats` counts for EXR alone.
Result<void> writeImage(const Map& map, const std::filesystem::path& file, ImageUse use = ImageUse::Colour,
                        ImageFloats floats = ImageFloats::Whole);

/// Plain pixels, rows from the top, 8 bit sRGB, 3 or 4 channels: renders.
Result<void> writePixels(std::span<const std::uint8_t> pixels, int width, int height, int channels,
                         const std::filesystem::path& file);

/// Linear numbers as they are into an EXR, rows from the top, 3 or 4 channels; the last of four is opacity, by which
/// the others are not multiplied.
Result<void> writeFloats(std::span<const float> values, int width, int height, int channels,
                         const std::filesystem::path& file, ImageFloats floats = ImageFloats::Whole);

}  // namespace whorl
