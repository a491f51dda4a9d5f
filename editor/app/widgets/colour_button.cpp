// SPDX-License-Identifier: Apache-2.0
#include "editor/app/widgets/colour_button.h"

#include "core/model/map.h"

#include <QColorDialog>
#include <QPainter>
#include <algorithm>

namespace whorl {

QColor shownColour(const glm::vec3& linear) {
    const auto channel = [](float value) { return std::clamp(srgbFromLinear(std::max(value, 0.0f)), 0.0f, 1.0f); };
    return QColor::fromRgbF(channel(linear.x), channel(linear.y), channel(linear.z));
}

glm::vec3 linearColour(const QColor& shown) {
    return {linearFromSrgb(static_cast<float>(shown.redF())), linearFromSrgb(static_cast<float>(shown.greenF())),
            linearFromSrgb(static_cast<float>(shown.blueF()))};
}

ColourButton::ColourButton(const QString& title, QWidget* parent) : QToolButton(parent), m_title(title) {
    setMinimumSize(48, 24);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(this, &QToolButton::clicked, this, &ColourButton::choose);
}

void ColourButton::setColour(const glm::vec3& linear) {
    m_colour = linear;
    update();
}

void ColourButton::choose() {
    QColorDialog dialog(shownColour(m_colour), window());
    dialog.setObjectName("colour_dialog");
    dialog.setWindowTitle(m_title);
    dialog.setOption(QColorDialog::DontUseNativeDialog);
    const glm::vec3 before = m_colour;
    connect(&dialog, &QColorDialog::currentColorChanged, this, [this](const QColor& shown) {
        setColour(linearColour(shown));
        Q_EMIT edited(m_colour, true);
    });
    if (dialog.exec() == QDialog::Accepted) {
        setColour(linearColour(dialog.currentColor()));
        Q_EMIT edited(m_colour, false);
    } else {
        setColour(before);
        Q_EMIT dropped();
    }
}

void ColourButton::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(hasFocus() || underMouse() ? palette().highlight() : palette().mid(), hasFocus() ? 2 : 1));
    painter.setBrush(isEnabled() ? QBrush(shownColour(m_colour)) : palette().mid());
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
}

}  // namespace whorl
