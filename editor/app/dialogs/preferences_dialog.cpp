// SPDX-License-Identifier: Apache-2.0
#include "editor/app/dialogs/dialogs.h"
#include "editor/app/document.h"
#include "editor/app/editor_state.h"

#include <QApplication>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QSettings>
#include <QSpinBox>
#include <algorithm>

namespace whorl {

Theme themeInSettings() {
    return QSettings().value("theme").toString() == "light" ? Theme::Light : Theme::Dark;
}

std::size_t undoBytesInSettings() {
    const int megabytes = QSettings().value("undo_megabytes", 512).toInt();
    return static_cast<std::size_t>(std::clamp(megabytes, 16, 65536)) << 20;
}

PreferencesDialog::PreferencesDialog(Document& document, EditorState& state, QWidget* parent) : QDialog(parent) {
    setObjectName("preferences_dialog");
    setWindowTitle(tr("Preferences"));
    auto* navigation = new QComboBox(this);
    navigation->setObjectName("preferences_navigation");
    navigation->addItems({tr("Maya: Alt + left, middle, right"), tr("Blender: middle, Shift, Ctrl")});
    navigation->setCurrentIndex(state.navigation() == NavigationStyle::Maya ? 0 : 1);
    connect(navigation, &QComboBox::activated, this, [&state](int index) {
        state.setNavigation(index == 0 ? NavigationStyle::Maya : NavigationStyle::Blender);
    });
    auto* theme = new QComboBox(this);
    theme->setObjectName("preferences_theme");
    theme->addItems({tr("Dark"), tr("Light")});
    theme->setCurrentIndex(themeInSettings() == Theme::Dark ? 0 : 1);
    connect(theme, &QComboBox::activated, this, [](int index) {
        QSettings().setValue("theme", index == 0 ? "dark" : "light");
        applyTheme(*qApp, themeInSettings());
    });
    auto* memory = new QSpinBox(this);
    memory->setObjectName("preferences_undo");
    memory->setRange(16, 65536);
    memory->setSuffix(tr(" MB"));
    memory->setValue(static_cast<int>(undoBytesInSettings() >> 20));
    connect(memory, &QSpinBox::valueChanged, this, [&document](int megabytes) {
        QSettings().setValue("undo_megabytes", megabytes);
        document.setUndoBytes(undoBytesInSettings());
    });
    auto* form = new QFormLayout(this);
    form->addRow(tr("Moving the view"), navigation);
    form->addRow(tr("Theme"), theme);
    form->addRow(tr("Undo memory"), memory);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    form->addRow(buttons);
}

}  // namespace whorl
