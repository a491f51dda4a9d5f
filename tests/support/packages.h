// SPDX-License-Identifier: Apache-2.0
// Small packages for tests, and changes in them that their checksums do not give away.
#pragma once

#include "core/base/hash.h"
#include "core/io/json_text.h"
#include "tests/support/shapes.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace whorl::testing {

inline std::string textOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void put(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// Files and folders in a folder.
inline std::size_t entries(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

/// Twenty guides on a ball; quick to make hair of, because no distance field is needed.
inline Groom smallGroom(int hairs = 300) {
    Groom groom = groomOn(sphere(8, 12), 20, 6);
    groom.counts.edit().hairs = hairs;
    groom.groups.edit()[0].params.general.keepOutside = false;
    return groom;
}

/// groom.json with one thing changed and the right checksum.
template <class Change>
void rewrite(const std::filesystem::path& package, Change&& change) {
    nlohmann::json manifest = *parseJson(textOf(package / "groom.json"), "groom.json");
    change(manifest);
    manifest.erase("checksum");
    const std::string text = jsonText(manifest);
    manifest["checksum"] = hexDigest(hashBytes(text.data(), text.size()));
    put(package / "groom.json", jsonText(manifest, 1));
}

}  // namespace whorl::testing
