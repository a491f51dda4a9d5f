// SPDX-License-Identifier: Apache-2.0
#include "editor/app/main_window.h"

#include "editor/app/actions.h"
#include "editor/app/autosave.h"
#include "editor/app/dialogs/dialogs.h"
#include "editor/app/exports.h"
#include "editor/app/files.h"
#include "editor/app/groom_actions.h"
#include "editor/app/icons.h"
#include "editor/app/panels/explain_panel.h"
#include "editor/app/panels/field_panel.h"
#include "editor/app/panels/panels.h"
#include "editor/app/resources.h"
#include "editor/app/viewport/viewport.h"
#include "editor/app/viewport/viewport_area.h"
#include "editor/app/widgets/message_bar.h"
#include "editor/app/widgets/param_source.h"

#include <QCloseEvent>
#include <QDockWidget>
#include <QDropEvent>
#include <QLabel>
#include <QMenuBar>
#include <QMimeData>
#include <QSettings>
#include <QStatusBar>
#include <QToolBar>
#include <QWhatsThis>

namespace whorl {
namespace {

constexpr int layoutVersion = 1;

}  // namespace

MainWindow::MainWindow(const std::filesystem::path& journals)
    : m_actions(new Actions(*this)),
      m_area(new ViewportArea(m_document, m_state, *m_actions, this)),
      m_files(new Files(m_document, m_area->messages(), *this)),
      m_exports(new Exports(m_document, m_state, m_area->viewport(), m_area->messages(), *m_actions, *this)),
      m_groomActions(new GroomActions(m_document, m_state, *m_actions, m_area->messages(), *this)),
      m_autosave(new Autosave(m_document, journals, this)),
      m_journals(journals) {
    setObjectName("main_window");
    setWindowIcon(programIcon());
    setAcceptDrops(true);
    setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
    setCentralWidget(m_area);
    new ViewActions(m_state, *m_actions, m_area->viewport(), *this);
    makeSamples();
    makeMenus();
    makeBars();
    makePanels();
    makeStatusBar();
    connectActions();
    connect(&m_document, &Document::changed, this, &MainWindow::documentChanged);
    connect(m_autosave, &Autosave::failed, this,
            [this](const QString& sentence) { m_area->messages().say(MessageBar::Kind::Warning, sentence); });
    connect(m_files, &Files::journalObsolete, m_autosave, &Autosave::discard);

    QSettings settings;
    m_state.load(settings);
    m_document.setUndoBytes(undoBytesInSettings());
    resize(1440, 900);
    restoreGeometry(settings.value("window/geometry").toByteArray());
    restoreState(settings.value("window/layout").toByteArray(), layoutVersion);
    documentChanged();
}

MainWindow::~MainWindow() {
    // The viewport and the panels speak with document and state, which go before the base class deletes widgets.
    delete takeCentralWidget();
    for (QDockWidget* dock : findChildren<QDockWidget*>()) delete dock;
    delete m_autosave;
    delete m_groomActions;
}

Viewport* MainWindow::viewport() {
    return m_area->viewport();
}

void MainWindow::makeMenus() {
    for (const QString& category : actionCategories()) {
        QMenu* menu = menuBar()->addMenu('&' + category);
        menu->setObjectName("menu_" + category.toLower());
        for (const ActionInfo& row : m_actions->table()) {
            if (row.category != category || row.kind == ActionInfo::Held) continue;
            menu->addAction(&m_actions->get(row.id));
            if (row.id == "file.open") {
                m_recent = menu->addMenu(tr("Open &Recent"));
                m_recent->setObjectName("menu_recent");
                connect(m_recent, &QMenu::aboutToShow, this, &MainWindow::fillRecent);
            }
            if (row.separatorAfter) menu->addSeparator();
        }
    }
}

void MainWindow::makeSamples() {
    m_samples = new QMenu(this);
    m_samples->setObjectName("menu_samples");
    for (const std::filesystem::path& file : sampleFiles()) {
        QAction* action = m_samples->addAction(sampleName(file), this, [this, file] { m_files->openSample(file); });
        action->setObjectName("sample_" + textOf(file.stem()));
    }
    QAction& action = m_actions->get("file.sample");
    action.setMenu(m_samples);
    action.setEnabled(!m_samples->isEmpty());
}

void MainWindow::makeBars() {
    auto* top = addToolBar(tr("Main"));
    top->setObjectName("main_bar");
    top->setMovable(false);
    top->setIconSize({20, 20});
    for (const char* id :
         {"file.new", "file.open", "file.save", "", "edit.undo", "edit.redo", "", "groom.place_guides",
          "groom.paint_density", "", "brush.mirror", "view.all", "", "file.render", "file.export_package"}) {
        *id ? top->addAction(&m_actions->get(id)) : static_cast<void>(top->addSeparator());
    }
    auto* tools = new QToolBar(tr("Tools"), this);
    tools->setObjectName("tool_bar");
    tools->setIconSize({26, 26});
    tools->setMovable(false);
    for (const ActionInfo& row : m_actions->table()) {
        if (row.kind != ActionInfo::ToolPick) continue;
        tools->addAction(&m_actions->get(row.id));
        if (row.id == "tool.look") tools->addSeparator();
    }
    addToolBar(Qt::LeftToolBarArea, tools);
    for (QToolBar* bar : {top, tools}) {
        for (QAction* action : bar->actions()) {
            QWidget* button = bar->widgetForAction(action);
            if (!button || action->isSeparator()) continue;
            button->setObjectName("button_" + action->objectName());
            button->setAccessibleName(Actions::plainText(m_actions->info(action->objectName())));
        }
    }
}

void MainWindow::makePanels() {
    const PanelContext context{m_document, m_state, *m_actions, m_area->messages()};
    const auto dock = [&](const char* name, const QString& title, QWidget* panel) {
        auto* widget = new QDockWidget(title, this);
        widget->setObjectName(name);
        widget->setFeatures(QDockWidget::NoDockWidgetFeatures);
        // The tabs and the panels themselves say what they are.
        widget->setTitleBarWidget(new QWidget(widget));
        widget->setWidget(panel);
        panel->setMinimumWidth(380);
        addDockWidget(Qt::RightDockWidgetArea, widget);
        return widget;
    };
    QDockWidget* tool = dock("dock_tool", tr("Tool"), scrolled(new ToolPanel(context)));
    QDockWidget* groom = dock("dock_groom", tr("Groom"), scrolled(new GroomPanel(context)));
    QDockWidget* hair = dock("dock_hair", tr("Hair"), new HairPanel(context));
    QDockWidget* field = dock("dock_field", tr("Field"), new FieldPanel(context));
    QDockWidget* maps = dock("dock_maps", tr("Maps"), new MapsPanel(context));
    QDockWidget* parts = dock("dock_parts", tr("Parts"), new PartsPanel(context));
    QDockWidget* view = dock("dock_view", tr("View"), new ViewPanel(context));
    QDockWidget* history = dock("dock_history", tr("History"), new HistoryPanel(context));
    QDockWidget* why = dock("dock_explain", tr("Why"), new ExplainPanel(context, viewport()));
    splitDockWidget(tool, groom, Qt::Vertical);
    for (QDockWidget* next : {view, history, why}) tabifyDockWidget(tool, next);
    for (QDockWidget* next : {hair, field, maps, parts}) tabifyDockWidget(groom, next);
    setTabPosition(Qt::RightDockWidgetArea, QTabWidget::North);
    tool->raise();
    groom->raise();
    // A tool that is picked shows its settings; one that draws strokes also what is made of them.
    for (const BrushInfo& brush : brushes()) {
        const QAction& action = m_actions->get("tool." + qtext(brush.id));
        connect(&action, &QAction::triggered, tool, &QWidget::raise);
        if (brush.drawsStrokes) connect(&action, &QAction::triggered, field, &QWidget::raise);
    }
    if (viewport()) {
        connect(viewport(), &Viewport::hairPicked, why, [why](std::optional<std::uint32_t> picked) {
            if (picked) why->raise();
        });
    }
    resizeDocks({tool, groom}, {330, 520}, Qt::Vertical);
    resizeDocks({tool}, {390}, Qt::Horizontal);
}

void MainWindow::makeStatusBar() {
    m_hint = new QLabel(this);
    m_hint->setObjectName("hint");
    m_hint->setAccessibleName(tr("What the pointer does now"));
    m_hint->setContentsMargins(8, 0, 8, 0);
    statusBar()->addWidget(m_hint, 1);
    statusBar()->setSizeGripEnabled(false);
    if (Viewport* view = viewport()) {
        connect(view, &Viewport::hintChanged, m_hint, &QLabel::setText);
        m_hint->setText(view->hint());
    }
}

void MainWindow::connectActions() {
    Actions& a = *m_actions;
    a.on("file.new", this, [this] { m_files->openAsked(true); });
    a.on("file.open", this, [this] { m_files->openAsked(false); });
    // As a submenu it opens by itself; from the list of actions or by a key it opens here.
    a.on("file.sample", this, [this] { m_samples->popup(mapToGlobal(rect().center() / 2)); });
    a.on("file.save", this, [this] { m_files->save(); });
    a.on("file.save_as", this, [this] { m_files->saveAs(); });
    a.on("file.quit", this, [this] { close(); });
    a.on("edit.palette", this, [this] {
        auto* palette = new CommandPalette(*m_actions, this);
        palette->setAttribute(Qt::WA_DeleteOnClose);
        palette->show();
    });
    a.on("edit.shortcuts", this, [this] { ShortcutDialog(*m_actions, this).exec(); });
    a.on("edit.preferences", this, [this] { PreferencesDialog(m_document, m_state, this).exec(); });
    a.on("help.keys", this, [this] {
        auto* help = new HelpDialog(*m_actions, this);
        help->setAttribute(Qt::WA_DeleteOnClose);
        help->show();
    });
    a.on("help.whats_this", this, [] { QWhatsThis::enterWhatsThisMode(); });
    a.on("help.about", this, [this] { showAbout(this); });
    a.onToggle("view.panels", this, [this](bool hide) { hidePanels(hide); });
    if (viewport()) a.attachViewport(*viewport());
}

void MainWindow::fillRecent() {
    m_recent->clear();
    for (const QString& file : m_files->recent()) {
        QAction* action =
            m_recent->addAction(textOf(pathOf(file).filename()), this, [this, file] { m_files->open(pathOf(file)); });
        action->setObjectName("recent_file");
        action->setToolTip(file);
        action->setStatusTip(file);
    }
    if (m_recent->isEmpty())
        m_recent->addAction(tr("None yet"))->setEnabled(false);
    else {
        m_recent->addSeparator();
        m_recent->addAction(tr("Forget all"), m_files, &Files::clearRecent);
    }
}

void MainWindow::hidePanels(bool hide) {
    if (hide) {
        QList<QWidget*> widgets;
        for (QDockWidget* dock : findChildren<QDockWidget*>()) widgets.push_back(dock);
        for (QToolBar* bar : findChildren<QToolBar*>()) widgets.push_back(bar);
        for (QWidget* widget : widgets) {
            if (widget->isHidden()) continue;
            widget->hide();
            m_hidden.push_back(widget);
        }
    } else {
        for (QWidget* widget : m_hidden) widget->show();
        m_hidden.clear();
    }
    m_actions->get("view.panels").setChecked(hide);
}

void MainWindow::documentChanged() {
    setWindowTitle(m_document.hasGroom() ? tr("%1[*]").arg(m_document.shownName()) : tr("Whorl"));
    setWindowModified(m_document.hasGroom() && !m_document.clean());
}

bool MainWindow::offerRecovery() {
    std::vector<Recovery> found = findRecoveries(m_journals);
    if (found.empty()) return false;
    return RecoveryDialog(std::move(found), *m_files, this).exec() == QDialog::Accepted;
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!m_files->mayDiscard()) {
        event->ignore();
        return;
    }
    m_autosave->discard();
    hidePanels(false);
    QSettings settings;
    settings.setValue("window/geometry", saveGeometry());
    settings.setValue("window/layout", saveState(layoutVersion));
    m_state.save(settings);
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    const QList<QUrl> urls = event->mimeData()->urls();
    if (urls.size() == 1 && urls.front().isLocalFile()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    const QString file = event->mimeData()->urls().value(0).toLocalFile();
    event->acceptProposedAction();
    // Opened when the drop is over: the program that the file came from would wait for our dialogs.
    QMetaObject::invokeMethod(
        this, [this, file] { m_files->open(pathOf(file)); }, Qt::QueuedConnection);
}

}  // namespace whorl
