// SPDX-License-Identifier: Apache-2.0
#include "editor/app/panels/field_panel.h"

#include "core/commands/strokes.h"
#include "editor/app/actions.h"
#include "editor/app/panels/groom_source.h"
#include "editor/app/widgets/message_bar.h"
#include "editor/app/widgets/param_form.h"

#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace whorl {
namespace {

QString kindName(StrokeKind kind) {
    switch (kind) {
        case StrokeKind::Along:
            return FieldPanel::tr("Along");
        case StrokeKind::Attract:
            return FieldPanel::tr("Attract");
        case StrokeKind::Repel:
            return FieldPanel::tr("Repel");
        case StrokeKind::Whorl:
            return FieldPanel::tr("Whorl");
        case StrokeKind::ClockwiseWhorl:
            return FieldPanel::tr("Clockwise whorl");
    }
    return {};
}

QDoubleSpinBox* number(const QString& name, const QString& called, const QString& tip, double most, int digits) {
    auto* box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setAccessibleName(called);
    box->setToolTip(tip);
    box->setRange(0.0, most);
    box->setDecimals(digits);
    box->setKeyboardTracking(false);
    return box;
}

}  // namespace

FieldPanel::FieldPanel(PanelContext context, QWidget* parent)
    : QWidget(parent),
      m_context(context),
      m_list(new QListWidget(this)),
      m_numbers(new QWidget(this)),
      m_weight(number("stroke_weight", tr("Weight of the stroke"), tr("How much the stroke counts against others"),
                      static_cast<double>(FieldStroke::maxWeight), 2)),
      m_radius(number("stroke_radius", tr("Radius of the stroke"),
                      tr("How far around its place the stroke attracts, repels or turns hair"),
                      1000.0 * static_cast<double>(FieldStroke::maxRadius), 1)) {
    setObjectName("field_panel");
    m_list->setObjectName("stroke_list");
    m_list->setAccessibleName(tr("Strokes"));
    m_list->setToolTip(tr("Strokes on the model; draw them with the Sketch brush (H)"));
    m_list->setMaximumHeight(110);
    m_weight->setMinimum(static_cast<double>(FieldStroke::minWeight));
    m_weight->setSingleStep(0.25);
    m_radius->setSuffix(tr(" mm"));
    auto* numbers = new QFormLayout(m_numbers);
    numbers->setContentsMargins(10, 0, 10, 0);
    numbers->addRow(tr("Weight"), m_weight);
    numbers->addRow(tr("Radius"), m_radius);

    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(0, 8, 0, 8);
    auto* list = new QVBoxLayout;
    list->setContentsMargins(8, 0, 8, 0);
    list->addWidget(m_list);
    column->addLayout(list);
    column->addWidget(m_numbers);
    auto* buttons = new QVBoxLayout;
    buttons->setContentsMargins(10, 0, 10, 0);
    for (const char* id : {"groom.grow_along", "view.texture", "groom.strokes_from_guides", "groom.remove_stroke"}) {
        QAction& action = context.actions.get(id);
        auto* button = new QPushButton(Actions::plainText(context.actions.info(id)));
        button->setObjectName(QString(id).replace('.', '_'));
        button->setToolTip(action.toolTip());
        button->setAccessibleDescription(action.statusTip());
        button->setCheckable(action.isCheckable());
        const auto follow = [button, &action] {
            button->setEnabled(action.isEnabled());
            button->setChecked(action.isChecked());
        };
        follow();
        connect(button, &QPushButton::clicked, &action, &QAction::trigger);
        connect(&action, &QAction::changed, button, follow);
        buttons->addWidget(button);
    }
    column->addLayout(buttons);
    Groom groom;
    Groom::eachBlock(groom, [&](const BlockInfo& info, auto&) {
        if (info.id == "counts") return;
        auto* source = new GroomSource(context.document, context.state, std::string(info.id), this);
        connect(source, &GroomSource::said, this,
                [context](const QString& sentence) { context.messages.say(MessageBar::Kind::Warning, sentence); });
        auto* form = new ParamForm(*source);
        form->setObjectName(qtext(info.id) + "_form");
        auto* section = new Section(qtext(info.label), form);
        section->setObjectName(qtext(info.id) + "_section");
        section->setToolTip(qtext(info.tip));
        column->addWidget(section);
    });
    column->addStretch();
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scrolled(content));

    connect(m_list, &QListWidget::currentRowChanged, this, &FieldPanel::pick);
    connect(m_weight, &QDoubleSpinBox::valueChanged, this, &FieldPanel::changeWeight);
    connect(m_radius, &QDoubleSpinBox::valueChanged, this, &FieldPanel::changeRadius);
    connect(&context.document, &Document::changed, this, &FieldPanel::refresh);
    connect(&context.state, &EditorState::changed, this, &FieldPanel::refresh);
    refresh();
}

void FieldPanel::refresh() {
    setEnabled(m_context.document.hasGroom());
    const Groom& groom = m_context.document.groom();
    const std::vector<FieldStroke>& strokes = *groom.strokes;
    m_filling = true;
    if (!groom.strokes.sameAs(m_seen) || m_list->count() != static_cast<int>(strokes.size())) {
        m_seen = groom.strokes;
        const auto count = static_cast<int>(strokes.size());
        while (m_list->count() > count) delete m_list->takeItem(m_list->count() - 1);
        while (m_list->count() < count) m_list->addItem(QString());
        for (int i = 0; i < count; ++i) {
            const FieldStroke& stroke = strokes[static_cast<std::size_t>(i)];
            const QString text = tr("%1 %2").arg(kindName(stroke.kind)).arg(stroke.id);
            if (m_list->item(i)->text() != text) m_list->item(i)->setText(text);
        }
    }
    int row = -1;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
        if (strokes[i].id == m_context.state.pickedStroke()) row = static_cast<int>(i);
    }
    m_list->setCurrentRow(row);
    m_numbers->setEnabled(row >= 0);
    if (row >= 0) {
        const FieldStroke& stroke = strokes[static_cast<std::size_t>(row)];
        const QSignalBlocker quietWeight(m_weight), quietRadius(m_radius);
        m_weight->setValue(static_cast<double>(stroke.weight));
        m_radius->setValue(1000.0 * static_cast<double>(stroke.radius));
        m_radius->setEnabled(stroke.kind != StrokeKind::Along);
    }
    m_filling = false;
}

void FieldPanel::pick(int row) {
    const std::vector<FieldStroke>& strokes = *m_context.document.groom().strokes;
    if (m_filling || row < 0 || row >= static_cast<int>(strokes.size())) return;
    m_context.state.setPickedStroke(strokes[static_cast<std::size_t>(row)].id);
}

void FieldPanel::changeWeight(double weight) {
    const FieldStroke* const own = findStroke(m_context.document.committed(), m_context.state.pickedStroke());
    if (!own) return;
    FieldStroke stroke = *own;
    stroke.weight = static_cast<float>(weight);
    change(stroke, tr("Weight of stroke %1").arg(stroke.id), "weight");
}

void FieldPanel::changeRadius(double millimetres) {
    const FieldStroke* const own = findStroke(m_context.document.committed(), m_context.state.pickedStroke());
    if (!own) return;
    FieldStroke stroke = *own;
    stroke.radius = static_cast<float>(millimetres * 0.001);
    change(stroke, tr("Radius of stroke %1").arg(stroke.id), "radius");
}

void FieldPanel::change(const FieldStroke& stroke, const QString& text, const QString& what) {
    Groom after = m_context.document.committed();
    const Result<void> done = changeStroke(after, stroke);
    if (done) {
        m_context.document.edit(std::move(after), text, QString("stroke %1 %2").arg(stroke.id).arg(what));
    } else {
        m_context.messages.say(MessageBar::Kind::Warning, QString::fromStdString(done.error().message));
    }
}

}  // namespace whorl
