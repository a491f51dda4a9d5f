// SPDX-License-Identifier: Apache-2.0
#include "editor/app/viewport/viewport_area.h"

#include "editor/app/actions.h"
#include "editor/app/document.h"
#include "editor/app/viewport/viewport.h"
#include "editor/app/widgets/message_bar.h"

#include <QEvent>
#include <QLabel>
#include <QMenu>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QPushButton>
#include <QStackedLayout>
#include <QVBoxLayout>
#include <algorithm>

namespace whorl {
namespace {

/// Asked before a QOpenGLWidget is made: on a machine without GL that would stop the whole window from showing.
QString glProblem() {
    if (!qEnvironmentVariableIsEmpty("WHORL_NO_GL")) return ViewportArea::tr("OpenGL is switched off by WHORL_NO_GL.");
    QSurfaceFormat format;
    format.setRenderableType(QSurfaceFormat::OpenGL);
    format.setVersion(4, 5);
    format.setProfile(QSurfaceFormat::CoreProfile);
    QOpenGLContext context;
    context.setFormat(format);
    QOffscreenSurface surface;
    surface.setFormat(format);
    surface.create();
    if (!context.create() || !context.makeCurrent(&surface)) {
        return ViewportArea::tr("This machine offers no OpenGL.");
    }
    const QSurfaceFormat got = context.format();
    context.doneCurrent();
    if (got.version() < std::pair(4, 5)) {
        return ViewportArea::tr("This machine offers OpenGL %1.%2; Whorl draws with 4.5.")
            .arg(got.majorVersion())
            .arg(got.minorVersion());
    }
    return {};
}

}  // namespace

ViewportArea::ViewportArea(Document& document, EditorState& state, Actions& actions, QWidget* parent)
    : QWidget(parent),
      m_document(document),
      m_messages(new MessageBar(this)),
      m_stack(new QWidget(this)),
      m_pages(new QStackedLayout(m_stack)),
      m_problemPage(new QLabel(m_stack)) {
    setObjectName("viewport_area");
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_stack, 1);
    m_problemPage->setObjectName("no_gl");
    m_problemPage->setAccessibleName(tr("Why nothing is drawn"));
    m_problemPage->setAlignment(Qt::AlignCenter);
    m_problemPage->setWordWrap(true);
    m_problemPage->setMargin(48);
    m_pages->addWidget(m_problemPage);
    const QString problem = glProblem();
    if (problem.isEmpty()) {
        m_viewport = new Viewport(document, state, m_stack);
        m_pages->addWidget(m_viewport);
        m_pages->setCurrentWidget(m_viewport);
        connect(m_viewport, &Viewport::failed, this, &ViewportArea::showProblem, Qt::QueuedConnection);
        connect(m_viewport, &Viewport::said, this,
                [this](const QString& sentence) { m_messages->say(MessageBar::Kind::Warning, sentence); });
    } else {
        showProblem(problem);
    }
    m_welcome = makeWelcome(actions);
    m_messages->installEventFilter(this);
    connect(&m_document, &Document::changed, this, [this] { m_welcome->setVisible(!m_document.hasGroom()); });
}

void ViewportArea::showProblem(const QString& sentence) {
    m_problem = sentence;
    m_problemPage->setText(tr("Nothing can be drawn here.\n%1\n\nOpening, saving and exporting work as ever. With a "
                              "newer graphics driver the view comes back.")
                               .arg(sentence));
    m_pages->setCurrentWidget(m_problemPage);
}

QWidget* ViewportArea::makeWelcome(Actions& actions) {
    auto* welcome = new QWidget(m_stack);
    welcome->setObjectName("welcome");
    welcome->setAccessibleName(tr("Welcome"));
    auto* title = new QLabel(tr("Open a head or an animal,\nor drop a file here"), welcome);
    title->setObjectName("welcome_title");
    title->setAlignment(Qt::AlignCenter);
    QFont font = title->font();
    font.setPointSizeF(font.pointSizeF() * 1.9);
    title->setFont(font);
    auto* formats = new QLabel(tr("Documents (.whorl), packages (.groom), meshes (.glb, .gltf, .obj, .ply)"), welcome);
    formats->setAlignment(Qt::AlignCenter);
    formats->setEnabled(false);
    auto* open = new QPushButton(tr("Open…"), welcome);
    open->setObjectName("welcome_open");
    open->setDefault(true);
    connect(open, &QPushButton::clicked, &actions.get("file.open"), &QAction::trigger);
    open->setMinimumSize(150, 36);
    auto* samples = new QHBoxLayout;
    samples->setSpacing(8);
    QAction* sampleAction = &actions.get("file.sample");
    const auto fill = [=] {
        while (QLayoutItem* item = samples->takeAt(0)) {
            delete item->widget();
            delete item;
        }
        const QList<QAction*> found = sampleAction->menu() ? sampleAction->menu()->actions() : QList<QAction*>{};
        if (found.isEmpty()) return;
        samples->addStretch();
        samples->addWidget(new QLabel(tr("or open a sample:"), welcome));
        for (QAction* action : found) {
            auto* button = new QPushButton(action->text(), welcome);
            button->setObjectName("welcome_" + action->objectName());
            connect(button, &QPushButton::clicked, action, &QAction::trigger);
            samples->addWidget(button);
        }
        samples->addStretch();
    };
    connect(sampleAction, &QAction::changed, welcome, fill);
    fill();
    auto* buttons = new QHBoxLayout;
    buttons->addStretch();
    buttons->addWidget(open);
    buttons->addStretch();
    auto* layout = new QVBoxLayout(welcome);
    layout->setSpacing(14);
    layout->addStretch();
    layout->addWidget(title);
    layout->addWidget(formats);
    layout->addSpacing(6);
    layout->addLayout(buttons);
    layout->addLayout(samples);
    layout->addStretch();
    return welcome;
}

bool ViewportArea::eventFilter(QObject* watched, QEvent* event) {
    // The bar lies over the view: in the layout it would move the picture under the artist's hand.
    if (watched == m_messages && (event->type() == QEvent::Show || event->type() == QEvent::LayoutRequest))
        placeMessages();
    return QWidget::eventFilter(watched, event);
}

void ViewportArea::placeMessages() {
    const int wide = width();
    m_messages->setGeometry(0, 0, wide, std::max(m_messages->heightForWidth(wide), m_messages->sizeHint().height()));
    m_messages->raise();
}

void ViewportArea::placeWelcome() {
    // Over the viewport, which stays visible behind it.
    m_welcome->setGeometry(m_stack->rect());
    m_welcome->raise();
    m_welcome->setVisible(!m_document.hasGroom());
}

void ViewportArea::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    layout()->activate();
    placeWelcome();
    placeMessages();
}

}  // namespace whorl
