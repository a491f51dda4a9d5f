// SPDX-License-Identifier: Apache-2.0
#include "editor/app/options.h"

#include <cmath>

namespace whorl {

BrushSettings BrushOptions::settings(bool invert) const {
    BrushSettings brush;
    brush.radiusPixels = radius;
    brush.strength = strength;
    brush.value = value;
    brush.reach = reach.index == 0 ? Reach::Projected : Reach::Spherical;
    brush.mirrorX = mirror;
    brush.frontOnly = frontOnly;
    brush.keepLength = keepLength;
    brush.keepOutside = keepOutside;
    brush.respectPartings = respectPartings;
    brush.pressureSize = pressureSize;
    brush.pressureStrength = pressureStrength;
    brush.invert = invert;
    brush.map = map.name;
    return brush;
}

int ViewOptions::licSize() const {
    return showHair && !heat && hairAs.index != 0 ? 512 << textureSize.index : 0;
}

ViewSettings ViewOptions::settings() const {
    ViewSettings view;
    view.showMesh = showMesh;
    view.showTexture = showTexture;
    view.heat = heat;
    view.showHair = showHair && !heat && hairAs.index != 1;
    view.showLic = licSize() > 0;
    view.showGuides = showGuides && !heat;
    view.overlayOpacity = overlayOpacity;
    view.shading = HairShading::KajiyaKay;
    view.shadows = shadows.index == 0 ? ShadowMode::None : ShadowMode::Voxel;
    view.diffuse = diffuse;
    view.specular = specular;
    view.shininess = shininess;
    view.shadowAlpha = shadowAlpha;
    view.lightDirection = {std::sin(lightAzimuth) * std::cos(lightElevation), std::sin(lightElevation),
                           std::cos(lightAzimuth) * std::cos(lightElevation)};
    view.lightFollowsCamera = lightFollowsCamera;
    view.ambient = ambient;
    view.background = background.value;
    view.samples = samples;
    view.minPixelWidth = minPixelWidth;
    view.exposure = exposure;
    return view;
}

}  // namespace whorl
