// SPDX-License-Identifier: Apache-2.0
// Icons drawn as vectors in the colour of the text, so that they fit every theme and resolution.
#pragma once

#include <QIcon>
#include <QString>

namespace whorl {

/// The icon of a brush id or of an action's icon name; for an unknown name its first letter in a circle.
QIcon icon(const QString& name);
/// The program's own icon: a whorl of hair.
QIcon programIcon();

}  // namespace whorl
