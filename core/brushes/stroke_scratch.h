// SPDX-License-Identifier: Apache-2.0
// What one stroke remembers between steps, for its brush and the brush's mirror image.
#pragma once

#include "core/brushes/brush_index.h"
#include "core/brushes/paint_canvas.h"

#include <memory>

namespace whorl {

struct StrokeScratch {
    BrushIndex guides;
    std::unique_ptr<PaintCanvas> canvas;  ///< made by paint brushes at their first step
};

}  // namespace whorl
