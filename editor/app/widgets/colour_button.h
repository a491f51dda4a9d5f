// SPDX-License-Identifier: Apache-2.0
// A button that shows a linear colour and lets the artist pick another.
#pragma once

#include <glm/vec3.hpp>

#include <QColor>
#include <QToolButton>

namespace whorl {

/// The screen's colour for a linear one, and back.
QColor shownColour(const glm::vec3& linear);
glm::vec3 linearColour(const QColor& shown);

class ColourButton : public QToolButton {
    Q_OBJECT

public:
    explicit ColourButton(const QString& title, QWidget* parent = nullptr);

    const glm::vec3& colour() const { return m_colour; }
    void setColour(const glm::vec3& linear);

Q_SIGNALS:
    /// `choosing`: the dialog is still open.
    void edited(const glm::vec3& linear, bool choosing);
    void dropped();

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void choose();

    QString m_title;
    glm::vec3 m_colour{0.0f};
};

}  // namespace whorl
