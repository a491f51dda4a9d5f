// SPDX-License-Identifier: Apache-2.0
#include "editor/app/widgets/param_form.h"

#include "editor/app/icons.h"
#include "editor/app/widgets/param_editors.h"

#include <QGridLayout>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>

namespace whorl {
namespace {

bool isColour(const ParamRef& param) {
    return std::holds_alternative<DrivenColour*>(param.target);
}

QToolButton* smallButton(const char* picture, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setIcon(icon(picture));
    button->setIconSize({14, 14});
    button->setAutoRaise(true);
    button->setFixedSize(22, 22);
    return button;
}

}  // namespace

ParamForm::ParamForm(ParamSource& source, QStringList only, QWidget* parent)
    : QWidget(parent), m_source(source), m_only(std::move(only)) {
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(10, 4, 6, 8);
    grid->setHorizontalSpacing(6);
    grid->setVerticalSpacing(4);
    grid->setColumnStretch(1, 1);
    std::size_t index = 0;
    for (const ParamRef& param : m_source.values()) addRow(*grid, index++, param);
    connect(&m_source, &ParamSource::changed, this, &ParamForm::refresh);
    showOnly(m_only);
    refresh();
}

void ParamForm::addRow(QGridLayout& grid, std::size_t index, const ParamRef& param) {
    Row row;
    row.id = qtext(param.info.id);
    const QString tip = QString("<b>%1</b><br>%2").arg(qtext(param.info.label), qtext(param.info.tip));
    const int line = static_cast<int>(index);
    row.editor = makeParamEditor(param, m_source, this);
    row.editor->setObjectName(row.id + "_editor");
    row.editor->setToolTip(tip);
    row.editor->setWhatsThis(tip);
    if (std::holds_alternative<bool*>(param.target)) {
        grid.addWidget(row.editor, line, 0, 1, 2);
    } else {
        row.label = new QLabel(qtext(param.info.label), this);
        row.label->setToolTip(tip);
        row.label->setBuddy(row.editor);
        // One width for all forms, so that their sliders stand in one line.
        row.label->setMinimumWidth(fontMetrics().horizontalAdvance("Brightness variation") + 4);
        grid.addWidget(row.label, line, 0);
        grid.addWidget(row.editor, line, 1);
    }
    if (isDriven(param) && m_source.takesMaps()) {
        row.map = smallButton("map", this);
        row.map->setObjectName(row.id + "_map_button");
        row.map->setAccessibleName(tr("Map of %1").arg(qtext(param.info.label)));
        row.map->setPopupMode(QToolButton::InstantPopup);
        row.map->setCheckable(true);
        row.map->setMenu(new QMenu(row.map));
        // The arrow of the menu would cover the small picture.
        row.map->setStyleSheet(
            "QToolButton::menu-indicator { image: none; }"
            "QToolButton:checked { background: palette(highlight); border-radius: 3px; }");
        connect(row.map->menu(), &QMenu::aboutToShow, this, [this, index] { fillMapMenu(index); });
        grid.addWidget(row.map, line, 2);
    }
    row.reset = smallButton("reset", this);
    row.reset->setObjectName(row.id + "_reset");
    row.reset->setAccessibleName(tr("Reset %1").arg(qtext(param.info.label)));
    row.reset->setToolTip(tr("Back to the default"));
    connect(row.reset, &QToolButton::clicked, this, [this, index] { resetRow(index); });
    grid.addWidget(row.reset, line, 3);
    connect(row.editor, &ParamEditor::edited, this, [this, index](const ParamValue& value, bool dragging) {
        m_source.set(m_source.values()[index], value, dragging);
    });
    connect(row.editor, &ParamEditor::dropped, this, [this] { m_source.drop(); });
    m_rows.push_back(row);
}

void ParamForm::showOnly(const QStringList& ids) {
    m_only = ids;
    refresh();
}

void ParamForm::refresh() {
    const std::vector<ParamRef> values = m_source.values();
    const std::vector<ParamRef> defaults = m_source.defaults();
    for (std::size_t i = 0; i < m_rows.size() && i < values.size(); ++i) {
        Row& row = m_rows[i];
        const bool shown = !values[i].info.kept && (m_only.isEmpty() || m_only.contains(row.id));
        row.editor->setVisible(shown);
        if (row.label) row.label->setVisible(shown);
        row.editor->show(values[i]);
        const std::string* map = paramMap(values[i]);
        if (row.map) {
            row.map->setVisible(shown);
            row.map->setChecked(map && !map->empty());
            row.map->setToolTip(map && !map->empty() ? tr("Multiplied by the map %1").arg(QString::fromStdString(*map))
                                                     : tr("Multiply by a map"));
        }
        const bool differs = paramValue(values[i]) != paramValue(defaults[i]);
        // Hidden while there is nothing to reset it keeps its place, so that sliders do not jump.
        QSizePolicy policy = row.reset->sizePolicy();
        policy.setRetainSizeWhenHidden(shown);
        row.reset->setSizePolicy(policy);
        row.reset->setVisible(shown && differs);
    }
}

void ParamForm::fillMapMenu(std::size_t index) {
    QMenu& menu = *m_rows[index].map->menu();
    menu.clear();
    const ParamRef param = m_source.values()[index];
    const std::string* current = paramMap(param);
    const auto add = [&](const QString& text, const std::string& name) {
        QAction* action = menu.addAction(text);
        action->setCheckable(true);
        action->setChecked(current && *current == name);
        connect(action, &QAction::triggered, this,
                [this, index, name] { m_source.setMap(m_source.values()[index], name); });
    };
    add(tr("No map"), {});
    const QStringList names = m_source.maps(isColour(param));
    if (!names.isEmpty()) menu.addSeparator();
    for (const QString& name : names) add(name, name.toStdString());
    menu.addSeparator();
    menu.addAction(tr("New map"), this, [this, index] { m_source.createMap(m_source.values()[index]); });
    // Opening the menu toggles a checkable button; it shows whether there is a map.
    m_rows[index].map->setChecked(current && !current->empty());
}

void ParamForm::resetRow(std::size_t index) {
    const ParamRef fallback = m_source.defaults()[index];
    m_source.set(m_source.values()[index], paramValue(fallback), false);
}

Section::Section(const QString& title, QWidget* content, QWidget* parent)
    : QWidget(parent), m_title(new QToolButton(this)), m_content(content) {
    m_title->setText(title);
    m_title->setCheckable(true);
    m_title->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    m_title->setAutoRaise(true);
    m_title->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    QFont font = m_title->font();
    font.setBold(true);
    m_title->setFont(font);
    m_title->setStyleSheet("QToolButton { text-align: left; padding: 4px; border: none; }");
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_title);
    layout->addWidget(m_content);
    connect(m_title, &QToolButton::toggled, this, &Section::setOpen);
    setOpen(true);
}

void Section::setOpen(bool open) {
    m_title->setChecked(open);
    m_title->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    m_content->setVisible(open);
}

bool Section::isOpen() const {
    return m_title->isChecked();
}

}  // namespace whorl
