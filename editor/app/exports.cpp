// SPDX-License-Identifier: Apache-2.0
#include "editor/app/exports.h"

#include "core/io/hair_file.h"
#include "core/io/image.h"
#include "core/io/package.h"
#include "core/lic/live_texture.h"
#include "editor/app/actions.h"
#include "editor/app/dialogs/bake_dialog.h"
#include "editor/app/document.h"
#include "editor/app/editor_state.h"
#include "editor/app/progress_task.h"
#include "editor/app/viewport/viewport.h"
#include "editor/app/widgets/message_bar.h"
#include "editor/app/widgets/param_source.h"
#include "render/offscreen.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QSettings>
#include <QSpinBox>

namespace whorl {

Exports::Exports(Document& document, EditorState& state, Viewport* viewport, MessageBar& messages, Actions& actions,
                 QWidget& window)
    : QObject(&window),
      m_document(document),
      m_state(state),
      m_viewport(viewport),
      m_messages(messages),
      m_window(window) {
    actions.on("file.export_package", this, [this] { askPackage(); });
    actions.on("file.export_hair", this, [this] { askHair(); });
    actions.on("file.export_lic", this, [this] { askBake(); });
    actions.on("file.render", this, [this] { askPicture(); });
}

QString Exports::startName(const QString& suffix) const {
    std::filesystem::path file = m_document.file();
    if (file.empty()) file = pathOf(QSettings().value("folder").toString()) / "groom";
    return textOf(file.replace_extension(suffix.toStdString()));
}

void Exports::askPackage() {
    const QString name = QFileDialog::getSaveFileName(&m_window, tr("Export package"), startName("groom"),
                                                      tr("Groom packages (*.groom)"));
    if (!name.isEmpty()) exportPackage(pathOf(name));
}

void Exports::askHair() {
    QStringList filters;
    for (const HairFormat& format : hairFormats()) {
        filters.push_back(QString("%1 (*.%2)").arg(qtext(format.label), qtext(format.suffix)));
    }
    if (filters.isEmpty()) return;
    QString chosen;
    QString name =
        QFileDialog::getSaveFileName(&m_window, tr("Export hair"), startName({}), filters.join(";;"), &chosen);
    if (name.isEmpty()) return;
    if (!hairFormatFor(pathOf(name))) {
        const qsizetype index = std::max<qsizetype>(filters.indexOf(chosen), 0);
        name += '.' + qtext(hairFormats()[static_cast<std::size_t>(index)].suffix);
    }
    exportHair(pathOf(name));
}

void Exports::askBake() {
    BakeDialog dialog(&m_window);
    if (dialog.exec() != QDialog::Accepted) return;
    dialog.remember();
    BakeRequest request = dialog.request();
    const QString name = QFileDialog::getSaveFileName(&m_window, tr("Bake hair texture: name before _colour and so on"),
                                                      startName({}), tr("Images (*.png *.exr)"));
    if (name.isEmpty()) return;
    request.file = pathOf(name);
    bakeLic(request);
}

void Exports::askPicture() {
    QDialog dialog(&m_window);
    dialog.setObjectName("render_dialog");
    dialog.setWindowTitle(tr("Render picture"));
    auto* form = new QFormLayout(&dialog);
    const auto size = [&](const char* name, const QString& label, int value) {
        auto* box = new QSpinBox(&dialog);
        box->setObjectName(name);
        box->setRange(16, 8192);
        box->setValue(value);
        box->setSuffix(tr(" px"));
        form->addRow(label, box);
        return box;
    };
    QSpinBox* width = size("render_width", tr("Width"), 1920);
    QSpinBox* height = size("render_height", tr("Height"), 1080);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, &dialog);
    connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    form->addRow(buttons);
    if (dialog.exec() != QDialog::Accepted) return;
    const QString name = QFileDialog::getSaveFileName(&m_window, tr("Render picture"), startName("png"),
                                                      tr("Pictures (*.png *.jpg *.tif *.exr)"));
    if (!name.isEmpty()) renderPicture(pathOf(name), width->value(), height->value());
}

bool Exports::exportPackage(const std::filesystem::path& wanted, std::uint32_t parts) {
    std::filesystem::path folder = wanted;
    if (folder.extension() != ".groom") folder += ".groom";
    const Groom groom = m_document.committed();
    const QString name = textOf(folder.filename());
    const std::shared_ptr<const Surface> surface = m_document.surface();
    const Result<void> done = runWithProgress<void>(&m_window, tr("Exporting %1").arg(name), [&](Progress& progress) {
        return whorl::exportPackage(groom, folder, parts, progress, surface);
    });
    if (done)
        m_messages.say(MessageBar::Kind::Info, tr("Exported %1.").arg(name));
    else if (!done.error().cancelled)
        m_messages.say(MessageBar::Kind::Error, QString::fromStdString(done.error().message));
    return done.ok();
}

bool Exports::exportHair(const std::filesystem::path& file) {
    const Groom groom = m_document.committed();
    const QString name = textOf(file.filename());
    const std::shared_ptr<const Surface> surface = m_document.surface();
    const Result<std::uint64_t> done = runWithProgress<std::uint64_t>(
        &m_window, tr("Exporting %1").arg(name),
        [&](Progress& progress) { return writeHair(groom, {}, file, progress, surface); });
    if (done)
        m_messages.say(MessageBar::Kind::Info, tr("Exported %1.").arg(name));
    else if (!done.error().cancelled)
        m_messages.say(MessageBar::Kind::Error, QString::fromStdString(done.error().message));
    return done.ok();
}

bool Exports::bakeLic(const BakeRequest& request) {
    const Groom groom = m_document.committed();
    const std::shared_ptr<const Surface> surface = m_document.surface();
    if (!surface) return false;
    using Files = std::vector<std::filesystem::path>;
    const Result<Files> done =
        runWithProgress<Files>(&m_window, tr("Baking %1").arg(textOf(request.file.filename())),
                               [&](Progress& progress) { return bakeToFiles(groom, surface, request, progress); });
    if (done) {
        QStringList names;
        for (const std::filesystem::path& file : *done) names.push_back(textOf(file.filename()));
        m_messages.say(MessageBar::Kind::Info, tr("Baked %1.").arg(names.join(", ")));
    } else if (!done.error().cancelled) {
        m_messages.say(MessageBar::Kind::Error, QString::fromStdString(done.error().message));
    }
    return done.ok();
}

bool Exports::renderPicture(const std::filesystem::path& file, int width, int height) {
    const Groom groom = m_document.committed();
    const std::shared_ptr<const Surface> surface = m_document.surface();
    if (!surface) return false;
    ViewSettings settings = m_state.viewOptions().settings();
    settings.showGuides = false;
    const int licSize = m_state.viewOptions().licSize();
    Result<Camera> camera = m_viewport ? Result<Camera>(m_viewport->camera())
                                       : Camera::named("three-quarter", surface->bounds, {width, height});
    const QString name = textOf(file.filename());
    const Result<void> done =
        runWithProgress<void>(&m_window, tr("Rendering %1").arg(name), [&](Progress& progress) -> Result<void> {
            if (!camera) return camera.error();
            std::shared_ptr<const Strands> strands;
            if (settings.showHair) {
                Generator generator;
                generator.setSurface(surface);
                Result<Strands> made = generator.generate(groom, {}, progress);
                if (!made) return made.error();
                strands = std::make_shared<const Strands>(std::move(*made));
            }
            std::shared_ptr<const LicImage> texture;
            if (settings.showLic) {
                auto made = LiveTexture().update(groom, surface, licSize, progress);
                if (!made) return made.error();
                texture = LicImage::make(std::move(*made));
            }
            Result<OffscreenRenderer> offscreen = OffscreenRenderer::create();
            if (!offscreen) return offscreen.error();
            offscreen->renderer().setGroom(groom, surface);
            offscreen->renderer().setStrands(strands);
            offscreen->renderer().setLicImage(texture);
            const Picture picture = offscreen->draw(*camera, settings, {}, width, height);
            return writePixels(picture.pixels, picture.width, picture.height, 4, file);
        });
    if (done)
        m_messages.say(MessageBar::Kind::Info, tr("Rendered %1.").arg(name));
    else if (!done.error().cancelled)
        m_messages.say(MessageBar::Kind::Error, QString::fromStdString(done.error().message));
    return done.ok();
}

}  // namespace whorl
