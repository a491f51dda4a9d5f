// SPDX-License-Identifier: Apache-2.0
#include "editor/app/editor_state.h"

#include <QSettings>

namespace whorl {
namespace {

QString keyOf(const char* block, const ParamRef& param) {
    return QString::fromLatin1(block) + '/' +
           QString::fromUtf8(param.info.id.data(), static_cast<qsizetype>(param.info.id.size()));
}

/// Values that a newer or broken settings file holds are left at their defaults.
template <class Block>
void loadBlock(QSettings& settings, const char* name, Block& block) {
    for (const ParamRef& param : paramsOf(block)) {
        const QVariant text = settings.value(keyOf(name, param));
        if (!text.isValid() || std::holds_alternative<MapName*>(param.target)) continue;
        const Result<void> done = setParamValue(param, text.toString().toStdString());
        if (!done) settings.remove(keyOf(name, param));
    }
}

template <class Block>
void saveBlock(QSettings& settings, const char* name, Block block) {
    for (const ParamRef& param : paramsOf(block)) {
        settings.setValue(keyOf(name, param), QString::fromStdString(paramText(paramValue(param))));
    }
}

}  // namespace

EditorState::EditorState(QObject* parent) : QObject(parent) {}

void EditorState::setBrush(const BrushInfo* brush) {
    if (m_brush == brush) return;
    m_brush = brush;
    Q_EMIT changed();
}

void EditorState::setBrushOptions(const BrushOptions& options) {
    if (m_brushOptions == options) return;
    m_brushOptions = options;
    Q_EMIT changed();
}

void EditorState::setViewOptions(const ViewOptions& options) {
    if (m_viewOptions == options) return;
    m_viewOptions = options;
    Q_EMIT changed();
}

void EditorState::setGroup(int group) {
    if (m_group == group) return;
    m_group = group;
    Q_EMIT changed();
}

void EditorState::setPickedStroke(std::uint32_t id) {
    if (id == m_pickedStroke) return;
    m_pickedStroke = id;
    Q_EMIT changed();
}

void EditorState::setNavigation(NavigationStyle style) {
    if (m_navigation == style) return;
    m_navigation = style;
    Q_EMIT changed();
}

void EditorState::load(QSettings& settings) {
    loadBlock(settings, "brush", m_brushOptions);
    loadBlock(settings, "view", m_viewOptions);
    m_navigation =
        settings.value("navigation").toString() == "blender" ? NavigationStyle::Blender : NavigationStyle::Maya;
    Q_EMIT changed();
}

void EditorState::save(QSettings& settings) const {
    saveBlock(settings, "brush", m_brushOptions);
    saveBlock(settings, "view", m_viewOptions);
    settings.setValue("navigation", m_navigation == NavigationStyle::Blender ? "blender" : "maya");
}

}  // namespace whorl
