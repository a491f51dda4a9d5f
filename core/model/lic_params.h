// SPDX-License-Identifier: Apache-2.0
// Parameters of the direction field and of hair texture, for the whole groom (see core/param/param.h).
#pragma once

#include "core/param/param.h"

#include <array>
#include <string_view>

// Source: seed 002 (Mao et al., "Automatic Generation of Hair Texture with Line Integral Convolution"), sections 3 and
// 4, figure 7: share of white, streamline length, grain. Lengths in metres.

namespace whorl {

/// How directions spread over the skin from the strokes that were drawn.
struct FieldParams {
    float reach = 0.0f;
    Vector gravity{{0.0f, -1.0f, 0.0f}};
    float partingWidth = 0.02f;
    float lift = 0.25f;
    Driven length{0.06f};
    float bend = 0.0f;
    bool follow = false;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "reach",
                        .label = "Reach",
                        .max = 1000,
                        .softMax = 0.5,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far from a stroke hair still follows it before it hangs as gravity has it. Zero: "
                               "strokes decide everywhere."},
              self.reach);
        visit(ParamInfo{.id = "gravity",
                        .label = "Hangs towards",
                        .min = -1,
                        .tip = "Where hair without strokes hangs to; y is up."},
              self.gravity);
        visit(ParamInfo{.id = "parting_width",
                        .label = "Parting width",
                        .max = 100,
                        .softMax = 0.1,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far from a parting hair without strokes still falls away from it."},
              self.partingWidth);
        visit(ParamInfo{.id = "lift",
                        .label = "Lift",
                        .tip = "How guides grown along the field leave the skin: 0 flat, 1 straight up."},
              self.lift);
        visit(ParamInfo{.id = "length",
                        .label = "Grown length",
                        .max = 100,
                        .softMax = 0.5,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Length of guides grown along the field. Zero keeps the length they have."},
              self.length);
        visit(ParamInfo{.id = "bend",
                        .label = "Gravity bend",
                        .max = 10,
                        .softMax = 1,
                        .tip = "How much gravity bends the tips of guides grown along the field."},
              self.bend);
        visit(ParamInfo{.id = "follow",
                        .label = "Combing leads",
                        .tip = "Directions come from the guides as they are combed instead of from strokes."},
              self.follow);
    }
    bool operator==(const FieldParams&) const = default;
};

inline constexpr std::array<std::string_view, 2> licKernelNames{"Soft", "Box"};

/// Hair painted on the skin by line integral convolution: texture, colour and light. Colours of the hair are those of
/// its groups.
struct LicParams {
    Driven length{0.015f};
    Driven grain{0.0006f};
    float white = 0.5f;
    float contrast = 0.6f;
    Choice kernel{};
    int seed = 1;
    Driven opacity{1.0f};
    float border = 0.006f;
    float colourPlace = 0.5f;
    float ambient = 0.35f;
    float diffuse = 0.65f;
    float specular = 0.35f;
    float shininess = 40.0f;
    float tilt = 0.08f;
    float height = 0.002f;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "length",
                        .label = "Length",
                        .max = 1,
                        .softMax = 0.05,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far a drawn hair runs each way. Short reads as stubble, long as long hair."},
              self.length);
        visit(ParamInfo{.id = "grain",
                        .label = "Grain",
                        .min = 0.00001,
                        .max = 1,
                        .softMax = 0.005,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Width of a drawn hair. Coarse reads as wisps."},
              self.grain);
        visit(ParamInfo{.id = "white",
                        .label = "Share of white",
                        .tip = "How many hairs are light: from dark hair with few light ones to light hair with few "
                               "dark ones."},
              self.white);
        visit(ParamInfo{.id = "contrast",
                        .label = "Contrast",
                        .tip = "How different light and dark hairs are. Zero: one colour."},
              self.contrast);
        visit(ParamInfo{.id = "kernel",
                        .label = "Kernel",
                        .tip = "How brightness fades along a drawn hair. Soft: towards both ends. Box: not at all.",
                        .choices = licKernelNames},
              self.kernel);
        visit(ParamInfo{.id = "seed",
                        .label = "Seed",
                        .min = 0,
                        .max = 2147483647,
                        .softMax = 1000,
                        .tip = "Another seed gives other hairs."},
              self.seed);
        visit(ParamInfo{.id = "opacity", .label = "Opacity", .tip = "How much the texture covers the skin."},
              self.opacity);
        visit(ParamInfo{.id = "border",
                        .label = "Soft border",
                        .max = 100,
                        .softMax = 0.03,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Over how much skin single hairs thin out at the edge of the growing area."},
              self.border);
        visit(ParamInfo{.id = "colour_place",
                        .label = "Colour from",
                        .tip = "Which colour of the hair is painted: 0 that of its root, 1 that of its tip."},
              self.colourPlace);
        visit(ParamInfo{.id = "ambient", .label = "Ambient", .max = 4, .softMax = 1, .tip = "Light from everywhere."},
              self.ambient);
        visit(ParamInfo{.id = "diffuse",
                        .label = "Diffuse",
                        .max = 4,
                        .softMax = 1,
                        .tip = "Light that falls across the hair and scatters."},
              self.diffuse);
        visit(ParamInfo{.id = "specular",
                        .label = "Highlight",
                        .max = 4,
                        .softMax = 1,
                        .tip = "Strength of the halo, the band of gloss across the hair."},
              self.specular);
        visit(ParamInfo{.id = "shininess",
                        .label = "Shininess",
                        .min = 1,
                        .max = 1000,
                        .softMax = 200,
                        .tip = "How narrow the halo is."},
              self.shininess);
        visit(ParamInfo{.id = "tilt",
                        .label = "Halo shift",
                        .min = -1,
                        .softMax = 0.3,
                        .tip = "Moves the halo along the hair; light and dark hairs scatter around it."},
              self.tilt);
        visit(ParamInfo{.id = "height",
                        .label = "Height",
                        .max = 1,
                        .softMax = 0.02,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Height of the light hairs above the dark ones in the baked height map."},
              self.height);
    }
    bool operator==(const LicParams&) const = default;
};

}  // namespace whorl
