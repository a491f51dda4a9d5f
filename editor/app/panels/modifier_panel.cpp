// SPDX-License-Identifier: Apache-2.0
#include "editor/app/panels/modifier_panel.h"

#include "core/commands/modifier_edits.h"
#include "core/param/path.h"
#include "editor/app/icons.h"
#include "editor/app/panels/groom_source.h"
#include "editor/app/widgets/message_bar.h"
#include "editor/app/widgets/param_form.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace whorl {
namespace {

QToolButton* makeButton(QWidget* parent, const QString& name, const QString& drawing, const QString& tip) {
    auto* button = new QToolButton(parent);
    button->setObjectName(name);
    button->setIcon(icon(drawing));
    button->setAutoRaise(true);
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    return button;
}

QToolButton* makeMenuButton(QWidget* parent, const char* name, const QString& text, QMenu* menu) {
    auto* button = new QToolButton(parent);
    button->setObjectName(name);
    button->setText(text);
    button->setPopupMode(QToolButton::InstantPopup);
    button->setMenu(menu);
    return button;
}

}  // namespace

ModifierPanel::ModifierPanel(PanelContext context, QWidget* parent)
    : QWidget(parent),
      m_context(context),
      m_rows(new QVBoxLayout),
      m_empty(new QLabel(tr("None. They change the hair after interpolation, from top to bottom."), this)) {
    setObjectName("modifier_panel");
    auto* kinds = new QMenu(this);
    kinds->setObjectName("modifier_kinds");
    kinds->setToolTipsVisible(true);
    for (const BlockInfo& kind : modifierKinds()) {
        QAction* action = kinds->addAction(qtext(kind.label), this, [this, kind] { add(kind); });
        action->setObjectName("modifier_add_" + qtext(kind.id));
        action->setToolTip(qtext(kind.tip));
    }
    auto* wholes = new QMenu(this);
    wholes->setObjectName("modifier_presets");
    wholes->setToolTipsVisible(true);
    for (const Preset& preset : presets()) {
        const QString id = QString::fromStdString(preset.id);
        QAction* action = wholes->addAction(QString::fromStdString(preset.label), this, [this, id] { apply(id); });
        action->setObjectName("preset_" + id);
        action->setToolTip(QString::fromStdString(preset.tip));
    }
    auto* top = new QHBoxLayout;
    top->addWidget(makeMenuButton(this, "modifier_add", tr("Add"), kinds));
    top->addWidget(makeMenuButton(this, "modifier_preset", tr("Presets"), wholes));
    top->addStretch();
    m_rows->setSpacing(2);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(10, 4, 6, 8);
    layout->addLayout(top);
    layout->addWidget(m_empty);
    layout->addLayout(m_rows);
    static_cast<QLabel*>(m_empty)->setWordWrap(true);
    m_empty->setEnabled(false);
    connect(&context.document, &Document::changed, this, &ModifierPanel::refresh);
    connect(&context.state, &EditorState::changed, this, &ModifierPanel::refresh);
    refresh();
}

int ModifierPanel::group() const {
    const int last = static_cast<int>(m_context.document.groom().groups->size()) - 1;
    return std::clamp(m_context.state.group(), 0, last);
}

void ModifierPanel::refresh() {
    const Groom& groom = m_context.document.groom();
    if (groom.groups.sameAs(m_seen) && m_seenGroup == group()) return;
    m_seen = groom.groups;
    m_seenGroup = group();
    const std::vector<Modifier>& list = (*m_seen)[static_cast<std::size_t>(group())].params.modifiers;
    QStringList shown;
    for (const Modifier& modifier : list) {
        shown << QString("%1 %2").arg(modifier.kind()).arg(QString::fromStdString(modifier.name));
    }
    if (shown != m_shown) {
        m_shown = shown;
        rebuild();
    }
    m_empty->setVisible(list.empty());
    for (const Modifier& modifier : list) {
        if (auto* box = findChild<QCheckBox*>("modifier_" + QString::fromStdString(modifier.name) + "_switch")) {
            const QSignalBlocker quiet(box);
            box->setChecked(modifier.on);
        }
    }
}

void ModifierPanel::rebuild() {
    while (QLayoutItem* item = m_rows->takeAt(0)) {
        // Later: a button of the row may be what called.
        item->widget()->hide();
        item->widget()->setParent(nullptr);
        item->widget()->deleteLater();
        delete item;
    }
    const std::vector<Modifier>& list = (*m_seen)[static_cast<std::size_t>(m_seenGroup)].params.modifiers;
    const int count = static_cast<int>(list.size());
    for (int i = 0; i < count; ++i) m_rows->addWidget(makeRow(list[static_cast<std::size_t>(i)], i, count));
}

QWidget* ModifierPanel::makeRow(const Modifier& modifier, int place, int count) {
    const QString name = QString::fromStdString(modifier.name);
    const BlockInfo kind = modifierKinds()[modifier.kind()];
    auto* row = new QWidget(this);
    row->setObjectName("modifier_" + name);
    auto* box = new QCheckBox(name, row);
    box->setObjectName("modifier_" + name + "_switch");
    box->setToolTip(qtext(kind.label) + ": " + qtext(kind.tip));
    box->setChecked(modifier.on);
    connect(box, &QCheckBox::toggled, this, [this, name](bool on) { switchOn(name, on); });

    auto* source = new GroomSource(m_context.document, m_context.state, "modifiers/" + modifier.name, row);
    connect(source, &GroomSource::said, this,
            [this](const QString& sentence) { m_context.messages.say(MessageBar::Kind::Warning, sentence); });
    QStringList fields;
    for (const ParamRef& param : source->values()) {
        if (param.info.id != "on") fields << qtext(param.info.id);
    }
    auto* form = new ParamForm(*source, fields, row);
    form->setObjectName("modifier_" + name + "_form");
    form->setVisible(m_open.contains(name));

    auto* fold = new QToolButton(row);
    fold->setObjectName("modifier_" + name + "_fold");
    fold->setAutoRaise(true);
    fold->setCheckable(true);
    fold->setChecked(m_open.contains(name));
    fold->setArrowType(fold->isChecked() ? Qt::DownArrow : Qt::RightArrow);
    fold->setToolTip(tr("Shows the parameters"));
    fold->setAccessibleName(tr("Parameters of %1").arg(name));
    connect(fold, &QToolButton::toggled, this, [this, name, fold, form](bool open) {
        open ? m_open.push_back(name) : static_cast<void>(m_open.removeAll(name));
        fold->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
        form->setVisible(open);
    });
    QToolButton* up = makeButton(row, "modifier_" + name + "_up", "up", tr("Works earlier"));
    QToolButton* down = makeButton(row, "modifier_" + name + "_down", "down", tr("Works later"));
    QToolButton* gone = makeButton(row, "modifier_" + name + "_remove", "close", tr("Removes the modifier"));
    up->setEnabled(place > 0);
    down->setEnabled(place + 1 < count);
    connect(up, &QToolButton::clicked, this, [this, name, place] { move(name, place - 1); });
    connect(down, &QToolButton::clicked, this, [this, name, place] { move(name, place + 1); });
    connect(gone, &QToolButton::clicked, this, [this, name] { remove(name); });
    auto* top = new QHBoxLayout;
    top->setSpacing(4);
    top->addWidget(fold);
    top->addWidget(box, 1);
    for (QToolButton* button : {up, down, gone}) top->addWidget(button);
    auto* layout = new QVBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(top);
    layout->addWidget(form);
    return row;
}

void ModifierPanel::finish(const Result<void>& done, Groom after, const QString& text) {
    if (done) {
        m_context.document.edit(std::move(after), text);
    } else {
        m_context.messages.say(MessageBar::Kind::Warning, QString::fromStdString(done.error().message));
    }
}

void ModifierPanel::add(const BlockInfo& kind) {
    Groom after = m_context.document.committed();
    const Result<int> place = addModifier(after, group(), kind.id);
    if (place) {
        const Modifier& made =
            (*after.groups)[static_cast<std::size_t>(group())].params.modifiers[static_cast<std::size_t>(*place)];
        m_open.push_back(QString::fromStdString(made.name));
    }
    finish(place ? Result<void>() : Result<void>(place.error()), std::move(after),
           tr("Add modifier %1").arg(qtext(kind.label)));
}

void ModifierPanel::move(const QString& name, int to) {
    Groom after = m_context.document.committed();
    const Result<void> done = moveModifier(after, group(), name.toStdString(), to);
    finish(done, std::move(after), tr("Move modifier %1").arg(name));
}

void ModifierPanel::remove(const QString& name) {
    Groom after = m_context.document.committed();
    const Result<void> done = removeModifier(after, group(), name.toStdString());
    m_open.removeAll(name);
    finish(done, std::move(after), tr("Remove modifier %1").arg(name));
}

void ModifierPanel::switchOn(const QString& name, bool on) {
    Groom after = m_context.document.committed();
    const std::string path = "groups/" + (*after.groups)[static_cast<std::size_t>(group())].name + "/modifiers/" +
                             name.toStdString() + "/on";
    const Result<void> done = setGroomValue(after, path, on);
    finish(done, std::move(after), on ? tr("Switch on %1").arg(name) : tr("Switch off %1").arg(name));
}

void ModifierPanel::apply(const QString& id) {
    for (const Preset& preset : presets()) {
        if (preset.id != id.toStdString()) continue;
        Groom after = m_context.document.committed();
        const Result<void> done = applyPreset(after, group(), preset.text, preset.label);
        finish(done, std::move(after), tr("Preset %1").arg(QString::fromStdString(preset.label)));
        return;
    }
}

}  // namespace whorl
