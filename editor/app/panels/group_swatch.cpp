// SPDX-License-Identifier: Apache-2.0
#include "editor/app/panels/group_swatch.h"

#include "core/model/map.h"
#include "render/view_settings.h"

#include <QPainter>
#include <QPixmap>
#include <cmath>

namespace whorl {

QRgb groupRgb(int group) {
    const glm::vec3 colour = groupColour(group);
    const auto byte = [](float linear) { return static_cast<int>(std::lround(srgbFromLinear(linear) * 255.0f)); };
    return qRgb(byte(colour.x), byte(colour.y), byte(colour.z));
}

QIcon groupSwatch(int group) {
    // The dark edge keeps it apart from any background.
    QPixmap pixmap(14, 14);
    pixmap.fill(QColor(0x16, 0x17, 0x19));
    QPainter(&pixmap).fillRect(1, 1, 12, 12, QColor(groupRgb(group)));
    QIcon icon(pixmap);
    icon.addPixmap(pixmap, QIcon::Selected);
    return icon;
}

}  // namespace whorl
