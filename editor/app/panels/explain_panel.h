// SPDX-License-Identifier: Apache-2.0
// Why one hair is as it is.
#pragma once

#include "core/hair/explain.h"
#include "editor/app/latest_job.h"
#include "editor/app/panels/panels.h"

#include <QPointer>
#include <memory>
#include <optional>

class QTreeWidget;

namespace whorl {

class Viewport;

/// Follows the hair that was clicked through every edit: its root, guides, map values and each step of its making. The
/// viewport shows it with its guides.
class ExplainPanel : public QWidget {
    Q_OBJECT

public:
    ExplainPanel(PanelContext context, Viewport* viewport, QWidget* parent = nullptr);
    ~ExplainPanel() override;

    /// Number of the hair in the groom; nothing shows none.
    void explain(std::optional<std::uint32_t> hair);
    std::optional<std::uint32_t> hair() const { return m_hair; }

private:
    using Explained = std::shared_ptr<const Result<HairExplanation>>;
    void request();
    void show(std::uint64_t serial, const Groom& groom, const Explained& explained);

    PanelContext m_context;
    QPointer<Viewport> m_viewport;
    QLabel* m_title;
    QTreeWidget* m_rows;
    std::optional<std::uint32_t> m_hair;
    std::uint64_t m_serial = 0;
    LatestJob m_job;  // last: its thread ends before the rest goes
};

}  // namespace whorl
