// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "resources/samples/source/halfmesh.h"
#include "resources/samples/source/sculpt.h"
#include "resources/samples/source/unwrap.h"

#include <functional>
#include <string>
#include <vector>

namespace whorl::samples {

struct PartStyle {
    std::string name;
    bool growsHair;
    glm::vec3 colour;
};

/// How a half mesh becomes a finished sculpture.
struct Recipe {
    SeamRules seams;
    std::vector<PartStyle> parts;
    std::function<int(uint8_t)> partOf;        // region -> part
    std::function<float(uint8_t)> texelShare;  // region -> relative texture resolution
    std::function<glm::vec3(uint8_t, const glm::vec3&)> normal;
};

/// Cuts and flattens the charts, packs them into the unit square and adds the mirrored half.
Sculpture assemble(const HalfMesh& mesh, const Recipe& recipe);

}  // namespace whorl::samples
