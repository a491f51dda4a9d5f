// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/obj_materials.h"

#include "core/io/import/lines.h"
#include "core/io/plain_text.h"

#include <algorithm>

namespace whorl::import {
namespace {

// The file name behind options such as "-s 1 1 1" or "-bm 0.5"; names may hold spaces.
std::string imageName(std::string_view rest) {
    rest = trimmed(rest);
    while (!rest.empty() && rest.front() == '-') {
        std::string_view after = rest;
        const std::string_view option = takeWord(after);
        if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-clamp" ||
            option == "-imfchan" || option == "-type" || option == "-texres" || option == "-bm" || option == "-boost") {
            takeWord(after);
        } else {
            for (std::string_view peek = after; parseFloat(takeWord(peek)); after = peek) {
            }
        }
        rest = trimmed(after);
    }
    std::string name(rest);
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

}  // namespace

void readMaterials(std::string_view reference, const std::string& meshName, const Neighbours& neighbours,
                   ObjMaterials& materials, Problems& problems) {
    std::string file(reference);
    std::replace(file.begin(), file.end(), '\\', '/');
    const auto bytes = neighbours.read(file, 16u << 20);
    if (!bytes) {
        problems.push_back(plainText(meshName) + ": the material library " + plainText(file, 80) +
                           " is left out: " + bytes.error().message + ".");
        return;
    }
    Lines lines({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    ObjMaterial* material = nullptr;
    std::string_view line;
    while (lines.next(line)) {
        const std::string_view keyword = takeWord(line);
        if (keyword == "newmtl") {
            if (materials.size() >= maxParts) return;
            material = &materials[std::string(trimmed(line))];
            *material = {};
        } else if (material != nullptr && keyword == "Kd") {
            glm::vec3 colour(0.0f);
            bool good = true;
            for (int i = 0; i < 3; ++i) {
                const auto number = parseFloat(takeWord(line));
                good = good && number && *number >= 0.0f && *number <= 1.0f;
                if (good) colour[i] = *number;
            }
            if (good) material->colour = colour;
        } else if (material != nullptr && keyword == "map_Kd") {
            material->image = imageName(line);
        }
    }
}

}  // namespace whorl::import
