// SPDX-License-Identifier: Apache-2.0
#include "editor/app/panels/explain_panel.h"

#include "editor/app/document.h"
#include "editor/app/viewport/viewport.h"

#include <glm/geometric.hpp>

#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace whorl {
namespace {

QString number(double value, int digits = 4) {
    return QLocale().toString(value, 'g', digits);
}

QString millimetres(float metres) {
    return ExplainPanel::tr("%1 mm").arg(number(metres < 1e-6f ? 0.0 : 1000.0 * static_cast<double>(metres), 3));
}

float lengthOf(const std::vector<glm::vec3>& points) {
    float length = 0.0f;
    for (std::size_t i = 1; i < points.size(); ++i) length += glm::distance(points[i - 1], points[i]);
    return length;
}

void fill(QTreeWidget& rows, const HairExplanation& hair) {
    const auto row = [&](const QString& what, const QString& value) {
        auto* item = new QTreeWidgetItem(&rows, {what, value});
        item->setToolTip(0, what);
        item->setToolTip(1, value);
    };
    row(ExplainPanel::tr("Group"), QString::fromStdString(hair.group));
    row(ExplainPanel::tr("Density"), number(static_cast<double>(hair.density), 3));
    for (const ExplainedGuide& guide : hair.guides) {
        row(ExplainPanel::tr("Guide %1").arg(guide.id),
            ExplainPanel::tr("%1 %, %2 away")
                .arg(number(100.0 * static_cast<double>(guide.weight), 3), millimetres(guide.distance)));
    }
    for (const ExplainedGuide& guide : hair.separated) {
        row(ExplainPanel::tr("Guide %1").arg(guide.id),
            ExplainPanel::tr("beyond a parting, %1 away").arg(millimetres(guide.distance)));
    }
    for (const ExplainedMap& map : hair.maps) {
        row(QString::fromStdString(map.parameter),
            ExplainPanel::tr("%1 from map %2")
                .arg(number(static_cast<double>(map.value), 3), QString::fromStdString(map.map)));
    }
    row(ExplainPanel::tr("Thickness"),
        ExplainPanel::tr("%1 to %2").arg(millimetres(hair.traits.rootWidth), millimetres(hair.traits.tipWidth)));
    const std::vector<glm::vec3>* before = nullptr;
    for (const HairStage& stage : hair.stages) {
        float moved = 0.0f;
        for (std::size_t v = 0; before && v < std::min(before->size(), stage.points.size()); ++v) {
            moved = std::max(moved, glm::distance((*before)[v], stage.points[v]));
        }
        const QString length = ExplainPanel::tr("%1 long").arg(millimetres(lengthOf(stage.points)));
        row(ExplainPanel::tr("After %1").arg(QString::fromStdString(stage.name)),
            before ? ExplainPanel::tr("%1, moved %2").arg(length, millimetres(moved)) : length);
        before = &stage.points;
    }
    const glm::vec3& root = hair.root.position;
    row(ExplainPanel::tr("Root"), QString("%1  %2  %3 m")
                                      .arg(number(static_cast<double>(root.x)), number(static_cast<double>(root.y)),
                                           number(static_cast<double>(root.z))));
    row(ExplainPanel::tr("UV"), QString("%1  %2").arg(number(static_cast<double>(hair.root.uv.x)),
                                                      number(static_cast<double>(hair.root.uv.y))));
    row(ExplainPanel::tr("Triangle"), QString::number(hair.root.point.triangle));
}

}  // namespace

ExplainPanel::ExplainPanel(PanelContext context, Viewport* viewport, QWidget* parent)
    : QWidget(parent),
      m_context(context),
      m_viewport(viewport),
      m_title(new QLabel(this)),
      m_rows(new QTreeWidget(this)) {
    setObjectName("explain_panel");
    m_title->setObjectName("explain_title");
    m_title->setWordWrap(true);
    m_rows->setObjectName("explain_rows");
    m_rows->setAccessibleName(tr("Why the hair is as it is"));
    m_rows->setColumnCount(2);
    m_rows->setHeaderLabels({tr("What"), tr("Value")});
    m_rows->setRootIsDecorated(false);
    m_rows->setAlternatingRowColors(true);
    m_rows->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 8);
    layout->addWidget(m_title);
    layout->addWidget(m_rows, 1);
    connect(&context.document, &Document::changed, this, [this] {
        if (m_hair) request();
    });
    if (viewport) connect(viewport, &Viewport::hairPicked, this, &ExplainPanel::explain);
    explain(std::nullopt);
}

ExplainPanel::~ExplainPanel() = default;

void ExplainPanel::explain(std::optional<std::uint32_t> hair) {
    m_hair = hair;
    if (hair) return request();
    ++m_serial;
    m_rows->clear();
    m_rows->hide();
    m_title->setText(
        tr("Click a hair while no tool is picked (Q): here it says which guides shape it, what the maps say "
           "at its root, and what every step did to it."));
    m_title->setAlignment(Qt::AlignTop);
    if (m_viewport) m_viewport->setHighlight({}, {});
}

void ExplainPanel::request() {
    const std::uint64_t serial = ++m_serial;
    const Groom groom = m_context.document.groom();
    const std::shared_ptr<const Surface> surface = m_context.document.surface();
    if (!surface) return explain(std::nullopt);
    const auto count = static_cast<std::uint32_t>(std::max(groom.counts->shownHairs, 1));
    m_job.submit(
        [this, serial, groom, surface, count, id = *m_hair](Progress& progress) {
            const auto explained =
                std::make_shared<const Result<HairExplanation>>(explainHair(groom, surface, id, count, progress));
            if (progress.cancelled()) return;
            QMetaObject::invokeMethod(
                this, [=, this] { show(serial, groom, explained); }, Qt::QueuedConnection);
        },
        LatestJob::Running::Finish);
}

void ExplainPanel::show(std::uint64_t serial, const Groom& groom, const Explained& explained) {
    // While a stroke goes on, what it was a moment ago is better than nothing; without a hair there is nothing to show.
    if (!m_hair || (serial != m_serial && !m_context.document.previewing())) return;
    m_rows->clear();
    m_rows->setVisible(explained->ok());
    if (!explained->ok()) {
        m_title->setText(QString::fromStdString(explained->error().message));
        if (m_viewport) m_viewport->setHighlight({}, {});
        return;
    }
    const HairExplanation& hair = **explained;
    m_title->setText(hair.grows
                         ? tr("Hair %1").arg(hair.root.id)
                         : tr("Hair %1 does not grow. %2").arg(hair.root.id).arg(QString::fromStdString(hair.why)));
    fill(*m_rows, hair);
    std::vector<std::vector<glm::vec3>> guides;
    for (const ExplainedGuide& guide : hair.guides) {
        if (guide.index >= groom.guides.count()) continue;
        const auto points = groom.guides.points(guide.index);
        guides.emplace_back(points.begin(), points.end());
    }
    const bool grown = hair.grows && !hair.stages.empty();
    if (m_viewport) m_viewport->setHighlight(grown ? hair.stages.back().points : std::vector<glm::vec3>(), guides);
}

}  // namespace whorl
