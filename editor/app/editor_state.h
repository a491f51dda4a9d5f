// SPDX-License-Identifier: Apache-2.0
// What the artist chose in the editor that is not part of the groom: tool, brush, view, active group.
#pragma once

#include "editor/app/options.h"

#include <QObject>

class QSettings;

namespace whorl {

enum class NavigationStyle { Maya, Blender };

/// Shared by viewport, panels and actions; one signal for all of it. Kept between sessions.
class EditorState : public QObject {
    Q_OBJECT

public:
    explicit EditorState(QObject* parent = nullptr);

    /// Null: no brush, the pointer only looks around.
    const BrushInfo* brush() const { return m_brush; }
    void setBrush(const BrushInfo* brush);
    const BrushOptions& brushOptions() const { return m_brushOptions; }
    void setBrushOptions(const BrushOptions& options);
    const ViewOptions& viewOptions() const { return m_viewOptions; }
    void setViewOptions(const ViewOptions& options);
    /// Number of the group that panels show and new guides get; may be past the end after an undo.
    int group() const { return m_group; }
    void setGroup(int group);
    /// Id of the stroke that is picked; 0 for none, may be gone after an undo.
    std::uint32_t pickedStroke() const { return m_pickedStroke; }
    void setPickedStroke(std::uint32_t id);
    NavigationStyle navigation() const { return m_navigation; }
    void setNavigation(NavigationStyle style);

    void load(QSettings& settings);
    void save(QSettings& settings) const;

Q_SIGNALS:
    void changed();

private:
    const BrushInfo* m_brush = nullptr;
    BrushOptions m_brushOptions;
    ViewOptions m_viewOptions;
    int m_group = 0;
    std::uint32_t m_pickedStroke = 0;
    NavigationStyle m_navigation = NavigationStyle::Maya;
};

}  // namespace whorl
