// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace whorl::samples {

struct SculptPart {
    std::string name;
    std::vector<std::array<uint32_t, 3>> triangles;
    bool growsHair = false;
    glm::vec3 colour{1.0f};  // linear albedo
};

/// A finished sample mesh: metres, Y up, facing +Z, mirror-symmetric in x.
struct Sculpture {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;  // one per vertex; vertices are split at chart seams
    std::vector<SculptPart> parts;
};

/// Row-major, row 0 at v = 1, values 0..1, dilated past the chart borders.
struct ScalarImage {
    int width = 0;
    int height = 0;
    std::vector<float> values;
};

/// As ScalarImage, linear colour.
struct ColourImage {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> values;
};

Sculpture sculptBust();
ScalarImage bustScalpDensity(int size);
ScalarImage bustBrowDensity(int size);
ColourImage bustSkin(int size);
/// The same for a sculpture whose first part is the bust's skin.
ColourImage bustSkin(const Sculpture& sculpture, int size);

/// The bust under a shell of chin-long hair: parts skin, foot, hair, and the shell's inside.
Sculpture sculptBob();
/// 1 on the hair, less where it ends.
ScalarImage bobDensity(int size);

Sculpture sculptCreature();
ScalarImage creatureDensity(int size);
ScalarImage creatureLength(int size);
ColourImage creatureSkin(int size);
ColourImage creatureFurColour(int size);

}  // namespace whorl::samples
