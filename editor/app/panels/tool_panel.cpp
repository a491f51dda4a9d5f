// SPDX-License-Identifier: Apache-2.0
#include "editor/app/actions.h"
#include "editor/app/panels/groom_source.h"
#include "editor/app/panels/panels.h"
#include "editor/app/widgets/param_form.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace whorl {
namespace {

QStringList rowsOf(const BrushInfo& brush) {
    if (brush.paintsGroups) return {"radius", "mirror", "front_only", "pressure_size"};
    if (brush.id == "align_strokes") return {"radius", "strength", "mirror", "front_only", "pressure_strength"};
    if (brush.id == "parting" || brush.drawsStrokes) return {"radius", "mirror", "front_only"};
    QStringList rows{"radius", "strength"};
    if (brush.paintsMap)
        rows << "map"
             << "value";
    else
        rows << "reach";
    rows << "mirror"
         << "front_only";
    if (brush.id == "comb")
        rows << "keep_length"
             << "keep_outside";
    if (!brush.paintsMap && brush.id != "place" && brush.id != "delete") rows << "respect_partings";
    return rows << "pressure_size"
                << "pressure_strength";
}

}  // namespace

ToolPanel::ToolPanel(PanelContext context, QWidget* parent)
    : QWidget(parent),
      m_context(context),
      m_title(new QLabel(this)),
      m_tip(new QLabel(this)),
      m_makeMap(new QPushButton(tr("Make a density map"), this)) {
    setObjectName("tool_panel");
    QFont font = m_title->font();
    font.setBold(true);
    font.setPointSizeF(font.pointSizeF() * 1.1);
    m_title->setFont(font);
    m_title->setObjectName("tool_title");
    m_tip->setObjectName("tool_tip");
    m_tip->setWordWrap(true);
    m_makeMap->setObjectName("tool_make_map");
    connect(m_makeMap, &QPushButton::clicked, &context.actions.get("groom.paint_density"), &QAction::trigger);
    auto* source = new StateSource<BrushOptions>(context.state, context.document, &EditorState::brushOptions,
                                                 &EditorState::setBrushOptions, this);
    m_form = new ParamForm(*source, {}, this);
    m_form->setObjectName("tool_form");
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 8, 0, 0);
    for (QLabel* label : {m_title, m_tip}) {
        label->setContentsMargins(10, 0, 10, 0);
        layout->addWidget(label);
    }
    layout->addWidget(m_form);
    layout->addWidget(m_makeMap, 0, Qt::AlignHCenter);
    layout->addStretch();
    connect(&context.state, &EditorState::changed, this, &ToolPanel::refresh);
    connect(&context.document, &Document::changed, this, &ToolPanel::refresh);
    refresh();
}

void ToolPanel::refresh() {
    const BrushInfo* brush = m_context.state.brush();
    QString title = brush ? qtext(brush->label) : tr("Look around");
    const std::vector<Group>& groups = *m_context.document.groom().groups;
    if (brush && brush->paintsGroups && !groups.empty()) {
        const auto group = static_cast<std::size_t>(std::max(m_context.state.group(), 0));
        title += ": " + QString::fromStdString(groups[std::min(group, groups.size() - 1)].name);
    }
    m_title->setText(title);
    m_tip->setText(brush ? qtext(brush->tip) : tr("Drag to turn the view. Pick a tool on the left to groom."));
    m_form->setVisible(brush != nullptr);
    if (brush) m_form->showOnly(rowsOf(*brush));
    m_makeMap->setVisible(brush && brush->paintsMap && !brush->paintsGroups &&
                          mapNames(m_context.document.groom(), false).isEmpty());
}

}  // namespace whorl
