// SPDX-License-Identifier: Apache-2.0
// The dark and the light look of the program.
#pragma once

class QApplication;

namespace whorl {

enum class Theme { Dark, Light };

/// Fusion with our own palette. May be called again while windows are open.
void applyTheme(QApplication& application, Theme theme);

}  // namespace whorl
