// SPDX-License-Identifier: Apache-2.0
#include "editor/app/widgets/number_slider.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace whorl {

NumberBox::NumberBox(QWidget* parent) : QDoubleSpinBox(parent) {
    setLocale(QLocale::c());
    setKeyboardTracking(false);
    setAccelerated(true);
    setFocusPolicy(Qt::StrongFocus);
}

void NumberBox::declare(const ParamInfo& info, bool integer) {
    setDecimals(integer ? 0 : 6);
    setRange(info.min * info.shownScale, info.max * info.shownScale);
    const double end = (info.softMax > 0 ? info.softMax : info.max) * info.shownScale;
    if (integer) {
        setSingleStep(1);
    } else if (info.logarithmic) {
        setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    } else {
        setSingleStep(std::pow(10.0, std::floor(std::log10(std::max(end, 1e-6) / 20.0))));
    }
    if (!info.unit.empty()) {
        const QString unit = QString::fromUtf8(info.unit.data(), static_cast<qsizetype>(info.unit.size()));
        setSuffix(unit == "degrees" || unit == u"°" ? QString(u'°') : unit == "per metre" ? " /m" : ' ' + unit);
    }
}

QString NumberBox::textFromValue(double value) const {
    if (decimals() == 0) return QString::number(static_cast<qlonglong>(std::llround(value)));
    // Four figures are what a hand can set; more would only move under the eye.
    const int whole = std::abs(value) < 1 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
    QString text = QString::number(value, 'f', std::clamp(4 - whole, 0, decimals()));
    if (text.contains('.')) {
        while (text.endsWith('0')) text.chop(1);
        if (text.endsWith('.')) text.chop(1);
    }
    return text == "-0" ? "0" : text;
}

QSize NumberBox::sizeHint() const {
    QSize size = QDoubleSpinBox::sizeHint();
    // Boxes without buttons stand three in a row.
    const bool small = buttonSymbols() == NoButtons;
    size.setWidth(fontMetrics().horizontalAdvance(small ? "00000" : "0.0000 mm") + (small ? 10 : 32));
    return size;
}

void NumberBox::wheelEvent(QWheelEvent* event) {
    // A panel that scrolls under the pointer must not change numbers.
    hasFocus() ? QDoubleSpinBox::wheelEvent(event) : event->ignore();
}

NumberSlider::NumberSlider(const ParamInfo& info, bool integer, QWidget* parent)
    : QWidget(parent),
      m_info(info),
      m_integer(integer),
      m_start(info.softMax > 0 ? std::max(info.min, -info.softMax) : info.min),
      m_end(info.softMax > 0 ? info.softMax : info.max),
      m_slider(new QSlider(Qt::Horizontal, this)),
      m_box(new NumberBox(this)) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(6);
    layout->addWidget(m_slider, 1);
    layout->addWidget(m_box);
    m_box->declare(info, integer);
    m_box->setFixedWidth(m_box->sizeHint().width());
    m_slider->setRange(0, steps);
    m_slider->setSingleStep(steps / 100);
    m_slider->setPageStep(steps / 10);
    m_slider->setMinimumWidth(60);
    m_slider->setFocusPolicy(Qt::StrongFocus);
    m_slider->installEventFilter(this);
    setFocusProxy(m_box);

    connect(m_box, &QDoubleSpinBox::valueChanged, this, [this](double shown) {
        if (m_showing) return;
        showValue(shown / m_info.shownScale);
        Q_EMIT edited(m_value, false);
    });
    connect(m_slider, &QSlider::sliderPressed, this, [this] { m_moved = m_dropped = false; });
    connect(m_slider, &QSlider::valueChanged, this, [this](int position) {
        if (m_showing || m_dropped) return;
        showValue(valueAt(position));
        m_moved = m_slider->isSliderDown();
        Q_EMIT edited(m_value, m_slider->isSliderDown());
    });
    connect(m_slider, &QSlider::sliderReleased, this, [this] {
        if (m_moved && !m_dropped) Q_EMIT edited(m_value, false);
        m_moved = m_dropped = false;
    });
}

void NumberSlider::setValue(double value) {
    // While the slider is held, what it says is newer than what comes back.
    if (m_slider->isSliderDown() && !m_dropped) return;
    showValue(value);
}

void NumberSlider::showValue(double value) {
    m_showing = true;
    m_value = m_integer ? std::round(value) : value;
    m_box->setValue(m_value * m_info.shownScale);
    if (!m_slider->isSliderDown()) m_slider->setValue(positionOf(m_value));
    m_showing = false;
}

// Logarithmic sliders keep their lowest hundredth for the smallest value, so that zero can be reached.
int NumberSlider::positionOf(double value) const {
    const double low = m_start;
    if (!m_info.logarithmic) {
        const double t = (value - low) / (m_end - low);
        return static_cast<int>(std::lround(std::clamp(t, 0.0, 1.0) * steps));
    }
    const double start = low > 0 ? low : m_end * 1e-4;
    if (value < start) return 0;
    const double t = std::log(value / start) / std::log(m_end / start);
    return static_cast<int>(std::lround(steps / 100.0 + std::clamp(t, 0.0, 1.0) * (steps - steps / 100.0)));
}

double NumberSlider::valueAt(int position) const {
    const double low = m_start;
    if (!m_info.logarithmic) return low + (m_end - low) * position / steps;
    if (position < steps / 100) return low;
    const double start = low > 0 ? low : m_end * 1e-4;
    const double t = (position - steps / 100.0) / (steps - steps / 100.0);
    const double value = start * std::pow(m_end / start, t);
    // Whole numbers read better with few figures: 12300 rather than 12317.
    if (!m_integer) return value;
    const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(std::max(value, 1.0))) - 2));
    return std::clamp(std::round(value / unit) * unit, m_info.min, m_info.max);
}

bool NumberSlider::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Wheel && !m_slider->hasFocus()) {
        event->ignore();
        return true;
    }
    if (event->type() == QEvent::KeyPress && m_slider->isSliderDown() &&
        static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        m_dropped = true;
        Q_EMIT dropped();
        return true;
    }
    // With the Escape key the program's shortcuts must not act on a held slider.
    if (event->type() == QEvent::ShortcutOverride && m_slider->isSliderDown()) {
        event->accept();
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

}  // namespace whorl
