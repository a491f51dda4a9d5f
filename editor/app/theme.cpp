// SPDX-License-Identifier: Apache-2.0
#include "editor/app/theme.h"

#include <QApplication>
#include <QPalette>
#include <QStyleFactory>

namespace whorl {
namespace {

struct Colours {
    const char* window;
    const char* base;
    const char* button;
    const char* text;
    const char* quiet;
    const char* line;
    const char* accent;
    const char* onAccent;
};

constexpr Colours dark{"#25272b", "#1a1c1f", "#32353b", "#dcdfe3", "#868c96", "#3c4047", "#d19a66", "#1b1510"};
constexpr Colours light{"#eceae7", "#fbfaf9", "#e2dfdb", "#26231f", "#7d7770", "#c9c4bd", "#b06a2c", "#ffffff"};

QPalette paletteOf(const Colours& c) {
    QPalette palette;
    const auto set = [&](QPalette::ColorRole role, const char* colour) { palette.setColor(role, QColor(colour)); };
    set(QPalette::Window, c.window);
    set(QPalette::WindowText, c.text);
    set(QPalette::Base, c.base);
    set(QPalette::AlternateBase, c.window);
    set(QPalette::Text, c.text);
    set(QPalette::Button, c.button);
    set(QPalette::ButtonText, c.text);
    set(QPalette::BrightText, c.accent);
    set(QPalette::Highlight, c.accent);
    set(QPalette::HighlightedText, c.onAccent);
    set(QPalette::ToolTipBase, c.base);
    set(QPalette::ToolTipText, c.text);
    set(QPalette::PlaceholderText, c.quiet);
    set(QPalette::Link, c.accent);
    set(QPalette::Mid, c.line);
    set(QPalette::Light, c.line);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
        palette.setColor(QPalette::Disabled, role, QColor(c.quiet));
    }
    palette.setColor(QPalette::Disabled, QPalette::Highlight, QColor(c.line));
    return palette;
}

// Only what the palette can not say: spacing, flat bars and quiet tabs.
constexpr const char* sheet = R"(
QToolTip { border: 1px solid palette(mid); padding: 4px; }
QMainWindow::separator { width: 5px; height: 5px; background: palette(window); }
QToolBar { border: none; spacing: 3px; padding: 4px; }
QToolBar QToolButton { padding: 4px; border-radius: 4px; border: 1px solid transparent; }
QToolBar QToolButton:hover { background: palette(button); }
QToolBar QToolButton:checked { background: palette(highlight); color: palette(highlighted-text); }
QDockWidget { font-weight: 600; }
QDockWidget::title { padding: 5px 8px; background: palette(window); }
QTabBar::tab { padding: 6px 11px; border: none; color: palette(placeholder-text); }
QTabBar::tab:selected { color: palette(text); border-bottom: 2px solid palette(highlight); }
QTabBar::tab:hover { color: palette(text); }
QStatusBar::item { border: none; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QScrollArea { border: none; }
QListView::item, QTreeView::item { padding: 3px; }
QMenu { padding: 4px; }
QMenu::item { padding: 5px 26px 5px 14px; border-radius: 3px; }
QMenu::item:selected { background: palette(highlight); color: palette(highlighted-text); }
QMenu::item:disabled { color: palette(placeholder-text); }
QMenu::separator { height: 1px; background: palette(mid); margin: 4px 8px; }
QMenu::icon { padding-left: 6px; }
)";

}  // namespace

void applyTheme(QApplication& application, Theme theme) {
    application.setStyle(QStyleFactory::create("Fusion"));
    application.setPalette(paletteOf(theme == Theme::Dark ? dark : light));
    application.setStyleSheet(sheet);
}

}  // namespace whorl
