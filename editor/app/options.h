// SPDX-License-Identifier: Apache-2.0
// What the artist sets for brushes and for the view, declared like the groom's own parameters.
#pragma once

#include "core/brushes/brush.h"
#include "core/param/param.h"
#include "render/view_settings.h"

#include <array>

namespace whorl {

inline constexpr std::array<std::string_view, 2> reachNames{"Under the circle", "In a ball"};

/// BrushSettings as a block of parameters.
struct BrushOptions {
    float radius = 50.0f;
    float strength = 0.5f;
    float value = 1.0f;
    MapName map{};
    Choice reach{};
    bool mirror = false;
    bool frontOnly = true;
    bool keepLength = true;
    bool keepOutside = true;
    bool respectPartings = true;
    bool pressureSize = false;
    bool pressureStrength = true;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "radius",
                        .label = "Size",
                        .min = 1,
                        .max = 2000,
                        .softMax = 300,
                        .unit = "px",
                        .tip = "Radius of the brush. Keys: [ and ], or hold B and drag.",
                        .logarithmic = true},
              self.radius);
        visit(ParamInfo{.id = "strength",
                        .label = "Strength",
                        .unit = "%",
                        .shownScale = 100,
                        .tip = "How much one pass of the brush does. Key: Shift+F and drag."},
              self.strength);
        visit(ParamInfo{.id = "map", .label = "Map", .tip = "The map that is painted."}, self.map);
        visit(ParamInfo{.id = "value", .label = "Value", .tip = "What is painted: 0 is none, 1 is full."}, self.value);
        visit(ParamInfo{.id = "reach",
                        .label = "Reach",
                        .tip = "Under the circle: everything that it covers. In a ball: only what is near the place "
                               "under the cursor.",
                        .choices = reachNames},
              self.reach);
        visit(ParamInfo{.id = "mirror",
                        .label = "Mirror left and right",
                        .tip = "Does the same on the other side of the model. Key: X."},
              self.mirror);
        visit(ParamInfo{.id = "front_only",
                        .label = "Front only",
                        .tip = "Leaves alone what faces away or is hidden behind the model."},
              self.frontOnly);
        visit(ParamInfo{.id = "keep_length", .label = "Keep length", .tip = "Combing does not stretch guides."},
              self.keepLength);
        visit(ParamInfo{.id = "keep_outside",
                        .label = "Keep outside the skin",
                        .tip = "Combing does not push guides into the model."},
              self.keepOutside);
        visit(ParamInfo{.id = "respect_partings",
                        .label = "Stay on one side of partings",
                        .tip = "Leaves guides alone beyond the partings around the place where the stroke began."},
              self.respectPartings);
        visit(ParamInfo{.id = "pressure_size",
                        .label = "Pen pressure sets size",
                        .tip = "Pressing harder makes the brush larger."},
              self.pressureSize);
        visit(ParamInfo{.id = "pressure_strength",
                        .label = "Pen pressure sets strength",
                        .tip = "Pressing harder makes the brush stronger."},
              self.pressureStrength);
    }
    BrushSettings settings(bool invert) const;
    bool operator==(const BrushOptions&) const = default;
};

inline constexpr std::array<std::string_view, 3> hairAsNames{"Hair", "Texture", "Both"};
inline constexpr std::array<std::string_view, 4> textureSizeNames{"512", "1024", "2048", "4096"};
inline constexpr std::array<std::string_view, 1> shadingNames{"Kajiya-Kay"};
inline constexpr std::array<std::string_view, 2> shadowNames{"None", "Voxels"};

/// ViewSettings as a block of parameters.
struct ViewOptions {
    bool showHair = true;
    Choice hairAs{};
    Choice textureSize{1};
    bool showGuides = true;
    bool showMesh = true;
    bool showTexture = true;
    bool heat = false;
    float time = 0.0f;
    float detail = 1.0f;
    float overlayOpacity = 0.65f;
    Choice shading{};
    float diffuse = 0.75f;
    float specular = 0.35f;
    float shininess = 60.0f;
    Choice shadows{1};
    float shadowAlpha = 0.82f;
    float lightAzimuth = 0.606f;
    float lightElevation = 0.755f;
    bool lightFollowsCamera = true;
    float ambient = 0.35f;
    float exposure = 1.0f;
    Colour background{{0.055f, 0.06f, 0.07f}};
    int samples = 4;
    float minPixelWidth = 1.0f;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "show_hair", .label = "Hair", .tip = "Shows the hair."}, self.showHair);
        visit(ParamInfo{.id = "hair_as",
                        .label = "Hair as",
                        .tip =
                            "Hair: each one drawn. Texture: painted on the model along the directions. Both: hair with "
                            "its texture below it.",
                        .choices = hairAsNames},
              self.hairAs);
        visit(ParamInfo{.id = "texture_size",
                        .label = "Texture detail",
                        .tip =
                            "Texels of the hair texture's side. More show finer hairs and follow a stroke more slowly.",
                        .choices = textureSizeNames},
              self.textureSize);
        visit(ParamInfo{.id = "show_guides",
                        .label = "Guides",
                        .tip = "Shows the guides over the hair while a guide tool is picked."},
              self.showGuides);
        visit(ParamInfo{.id = "show_mesh", .label = "Model", .tip = "Shows the model."}, self.showMesh);
        visit(ParamInfo{.id = "show_texture", .label = "Texture", .tip = "Shows the model's own texture."},
              self.showTexture);
        visit(ParamInfo{.id = "heat",
                        .label = "Asked against placed",
                        .tip = "Instead of the hair: white where as many hairs grow as the density asks for, blue "
                               "where there are fewer, red where there are more."},
              self.heat);
        visit(ParamInfo{.id = "time",
                        .label = "Time",
                        .max = 1e6,
                        .softMax = 10,
                        .unit = "s",
                        .tip = "The moment that is shown, where frizz is animated."},
              self.time);
        visit(
            ParamInfo{.id = "detail",
                      .label = "Level of detail",
                      .min = 0.001,
                      .unit = "%",
                      .shownScale = 100,
                      .tip = "Shows the groom as a renderer makes it far away: this share of the hairs, as much wider "
                             "as they are fewer."},
            self.detail);
        visit(ParamInfo{.id = "overlay_opacity",
                        .label = "Map over model",
                        .unit = "%",
                        .shownScale = 100,
                        .tip = "How strongly the painted map covers the model."},
              self.overlayOpacity);
        visit(
            ParamInfo{
                .id = "shading", .label = "Shading", .tip = "How light plays on a hair.", .choices = shadingNames},
            self.shading);
        visit(ParamInfo{.id = "diffuse", .label = "Diffuse", .max = 2, .tip = "Soft light along the hair."},
              self.diffuse);
        visit(ParamInfo{.id = "specular", .label = "Highlight", .max = 2, .tip = "Strength of the shine."},
              self.specular);
        visit(ParamInfo{.id = "shininess",
                        .label = "Sharpness",
                        .min = 1,
                        .max = 1000,
                        .softMax = 300,
                        .tip = "High: a narrow shine. Low: a broad one.",
                        .logarithmic = true},
              self.shininess);
        visit(ParamInfo{.id = "shadows",
                        .label = "Shadows",
                        .tip = "How hair shades the hair below it.",
                        .choices = shadowNames},
              self.shadows);
        visit(ParamInfo{.id = "shadow_alpha",
                        .label = "Light let through",
                        .min = 0.01,
                        .max = 1,
                        .unit = "%",
                        .shownScale = 100,
                        .tip = "Light that one layer of hair lets through."},
              self.shadowAlpha);
        visit(ParamInfo{.id = "light_azimuth",
                        .label = "Light around",
                        .min = -3.14159265,
                        .max = 3.14159265,
                        .unit = "°",
                        .shownScale = 57.29577951,
                        .tip = "Direction of the light: round the model."},
              self.lightAzimuth);
        visit(ParamInfo{.id = "light_elevation",
                        .label = "Light height",
                        .min = -1.57079633,
                        .max = 1.57079633,
                        .unit = "°",
                        .shownScale = 57.29577951,
                        .tip = "Direction of the light: up and down."},
              self.lightElevation);
        visit(ParamInfo{.id = "light_follows_camera",
                        .label = "Light follows the view",
                        .tip = "The light turns with the view. Off: it stays with the model."},
              self.lightFollowsCamera);
        visit(ParamInfo{.id = "ambient", .label = "Ambient", .max = 2, .softMax = 1, .tip = "Light from everywhere."},
              self.ambient);
        visit(ParamInfo{.id = "exposure",
                        .label = "Exposure",
                        .min = 0.05,
                        .max = 20,
                        .softMax = 4,
                        .tip = "Brightness of the whole picture.",
                        .logarithmic = true},
              self.exposure);
        visit(ParamInfo{.id = "background", .label = "Background", .tip = "Colour behind the model."}, self.background);
        visit(ParamInfo{.id = "samples",
                        .label = "Smoothing",
                        .min = 1,
                        .max = 4,
                        .tip = "Samples a pixel. More are smoother and slower."},
              self.samples);
        visit(ParamInfo{.id = "min_pixel_width",
                        .label = "Thinnest hair",
                        .min = 0.25,
                        .max = 4,
                        .unit = "px",
                        .tip = "Thinner hair is drawn this wide and more transparent."},
              self.minPixelWidth);
    }
    ViewSettings settings() const;
    /// Texels a side of hair texture; 0 while none is shown.
    int licSize() const;
    bool operator==(const ViewOptions&) const = default;
};

}  // namespace whorl
