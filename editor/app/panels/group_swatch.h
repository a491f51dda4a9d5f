// SPDX-License-Identifier: Apache-2.0
// The colour of a group as the model shows it while groups are painted.
#pragma once

#include <QIcon>
#include <QRgb>

namespace whorl {

QRgb groupRgb(int group);
QIcon groupSwatch(int group);

}  // namespace whorl
