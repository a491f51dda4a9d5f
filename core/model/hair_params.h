// SPDX-License-Identifier: Apache-2.0
// The parameters of the groom and of its groups, each declared once (see core/param/param.h).
#pragma once

#include "core/model/modifier.h"
#include "core/model/strand_params.h"
#include "core/param/param.h"

#include <array>
#include <string_view>

// Sources: HAIR table of seed 000 (Sik, "Fast Random Sampling of Triangular Meshes for Hair Modeling", section 4).
// Lengths in metres, angles in radians, colours linear.

namespace whorl {

/// How many of everything, for the whole groom.
struct CountParams {
    int guides = 100;
    int hairs = 10000;
    int shownHairs = 10000;
    int parts = 1;
    int seed = 1;
    MapName groupMap{};
    float densityTotal = 0.0f;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "guides",
                        .label = "Guides",
                        .min = 3,
                        .max = 1e6,
                        .softMax = 5000,
                        .tip = "Guides that Place Guides spreads over the growing parts.",
                        .logarithmic = true},
              self.guides);
        visit(ParamInfo{.id = "hairs",
                        .label = "Hairs",
                        .min = 0,
                        .max = 1e7,
                        .softMax = 1e6,
                        .tip = "Hairs made when the groom is rendered or exported.",
                        .logarithmic = true},
              self.hairs);
        visit(ParamInfo{.id = "shown_hairs",
                        .label = "Shown hairs",
                        .min = 0,
                        .max = 1e7,
                        .softMax = 2e5,
                        .tip = "Hairs drawn in the viewport. Fewer is faster.",
                        .logarithmic = true},
              self.shownHairs);
        visit(
            ParamInfo{.id = "parts",
                      .label = "Parts",
                      .min = 1,
                      .max = 4096,
                      .softMax = 64,
                      .tip = "Pieces of a package. A renderer makes them on different threads; the hair is the same."},
            self.parts);
        visit(ParamInfo{.id = "seed",
                        .label = "Seed",
                        .min = 0,
                        .max = 2147483647,
                        .softMax = 1000,
                        .tip = "Another seed gives other random roots and noise."},
              self.seed);
        visit(ParamInfo{.id = "group_map",
                        .label = "Group map",
                        .tip = "Map that picks the group of each root: its value times 255 is the group's number."},
              self.groupMap);
        visit(
            ParamInfo{.id = "density_total",
                      .label = "Density as counted",
                      .max = 1e9,
                      .tip = "Average density of the surface that the number of hairs stands for. Painting sets it, so "
                             "that paint adds and removes hair only under the brush. Zero: the average of today.",
                      .kept = true},
            self.densityTotal);
    }
    bool operator==(const CountParams&) const = default;
};

inline constexpr std::array<std::string_view, 2> interpolationNames{"Rotated to the surface", "As they are"};

inline constexpr std::array<std::string_view, 2> guidesFromNames{"Nearest guides", "Triangle of guides"};

/// Where hairs grow, how they follow the guides, how long and thick they are.
struct GeneralParams {
    int segments = 15;
    Driven density{1.0f};
    bool even = false;
    int samples = 3;
    Choice interpolation{};
    Choice guidesFrom{};
    Driven cut{1.0f};
    Driven scale{1.0f};
    Driven randomScale{0.0f};
    Driven rootThickness{0.00009f};
    Driven tipThickness{0.00003f};
    Driven displacement{0.0f};
    bool keepOutside = true;
    float skipThreshold = 0.0f;
    bool writeNormals = true;

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "segments",
                        .label = "Segments",
                        .min = 1,
                        .max = 100,
                        .softMax = 40,
                        .tip = "Pieces of each guide and hair of this group. Changing it resamples the guides."},
              self.segments);
        visit(ParamInfo{.id = "density",
                        .label = "Density",
                        .max = 100,
                        .softMax = 1,
                        .tip = "How many hairs grow here compared with elsewhere. Zero grows nothing."},
              self.density);
        visit(
            ParamInfo{.id = "even",
                      .label = "Even spacing",
                      .tip = "Keeps hairs apart from each other: no clumps and gaps, as in short fur. Takes longer the "
                             "first time."},
            self.even);
        visit(ParamInfo{.id = "samples",
                        .label = "Guides a hair",
                        .min = 1,
                        .max = 20,
                        .tip = "Nearest guides that shape a hair. Few keep locks apart, many make it smooth."},
              self.samples);
        visit(ParamInfo{.id = "interpolation",
                        .label = "Guide shapes",
                        .tip = "Rotated: guide shapes turn with the skin between guide and hair. As they are: no turn.",
                        .choices = interpolationNames},
              self.interpolation);
        visit(ParamInfo{.id = "guides_from",
                        .label = "Guides from",
                        .tip = "Nearest: a mix of the guides around. Triangle: the three guides that a hair stands "
                               "between.",
                        .choices = guidesFromNames},
              self.guidesFrom);
        visit(ParamInfo{.id = "cut", .label = "Cut", .tip = "Where along itself a hair ends. Zero: no hair."},
              self.cut);
        visit(
            ParamInfo{
                .id = "scale", .label = "Length", .max = 100, .softMax = 2, .tip = "Length compared with the guides."},
            self.scale);
        visit(ParamInfo{.id = "random_scale",
                        .label = "Random length",
                        .tip = "Shortens each hair by a random share up to this."},
              self.randomScale);
        visit(ParamInfo{.id = "root_thickness",
                        .label = "Root thickness",
                        .max = 0.1,
                        .softMax = 0.001,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Width at the root."},
              self.rootThickness);
        visit(ParamInfo{.id = "tip_thickness",
                        .label = "Tip thickness",
                        .max = 0.1,
                        .softMax = 0.001,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Width at the tip."},
              self.tipThickness);
        visit(ParamInfo{.id = "displacement",
                        .label = "Displacement",
                        .min = -1,
                        .max = 1,
                        .softMax = 0.01,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "Lifts roots along the skin's normal."},
              self.displacement);
        visit(ParamInfo{.id = "keep_outside",
                        .label = "Keep outside the skin",
                        .tip = "Pushes hair that dips into the mesh back out."},
              self.keepOutside);
        visit(ParamInfo{.id = "skip_threshold",
                        .label = "Skip threshold",
                        .softMax = 0.1,
                        .tip = "Leaves out vertices where hair is straight: those that are nearer to the straight line "
                               "than this share of its length."},
              self.skipThreshold);
        visit(ParamInfo{.id = "write_normals",
                        .label = "Write normals",
                        .tip = "Exported files hold the curves' normals. Without them files are smaller."},
              self.writeNormals);
    }
    bool fromTriangle() const { return guidesFrom.index == 1; }
    bool operator==(const GeneralParams&) const = default;
};

/// Colour and opacity from root to tip, and how hairs differ.
struct ColourParams {
    DrivenColour root{{0.045f, 0.022f, 0.010f}};
    DrivenColour tip{{0.20f, 0.105f, 0.045f}};
    Driven rootOpacity{1.0f};
    Driven tipOpacity{1.0f};
    Driven hueVariation{0.0f};
    Driven valueVariation{0.0f};
    Colour mutant{{0.5f, 0.5f, 0.5f}};
    Driven mutants{0.0f};

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "root", .label = "Root colour", .tip = "Colour at the root."}, self.root);
        visit(ParamInfo{.id = "tip", .label = "Tip colour", .tip = "Colour at the tip."}, self.tip);
        visit(ParamInfo{.id = "root_opacity", .label = "Root opacity", .tip = "Opacity at the root."},
              self.rootOpacity);
        visit(ParamInfo{.id = "tip_opacity", .label = "Tip opacity", .tip = "Opacity at the tip."}, self.tipOpacity);
        visit(ParamInfo{.id = "hue_variation",
                        .label = "Hue variation",
                        .max = 3.14159265,
                        .unit = "degrees",
                        .shownScale = 57.29577951,
                        .tip = "Turns each hair's hue at random by up to this."},
              self.hueVariation);
        visit(ParamInfo{.id = "value_variation",
                        .label = "Brightness variation",
                        .tip = "Makes each hair brighter or darker at random by up to this share."},
              self.valueVariation);
        visit(
            ParamInfo{
                .id = "mutant", .label = "Odd hairs' colour", .tip = "Colour of the odd hairs, for grey strands."},
            self.mutant);
        visit(ParamInfo{.id = "mutants",
                        .label = "Odd hairs",
                        .unit = "%",
                        .shownScale = 100,
                        .tip = "Share of hairs with the odd colour."},
              self.mutants);
    }
    bool operator==(const ColourParams&) const = default;
};

/// One noise vector a hair, weighted from root to tip: whole hairs stray from their neighbours.
struct FrizzParams {
    Driven root{0.0f};
    Driven tip{0.0f};
    DrivenVector frequency{{40.0f, 40.0f, 40.0f}};
    Driven animation{0.0f};
    Driven speed{1.0f};
    Vector direction{{0.0f, 1.0f, 0.0f}};

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "root",
                        .label = "Root amount",
                        .max = 1,
                        .softMax = 0.02,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far frizz moves the root end."},
              self.root);
        visit(ParamInfo{.id = "tip",
                        .label = "Tip amount",
                        .max = 1,
                        .softMax = 0.05,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far frizz moves the tip."},
              self.tip);
        visit(ParamInfo{.id = "frequency",
                        .label = "Frequency",
                        .max = 100000,
                        .softMax = 2000,
                        .unit = "per metre",
                        .tip = "Noise waves a metre along x, y, z. High: every hair strays its own way."},
              self.frequency);
        visit(ParamInfo{.id = "animation",
                        .label = "Animation",
                        .max = 10,
                        .softMax = 1,
                        .tip = "How much of the frizz moves with time. At time 0 nothing has moved."},
              self.animation);
        visit(ParamInfo{.id = "speed",
                        .label = "Speed",
                        .max = 1000,
                        .softMax = 10,
                        .unit = "waves per second",
                        .tip = "How fast the noise passes."},
              self.speed);
        visit(ParamInfo{.id = "direction", .label = "Direction", .min = -1, .tip = "Where the noise goes; y is up."},
              self.direction);
    }
    bool operator==(const FrizzParams&) const = default;
};

/// A noise vector at every vertex: hairs get wavy and crinkled.
struct KinkParams {
    Driven root{0.0f};
    Driven tip{0.0f};
    DrivenVector frequency{{200.0f, 200.0f, 200.0f}};

    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(ParamInfo{.id = "root",
                        .label = "Root amount",
                        .max = 1,
                        .softMax = 0.01,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far kink moves vertices near the root."},
              self.root);
        visit(ParamInfo{.id = "tip",
                        .label = "Tip amount",
                        .max = 1,
                        .softMax = 0.02,
                        .unit = "mm",
                        .shownScale = 1000,
                        .tip = "How far kink moves vertices near the tip."},
              self.tip);
        visit(ParamInfo{.id = "frequency",
                        .label = "Frequency",
                        .max = 100000,
                        .softMax = 2000,
                        .unit = "per metre",
                        .tip = "Noise waves a metre along x, y, z at the rest position."},
              self.frequency);
    }
    bool operator==(const KinkParams&) const = default;
};

/// Everything that shapes the hairs of one group.
struct HairParams {
    GeneralParams general{};
    ColourParams colour{};
    FrizzParams frizz{};
    KinkParams kink{};
    StrandParams strands{};
    std::vector<Modifier> modifiers{};  ///< in the order in which they work

    /// The blocks that every group has.
    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit(BlockInfo{"general", "General", "Where hair grows, how it follows the guides, length and width."},
              self.general);
        visit(BlockInfo{"colour", "Colour", "Colour and opacity from root to tip."}, self.colour);
        visit(BlockInfo{"frizz", "Frizz", "One random push a hair: flyaways and fullness."}, self.frizz);
        visit(BlockInfo{"kink", "Kink", "A random push at every vertex: waves and crinkle."}, self.kink);
        visit(BlockInfo{"strands", "Strands", "Several hairs around each one: wisps, tufts and wool."}, self.strands);
    }
    /// Those and every modifier, whose block has the id "modifiers/NAME" (good during the call).
    template <class Self, class Visit>
    static void eachWithModifiers(Self& self, Visit&& visit) {
        each(self, visit);
        for (auto& modifier : self.modifiers) {
            const std::string id = "modifiers/" + modifier.name;
            visit(BlockInfo{id, modifier.name, modifierKinds()[modifier.kind()].tip}, modifier);
        }
    }
    bool operator==(const HairParams&) const = default;
};

}  // namespace whorl
