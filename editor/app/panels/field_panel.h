// SPDX-License-Identifier: Apache-2.0
// Strokes of the direction field, how it spreads, and the hair texture along it.
#pragma once

#include "editor/app/panels/panels.h"

class QDoubleSpinBox;

namespace whorl {

class FieldPanel : public QWidget {
    Q_OBJECT

public:
    explicit FieldPanel(PanelContext context, QWidget* parent = nullptr);

private:
    void refresh();
    void pick(int row);
    /// Gives the picked stroke what the fields below the list say.
    void changeWeight(double weight);
    void changeRadius(double millimetres);
    /// Makes `stroke` a step of the history, or says why not.
    void change(const FieldStroke& stroke, const QString& text, const QString& what);

    PanelContext m_context;
    QListWidget* m_list;
    QWidget* m_numbers;
    QDoubleSpinBox* m_weight;
    QDoubleSpinBox* m_radius;
    Cow<std::vector<FieldStroke>> m_seen;
    bool m_filling = false;
};

}  // namespace whorl
