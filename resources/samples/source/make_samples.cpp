// SPDX-License-Identifier: Apache-2.0
// Makes the documents that ship with Whorl: whorl-make-samples FOLDER
#include "core/io/document.h"
#include "resources/samples/source/grooms.h"

#include <cstdio>
#include <filesystem>

using namespace whorl;

namespace {

bool make(const char* name, Result<Groom> (*groom)(Progress&), const std::filesystem::path& folder) {
    Progress progress;
    const auto made = groom(progress);
    if (!made) {
        std::fprintf(stderr, "%s: %s\n", name, made.error().message.c_str());
        return false;
    }
    for (const std::string& problem : checkGroom(*made)) std::fprintf(stderr, "%s: %s\n", name, problem.c_str());
    const auto file = folder / (std::string(name) + ".whorl");
    if (const auto saved = saveDocument(*made, file, progress); !saved) {
        std::fprintf(stderr, "%s\n", saved.error().message.c_str());
        return false;
    }
    return checkGroom(*made).empty();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "Usage: whorl-make-samples FOLDER\n");
        return 2;
    }
    std::error_code ignored;
    std::filesystem::create_directories(argv[1], ignored);
    const bool bust = make("bust", samples::bustGroom, argv[1]);
    const bool creature = make("creature", samples::creatureGroom, argv[1]);
    const bool bob = make("bob", samples::bobGroom, argv[1]);
    const bool swatch = make("swatch", samples::swatchGroom, argv[1]);
    return bust && bob && creature && swatch ? 0 : 1;
}
