// SPDX-License-Identifier: Apache-2.0
// Commands of scripts that draw: pictures of the groom, and sheets that compare parameters.
#pragma once

#include "core/commands/command.h"

#include <vector>

namespace whorl::cli {

/// camera, render, time, row, frame, compare, sheet. They share a camera and a sheet, and hold an OpenGL context from
/// the first picture on; use them in one thread.
std::vector<Command> pictureCommands();

}  // namespace whorl::cli
