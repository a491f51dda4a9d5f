// SPDX-License-Identifier: Apache-2.0
// The events of the viewport: pointer, pen, wheel, keys.
#include "editor/app/viewport/viewport.h"
#include "editor/app/widgets/param_source.h"

#include <glm/geometric.hpp>

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QTabletEvent>
#include <utility>

namespace whorl {
namespace {

/// A pointer that moves less between press and release clicks; pixels.
constexpr float clickSlack = 4.0f;

glm::vec2 pixelOf(const QPointF& position) {
    return {static_cast<float>(position.x()), static_cast<float>(position.y())};
}

}  // namespace

void Viewport::press(glm::vec2 pixel, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, float pressure) {
    m_pixel = pixel;
    setModifiers(modifiers);
    if (m_adjust.active()) {
        m_adjust.keep();
        update();
        return;
    }
    if (m_stroke.active() || m_navigation.active() || !m_document.hasGroom()) return;
    const Navigation::Mode mode = Navigation::modeFor(m_state.navigation(), button, modifiers, !m_state.brush());
    if (mode != Navigation::Mode::None) {
        m_navigation.begin(mode, pixel);
        const bool plain = button == Qt::LeftButton && modifiers == Qt::NoModifier;
        m_click = plain && !m_state.brush() ? std::optional(pixel) : std::nullopt;
        return;
    }
    if (button != Qt::LeftButton) return;
    const StrokeView view = m_camera.strokeView(sizePixels(), sceneBounds());
    const Result<void> begun = m_stroke.begin(view, {pixel, pressure}, modifiers);
    if (!begun) Q_EMIT said(QString::fromStdString(begun.error().message));
}

void Viewport::move(glm::vec2 pixel, Qt::KeyboardModifiers modifiers, float pressure) {
    m_pixel = pixel;
    m_inside = true;
    setModifiers(modifiers);
    if (m_click && glm::distance(*m_click, pixel) > clickSlack) m_click.reset();
    if (m_adjust.active()) {
        m_adjust.move(pixel);
    } else if (m_navigation.active()) {
        if (m_navigation.move(m_camera, pixel, sizePixels())) interacted();
    } else if (m_stroke.active()) {
        m_stroke.move({pixel, pressure});
    }
    if (m_state.brush() && !m_frame.isActive()) update();
}

void Viewport::release() {
    if (m_navigation.active()) {
        m_navigation.end();
        interacted();
        if (const auto place = std::exchange(m_click, std::nullopt)) pick(*place);
    }
    if (m_stroke.active()) {
        m_stroke.finish();
        interacted();
    }
}

bool Viewport::dropAll() {
    const bool any = m_adjust.active() || m_stroke.active() || m_navigation.active();
    m_click.reset();
    m_adjust.drop();
    m_stroke.drop();
    m_navigation.end();
    if (any) interacted();
    return any;
}

void Viewport::mousePressEvent(QMouseEvent* event) {
    press(pixelOf(event->position()), event->button(), event->modifiers(), 1.0f);
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
    move(pixelOf(event->position()), event->modifiers(), 1.0f);
}

void Viewport::mouseReleaseEvent(QMouseEvent*) {
    release();
}

void Viewport::wheelEvent(QWheelEvent* event) {
    if (!m_document.hasGroom() || m_stroke.active()) return;
    m_camera.zoom(Navigation::wheelFactor(event->angleDelta().y()));
    event->accept();
    interacted();
}

void Viewport::tabletEvent(QTabletEvent* event) {
    const glm::vec2 pixel = pixelOf(event->position());
    const float pressure = static_cast<float>(event->pressure());
    switch (event->type()) {
        case QEvent::TabletPress:
            setFocus(Qt::MouseFocusReason);
            press(pixel, event->button(), event->modifiers(), pressure);
            break;
        case QEvent::TabletMove:
            move(pixel, event->modifiers(), pressure);
            break;
        case QEvent::TabletRelease:
            release();
            break;
        default:
            break;
    }
    // Accepted: Qt would otherwise send the same as a mouse, and the pressure would be lost.
    event->accept();
}

bool Viewport::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        const auto* key = static_cast<QKeyEvent*>(event);
        // Keys that mean something only here, or only now, come before the program's shortcuts.
        const bool busy = m_stroke.active() || m_adjust.active() || m_navigation.active();
        const bool size = (key->key() == Qt::Key_F || key->key() == Qt::Key_B) &&
                          !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
        if (size || (busy && key->key() == Qt::Key_Escape)) {
            event->accept();
            return true;
        }
    }
    return QOpenGLWidget::event(event);
}

void Viewport::keyPressEvent(QKeyEvent* event) {
    setModifiers(event->modifiers());
    const bool plain = !(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
    if (event->key() == Qt::Key_Escape && dropAll()) return;
    if (plain && (event->key() == Qt::Key_F || event->key() == Qt::Key_B)) {
        if (event->isAutoRepeat()) return;
        if (!m_state.brush()) {
            if (event->key() == Qt::Key_F) frameHair();
            return;
        }
        if (m_stroke.active() || m_navigation.active()) return;
        const bool strength = event->key() == Qt::Key_F && event->modifiers().testFlag(Qt::ShiftModifier);
        m_adjust.begin(strength ? BrushAdjust::What::Strength : BrushAdjust::What::Size, m_pixel);
        Q_EMIT hintChanged(hint());
        update();
        return;
    }
    QOpenGLWidget::keyPressEvent(event);
}

void Viewport::keyReleaseEvent(QKeyEvent* event) {
    setModifiers(event->modifiers());
    if (!event->isAutoRepeat() && (event->key() == Qt::Key_F || event->key() == Qt::Key_B)) {
        m_adjust.keyReleased();
        Q_EMIT hintChanged(hint());
        update();
        return;
    }
    QOpenGLWidget::keyReleaseEvent(event);
}

void Viewport::enterEvent(QEnterEvent* event) {
    m_inside = true;
    m_pixel = pixelOf(event->position());
    update();
}

void Viewport::leaveEvent(QEvent*) {
    m_inside = false;
    update();
}

void Viewport::focusOutEvent(QFocusEvent* event) {
    // The release of a held key goes to whoever has the focus now.
    m_adjust.keep();
    setModifiers({});
    QOpenGLWidget::focusOutEvent(event);
}

void Viewport::setModifiers(Qt::KeyboardModifiers modifiers) {
    if (m_modifiers == modifiers) return;
    m_modifiers = modifiers;
    Q_EMIT hintChanged(hint());
}

QString Viewport::hint() const {
    if (m_adjust.active()) {
        return m_adjust.what() == BrushAdjust::What::Size ? tr("Move: brush size. Click: keep. Escape: as before.")
                                                          : tr("Move: brush strength. Click: keep. Escape: as before.");
    }
    if (m_modifiers & Qt::AltModifier) return tr("Alt: left turns, middle moves, right zooms the view.");
    const BrushInfo* brush = m_state.brush();
    if (!brush)
        return tr(
            "Drag: turn the view. Shift: move. Ctrl: zoom. Click a hair: why it is as it is. Pick a tool to groom.");
    const BrushInfo* used = StrokeInput::brushFor(m_state, m_modifiers);
    if (used != brush) return tr("Shift: smooth the guides under the brush.");
    if (m_modifiers & Qt::ControlModifier) return tr("Ctrl: the opposite of %1.").arg(qtext(brush->label));
    return tr("%1   Ctrl: the opposite. %2Alt: move the view. F: size.")
        .arg(qtext(brush->tip), brush->paintsMap ? QString() : tr("Shift: smooth. "));
}

}  // namespace whorl
