// SPDX-License-Identifier: Apache-2.0
// What is shown, and how it is lit.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>

namespace whorl {

enum class HairShading { KajiyaKay };
enum class ShadowMode { None, Voxel };

/// Not part of the groom: each view has its own.
struct ViewSettings {
    bool showMesh = true;
    bool showTexture = true;
    bool showHair = true;
    /// Hair texture on the mesh (Renderer::setLicImage), with showHair below the strands, which cast shadows on it.
    bool showLic = false;
    bool showGuides = false;
    bool showStrokes = false;        ///< strokes of the direction field, and where it turns
    std::uint32_t pickedStroke = 0;  ///< id of the stroke that stands out
    std::string overlayMap{};        ///< map shown in colour over the mesh, or empty
    float overlayOpacity = 0.65f;
    bool overlayGroups = false;  ///< the map holds numbers of groups: each in its own colour (groupColour)
    bool heat = false;           ///< colours of Renderer::setTriangleColours over the mesh

    HairShading shading = HairShading::KajiyaKay;
    ShadowMode shadows = ShadowMode::Voxel;
    float diffuse = 0.75f;
    float specular = 0.35f;
    float shininess = 60.0f;    ///< exponent p of Kajiya-Kay
    float shadowAlpha = 0.82f;  ///< light that one layer of hair lets through (seed 004: light = alpha^sum)
    glm::vec3 lightDirection{0.45f, 0.75f, 0.65f};  ///< towards the key light, space of the camera's azimuth
    bool lightFollowsCamera = true;
    float ambient = 0.35f;
    glm::vec3 background{0.055f, 0.06f, 0.07f};  ///< linear, at the centre
    int samples = 4;                             ///< multisampling, 1 to 4
    float minPixelWidth = 1.0f;                  ///< thinner hair is drawn this wide and more transparent
    /// Fewer hairs than this (a head has about 100,000) are drawn and cast shadows wider, up to three times, so that a
    /// preview looks as dense as the hair that it stands for. 0: true widths.
    float fullCount = 100000.0f;
    float exposure = 1.0f;
    /// The view moves or a stroke is drawn: without a graphics card a part of the hair is drawn, wider, with fewer
    /// points and samples, so that the viewport follows. Makes no difference with one.
    bool interactive = false;
};

/// Brush circle and hints over the picture, in pixels of the viewport from the top left.
struct OverlayState {
    bool showBrush = false;
    glm::vec2 brushPixel{0.0f};
    float brushRadius = 0.0f;
    float brushStrength = 0.0f;
    std::string text{};  ///< bottom left: counts, milliseconds
    float scale = 1.0f;  ///< pixels of the viewport for one of an ordinary screen: size of text and lines
};

/// Linear colour of a group's number on the model and beside its name: neighbours in number differ clearly.
glm::vec3 groupColour(int group);

}  // namespace whorl
