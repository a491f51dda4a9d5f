// SPDX-License-Identifier: Apache-2.0
// A slider and a number box that stand for one number of a parameter.
#pragma once

#include "core/param/param.h"

#include <QDoubleSpinBox>
#include <QSlider>
#include <QWidget>

namespace whorl {

/// Shows numbers without trailing zeros.
class NumberBox : public QDoubleSpinBox {
    Q_OBJECT

public:
    explicit NumberBox(QWidget* parent = nullptr);
    /// Range, unit and steps of a parameter; `integer` for whole numbers.
    void declare(const ParamInfo& info, bool integer);
    QString textFromValue(double value) const override;
    /// Wide enough for what artists type; the largest number allowed may be far wider.
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void wheelEvent(QWheelEvent* event) override;
};

/// Numbers in and out are stored ones (metres, radians); the shown ones follow the parameter's unit.
class NumberSlider : public QWidget {
    Q_OBJECT

public:
    NumberSlider(const ParamInfo& info, bool integer, QWidget* parent = nullptr);

    double value() const { return m_value; }
    /// Shows `value`; tells nobody.
    void setValue(double value);
    QSlider& slider() { return *m_slider; }
    NumberBox& box() { return *m_box; }

Q_SIGNALS:
    /// The artist changed the number. `dragging`: the slider is still held, another one will come.
    void edited(double value, bool dragging);
    /// Escape while the slider was held: everything as before.
    void dropped();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    static constexpr int steps = 1000;
    int positionOf(double value) const;
    double valueAt(int position) const;
    void showValue(double value);

    ParamInfo m_info;
    bool m_integer;
    double m_start;  // where the slider begins
    double m_end;    // where the slider ends
    double m_value = 0.0;
    bool m_moved = false;
    bool m_showing = false;
    bool m_dropped = false;
    QSlider* m_slider;
    NumberBox* m_box;
};

}  // namespace whorl
