// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"

#include <array>

namespace whorl {

std::span<const BrushInfo> brushes() {
    static const std::array list{
        BrushInfo{.id = "comb",
                  .label = "Comb",
                  .shortcut = "C",
                  .tip = "Moves the guides under the brush with the pointer; the hair beyond follows. Lengths stay.",
                  .undoText = "Comb guides",
                  .spacing = 0.04f,
                  .make = makeComb},
        BrushInfo{.id = "scissors",
                  .label = "Scissors",
                  .shortcut = "K",
                  .tip = "Cuts guides where they enter the brush. With Ctrl they grow instead.",
                  .undoText = "Cut guides",
                  .spacing = 0.1f,
                  .make = makeScissors},
        BrushInfo{.id = "grow",
                  .label = "Grow",
                  .shortcut = "G",
                  .tip = "Lengthens the guides under the brush. With Ctrl it shortens them.",
                  .undoText = "Grow guides",
                  .spacing = 0.1f,
                  .make = makeGrow},
        BrushInfo{.id = "smooth",
                  .label = "Smooth",
                  .shortcut = "S",
                  .tip = "Straightens bends of the guides under the brush. Lengths stay.",
                  .undoText = "Smooth guides",
                  .spacing = 0.1f,
                  .make = makeSmooth},
        BrushInfo{.id = "puff",
                  .label = "Puff",
                  .shortcut = "U",
                  .tip = "Stands guides up along the skin's normal. With Ctrl it lays them flat.",
                  .undoText = "Puff guides",
                  .spacing = 0.1f,
                  .make = makePuff},
        BrushInfo{.id = "place",
                  .label = "Place guides",
                  .shortcut = "I",
                  .tip = "Adds guides a brush radius apart, shaped like their neighbours. With Ctrl it deletes them.",
                  .undoText = "Place guides",
                  .spacing = 0.1f,
                  .make = makePlace},
        BrushInfo{.id = "delete",
                  .label = "Delete guides",
                  .shortcut = "D",
                  .tip = "Deletes the guides whose roots are under the brush.",
                  .undoText = "Delete guides",
                  .spacing = 0.1f,
                  .make = makeDelete},
        BrushInfo{.id = "parting",
                  .label = "Parting",
                  .shortcut = "L",
                  .tip = "Draws a line on the skin that no hair crosses. With Ctrl it erases the lines that it meets.",
                  .undoText = "Draw parting",
                  .spacing = 0.1f,
                  .make = makeParting},
        BrushInfo{.id = "sketch",
                  .label = "Sketch",
                  .shortcut = "H",
                  .tip = "Draws a stroke on the skin along which hair lies. With Ctrl it erases strokes.",
                  .undoText = "Draw stroke",
                  .drawsStrokes = true,
                  .spacing = 0.1f,
                  .make = makeSketch},
        BrushInfo{.id = "attract",
                  .label = "Attract",
                  .shortcut = "Y",
                  .tip = "Hair within the brush points to where you click or draw. With Ctrl it erases strokes.",
                  .undoText = "Attract hair",
                  .drawsStrokes = true,
                  .spacing = 0.1f,
                  .make = makeAttract},
        BrushInfo{.id = "repel",
                  .label = "Repel",
                  .shortcut = "R",
                  .tip = "Hair within the brush points away from where you click or draw. With Ctrl it erases strokes.",
                  .undoText = "Repel hair",
                  .drawsStrokes = true,
                  .spacing = 0.1f,
                  .make = makeRepel},
        BrushInfo{.id = "whorl",
                  .label = "Whorl",
                  .shortcut = "W",
                  .tip = "Hair within the brush turns around the place where you let go. With Ctrl it erases strokes.",
                  .undoText = "Draw whorl",
                  .drawsStrokes = true,
                  .spacing = 0.1f,
                  .make = makeWhorl},
        BrushInfo{.id = "move_stroke",
                  .label = "Move stroke",
                  .shortcut = "M",
                  .tip = "Picks the nearest stroke and carries it over the skin. With Ctrl it carries a copy.",
                  .undoText = "Move stroke",
                  .drawsStrokes = true,
                  .spacing = 0.05f,
                  .make = makeMoveStroke},
        BrushInfo{.id = "align_strokes",
                  .label = "Align strokes",
                  .shortcut = "N",
                  .tip = "Turns the strokes under the brush towards each other and smooths them.",
                  .undoText = "Align strokes",
                  .drawsStrokes = true,
                  .spacing = 0.1f,
                  .make = makeAlignStrokes},
        BrushInfo{.id = "paint",
                  .label = "Paint",
                  .shortcut = "P",
                  .tip = "Paints the chosen map on the model. With Ctrl it erases.",
                  .undoText = "Paint map",
                  .paintsMap = true,
                  .spacing = 0.15f,
                  .make = makePaint},
        BrushInfo{.id = "group",
                  .label = "Paint group",
                  .shortcut = "J",
                  .tip = "Paints where the chosen group grows. With Ctrl it paints the first group.",
                  .undoText = "Paint group",
                  .paintsMap = true,
                  .paintsGroups = true,
                  .spacing = 0.15f,
                  .make = makeGroup},
    };
    return list;
}

const BrushInfo* findBrush(std::string_view id) {
    for (const BrushInfo& info : brushes()) {
        if (info.id == id) return &info;
    }
    return nullptr;
}

float brushFalloff(float distance) {
    if (!(distance < 1.0f)) return 0.0f;
    const float t = 1.0f - distance * distance;
    return t * t;
}

Result<void> Brush::begin(const Groom&, const BrushSettings&) {
    return {};
}
void Brush::end(Groom&, const Surface&, const BrushSettings&) {}

}  // namespace whorl
