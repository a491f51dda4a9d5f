// SPDX-License-Identifier: Apache-2.0
// Material libraries of OBJ files. Private to the importers.
#pragma once

#include "core/io/import/raw_mesh.h"

#include <glm/vec3.hpp>

#include <map>
#include <string>

namespace whorl::import {

struct ObjMaterial {
    glm::vec3 colour{clayColour};
    std::string image{};  ///< as the library names it; or empty
};
using ObjMaterials = std::map<std::string, ObjMaterial, std::less<>>;

/// Adds the materials of the library `reference`; what can not be read becomes a sentence in `problems`.
void readMaterials(std::string_view reference, const std::string& meshName, const Neighbours& neighbours,
                   ObjMaterials& materials, Problems& problems);

}  // namespace whorl::import
