// SPDX-License-Identifier: Apache-2.0
// The brushes' makers, one a source file; brushes.cpp names them in the order of the toolbar.
#pragma once

#include "core/brushes/brush.h"

#include <memory>

namespace whorl {

std::unique_ptr<Brush> makeComb();
std::unique_ptr<Brush> makeScissors();
std::unique_ptr<Brush> makeGrow();
std::unique_ptr<Brush> makeSmooth();
std::unique_ptr<Brush> makePuff();
std::unique_ptr<Brush> makePlace();
std::unique_ptr<Brush> makeDelete();
std::unique_ptr<Brush> makeParting();
std::unique_ptr<Brush> makeSketch();
std::unique_ptr<Brush> makeAttract();
std::unique_ptr<Brush> makeRepel();
std::unique_ptr<Brush> makeWhorl();
std::unique_ptr<Brush> makeMoveStroke();
std::unique_ptr<Brush> makeAlignStrokes();
std::unique_ptr<Brush> makePaint();
std::unique_ptr<Brush> makeGroup();

}  // namespace whorl
