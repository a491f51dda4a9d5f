// SPDX-License-Identifier: Apache-2.0
#include "editor/app/widgets/param_editors.h"

#include "editor/app/widgets/colour_button.h"
#include "editor/app/widgets/number_slider.h"
#include "editor/app/widgets/param_source.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QWheelEvent>

namespace whorl {
namespace {

QHBoxLayout* rowLayout(QWidget* widget) {
    auto* layout = new QHBoxLayout(widget);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    return layout;
}

/// Names a part of an editor for scripted tests and for people who do not see it.
void name(QWidget& widget, const ParamRef& param, const char* part) {
    widget.setObjectName(qtext(param.info.id) + '_' + part);
    widget.setAccessibleName(qtext(param.info.label));
    widget.setAccessibleDescription(qtext(param.info.tip));
}

/// A combo box that scrolling panels do not change.
class CalmCombo : public QComboBox {
public:
    explicit CalmCombo(QWidget* parent) : QComboBox(parent) { setFocusPolicy(Qt::StrongFocus); }
    void wheelEvent(QWheelEvent* event) override { hasFocus() ? QComboBox::wheelEvent(event) : event->ignore(); }
};

class NumberEditor : public ParamEditor {
public:
    NumberEditor(const ParamRef& param, QWidget* parent)
        : ParamEditor(parent),
          m_number(new NumberSlider(param.info, std::holds_alternative<int*>(param.target), this)) {
        rowLayout(this)->addWidget(m_number);
        name(*m_number, param, "number");
        name(m_number->slider(), param, "slider");
        name(m_number->box(), param, "box");
        connect(m_number, &NumberSlider::edited, this,
                [this](double value, bool dragging) { Q_EMIT edited(ParamValue{value}, dragging); });
        connect(m_number, &NumberSlider::dropped, this, &ParamEditor::dropped);
        setFocusProxy(m_number);
    }
    void show(const ParamRef& param) override {
        const ParamValue value = paramValue(param);
        if (const double* number = std::get_if<double>(&value)) m_number->setValue(*number);
    }

private:
    NumberSlider* m_number;
};

class VectorEditor : public ParamEditor {
public:
    VectorEditor(const ParamRef& param, QWidget* parent) : ParamEditor(parent), m_scale(param.info.shownScale) {
        QHBoxLayout* layout = rowLayout(this);
        for (int axis = 0; axis < 3; ++axis) {
            NumberBox*& box = m_boxes[axis];
            box = new NumberBox(this);
            box->declare(param.info, false);
            box->setSuffix({});
            box->setButtonSymbols(QAbstractSpinBox::NoButtons);
            name(*box, param, axis == 0 ? "x" : axis == 1 ? "y" : "z");
            layout->addWidget(box, 1);
            connect(box, &QDoubleSpinBox::valueChanged, this, [this] {
                if (!m_showing) Q_EMIT edited(ParamValue{value()}, false);
            });
        }
        setFocusProxy(m_boxes[0]);
    }
    void show(const ParamRef& param) override {
        const ParamValue shown = paramValue(param);
        const auto* vector = std::get_if<glm::vec3>(&shown);
        if (!vector) return;
        m_showing = true;
        for (int axis = 0; axis < 3; ++axis) m_boxes[axis]->setValue(static_cast<double>((*vector)[axis]) * m_scale);
        m_showing = false;
    }

private:
    glm::vec3 value() const {
        glm::vec3 v(0.0f);
        for (int axis = 0; axis < 3; ++axis) v[axis] = static_cast<float>(m_boxes[axis]->value() / m_scale);
        return v;
    }
    double m_scale;
    bool m_showing = false;
    NumberBox* m_boxes[3];
};

class ColourEditor : public ParamEditor {
public:
    ColourEditor(const ParamRef& param, QWidget* parent)
        : ParamEditor(parent), m_button(new ColourButton(qtext(param.info.label), this)) {
        rowLayout(this)->addWidget(m_button);
        name(*m_button, param, "colour");
        connect(m_button, &ColourButton::edited, this,
                [this](const glm::vec3& linear, bool choosing) { Q_EMIT edited(ParamValue{linear}, choosing); });
        connect(m_button, &ColourButton::dropped, this, &ParamEditor::dropped);
        setFocusProxy(m_button);
    }
    void show(const ParamRef& param) override {
        const ParamValue value = paramValue(param);
        if (const auto* colour = std::get_if<glm::vec3>(&value)) m_button->setColour(*colour);
    }

private:
    ColourButton* m_button;
};

class CheckEditor : public ParamEditor {
public:
    CheckEditor(const ParamRef& param, QWidget* parent)
        : ParamEditor(parent), m_check(new QCheckBox(qtext(param.info.label), this)) {
        rowLayout(this)->addWidget(m_check);
        name(*m_check, param, "check");
        connect(m_check, &QCheckBox::clicked, this, [this](bool on) { Q_EMIT edited(ParamValue{on}, false); });
        setFocusProxy(m_check);
    }
    void show(const ParamRef& param) override {
        const ParamValue value = paramValue(param);
        if (const bool* on = std::get_if<bool>(&value)) m_check->setChecked(*on);
    }

private:
    QCheckBox* m_check;
};

class ChoiceEditor : public ParamEditor {
public:
    ChoiceEditor(const ParamRef& param, QWidget* parent) : ParamEditor(parent), m_combo(new CalmCombo(this)) {
        rowLayout(this)->addWidget(m_combo);
        name(*m_combo, param, "choice");
        for (const std::string_view choice : param.info.choices) m_combo->addItem(qtext(choice));
        connect(m_combo, &QComboBox::activated, this,
                [this] { Q_EMIT edited(ParamValue{m_combo->currentText().toStdString()}, false); });
        setFocusProxy(m_combo);
    }
    void show(const ParamRef& param) override {
        if (const auto* choice = std::get_if<Choice*>(&param.target)) m_combo->setCurrentIndex((*choice)->index);
    }

private:
    QComboBox* m_combo;
};

class MapNameEditor : public ParamEditor {
public:
    MapNameEditor(const ParamRef& param, ParamSource& source, QWidget* parent)
        : ParamEditor(parent), m_source(source), m_combo(new CalmCombo(this)) {
        rowLayout(this)->addWidget(m_combo);
        name(*m_combo, param, "map");
        connect(m_combo, &QComboBox::activated, this, [this](int index) {
            const QString map = index == 0 ? QString() : m_combo->itemText(index);
            Q_EMIT edited(ParamValue{map.toStdString()}, false);
        });
        setFocusProxy(m_combo);
    }
    void show(const ParamRef& param) override {
        QStringList names{tr("None")};
        names += m_source.maps(false);
        QStringList old;
        for (int i = 0; i < m_combo->count(); ++i) old.push_back(m_combo->itemText(i));
        if (old != names) {
            m_combo->clear();
            m_combo->addItems(names);
        }
        const std::string* map = paramMap(param);
        const int index = map && !map->empty() ? m_combo->findText(QString::fromStdString(*map)) : 0;
        m_combo->setCurrentIndex(std::max(index, 0));
    }

private:
    ParamSource& m_source;
    QComboBox* m_combo;
};

}  // namespace

ParamEditor* makeParamEditor(const ParamRef& param, ParamSource& source, QWidget* parent) {
    struct Make {
        const ParamRef& param;
        ParamSource& source;
        QWidget* parent;
        ParamEditor* operator()(bool*) const { return new CheckEditor(param, parent); }
        ParamEditor* operator()(int*) const { return new NumberEditor(param, parent); }
        ParamEditor* operator()(float*) const { return new NumberEditor(param, parent); }
        ParamEditor* operator()(Driven*) const { return new NumberEditor(param, parent); }
        ParamEditor* operator()(DrivenVector*) const { return new VectorEditor(param, parent); }
        ParamEditor* operator()(DrivenColour*) const { return new ColourEditor(param, parent); }
        ParamEditor* operator()(Colour*) const { return new ColourEditor(param, parent); }
        ParamEditor* operator()(Vector*) const { return new VectorEditor(param, parent); }
        ParamEditor* operator()(MapName*) const { return new MapNameEditor(param, source, parent); }
        ParamEditor* operator()(Choice*) const { return new ChoiceEditor(param, parent); }
    };
    return std::visit(Make{param, source, parent}, param.target);
}

}  // namespace whorl
