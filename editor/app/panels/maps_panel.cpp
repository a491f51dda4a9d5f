// SPDX-License-Identifier: Apache-2.0
#include "core/commands/group_edits.h"
#include "core/io/image.h"
#include "editor/app/document.h"
#include "editor/app/editor_state.h"
#include "editor/app/panels/group_swatch.h"
#include "editor/app/panels/panels.h"
#include "editor/app/progress_task.h"
#include "editor/app/widgets/message_bar.h"

#include <QFileDialog>
#include <QGridLayout>
#include <QInputDialog>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

namespace whorl {
namespace {

constexpr int thumbnail = 56;

// `groups`: the map holds numbers of groups, which would all look black.
QIcon pictureOf(const Map& map, bool groups) {
    QImage image(thumbnail, thumbnail, QImage::Format_RGB32);
    for (int y = 0; y < thumbnail; ++y) {
        for (int x = 0; x < thumbnail; ++x) {
            const int column = x * map.width() / thumbnail;
            const int row = y * map.height() / thumbnail;
            const auto byte = [&](int channel) {
                return static_cast<int>(std::clamp(map.texel(column, row, channel), 0.0f, 1.0f) * 255.0f + 0.5f);
            };
            if (groups) {
                image.setPixel(x, y, groupRgb(static_cast<int>(std::lround(map.texel(column, row) * 255.0f))));
                continue;
            }
            const bool colour = map.channels() == 3;
            image.setPixel(x, y, qRgb(byte(0), byte(colour ? 1 : 0), byte(colour ? 2 : 0)));
        }
    }
    return QIcon(QPixmap::fromImage(image));
}

QString factsOf(const Map& map) {
    const QString format = map.format() == TexelFormat::U8    ? "8 bit"
                           : map.format() == TexelFormat::U16 ? "16 bit"
                                                              : "float";
    return MapsPanel::tr("%1 × %2, %3, %4%5")
        .arg(map.width())
        .arg(map.height())
        .arg(format, map.channels() == 3 ? MapsPanel::tr("colour") : MapsPanel::tr("data"),
             map.flipV ? MapsPanel::tr(", upside down") : QString());
}

}  // namespace

MapsPanel::MapsPanel(PanelContext context, QWidget* parent)
    : QWidget(parent), m_context(context), m_list(new QListWidget(this)), m_buttons(new QWidget(this)) {
    setObjectName("maps_panel");
    m_list->setObjectName("map_list");
    m_list->setAccessibleName(tr("Maps"));
    m_list->setIconSize({thumbnail, thumbnail});
    m_list->setSpacing(2);
    m_list->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
    auto* grid = new QGridLayout(m_buttons);
    grid->setContentsMargins(0, 0, 0, 0);
    int place = 0;
    const auto button = [&](const char* name, const QString& text, const QString& tip, auto slot) {
        auto* b = new QPushButton(text, m_buttons);
        b->setObjectName(name);
        b->setToolTip(tip);
        connect(b, &QPushButton::clicked, this, slot);
        grid->addWidget(b, place / 3, place % 3);
        ++place;
    };
    button("map_add", tr("New"), tr("A white map of 1024 × 1024"), [this] { add(); });
    button("map_load", tr("Load…"), tr("Reads an image as a map"), [this] {
        const QString file =
            QFileDialog::getOpenFileName(window(), tr("Load a map"), {},
                                         tr("Images (*.png *.exr *.tif *.tiff *.jpg *.jpeg *.tga *.bmp *.pfm *.hdr)"));
        if (!file.isEmpty()) load(file, false);
    });
    button("map_save", tr("Save…"), tr("Writes the chosen map as an image"), [this] {
        const QString file =
            QFileDialog::getSaveFileName(window(), tr("Save the map"), QString::fromStdString(current()) + ".png",
                                         tr("Images (*.png *.exr *.tif *.jpg *.tga)"));
        if (!file.isEmpty()) save(file);
    });
    button("map_paint", tr("Paint"), tr("Picks the paint brush with this map"), [this] { paint(); });
    button("map_flip", tr("Flip V"), tr("Turns the map upside down, for images made the other way up"),
           [this] { flip(); });
    button("map_remove", tr("Remove"), tr("Removes the map; parameters that used it use none"), [this] { remove(); });
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 8);
    layout->addWidget(m_list, 1);
    layout->addWidget(m_buttons);
    connect(m_list, &QListWidget::itemChanged, this, &MapsPanel::rename);
    connect(m_list, &QListWidget::itemSelectionChanged, this, [this] {
        for (const char* name : {"map_save", "map_paint", "map_flip", "map_remove"}) {
            m_buttons->findChild<QPushButton*>(name)->setEnabled(m_list->currentItem());
        }
    });
    connect(&context.document, &Document::changed, this, &MapsPanel::refresh);
    refresh();
    Q_EMIT m_list->itemSelectionChanged();
}

std::string MapsPanel::current() const {
    const QListWidgetItem* item = m_list->currentItem();
    return item ? item->data(Qt::UserRole).toString().toStdString() : std::string();
}

void MapsPanel::refresh() {
    const Groom& groom = m_context.document.groom();
    setEnabled(m_context.document.hasGroom());
    if (groom.maps.sameAs(m_seen)) return;
    const QString chosen = QString::fromStdString(current());
    m_filling = true;
    const auto& entries = groom.maps.entries();
    while (m_list->count() > static_cast<int>(entries.size())) delete m_list->takeItem(m_list->count() - 1);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const MapSet::Entry& entry = entries[i];
        QListWidgetItem* item = m_list->item(static_cast<int>(i));
        const bool fresh = !item;
        if (fresh) {
            item = new QListWidgetItem(m_list);
            item->setFlags(item->flags() | Qt::ItemIsEditable);
        }
        const QString name = QString::fromStdString(entry.name);
        const bool same = !fresh && i < m_seen.entries().size() && m_seen.entries()[i].map.sameAs(entry.map);
        // Thumbnails wait for the end of a stroke.
        if (!same && (fresh || !m_context.document.previewing()))
            item->setIcon(pictureOf(*entry.map, entry.name == groom.counts->groupMap.name));
        item->setText(name);
        item->setData(Qt::UserRole, name);
        item->setToolTip(factsOf(*entry.map));
        if (name == chosen) m_list->setCurrentItem(item);
    }
    if (!m_context.document.previewing()) m_seen = groom.maps;
    if (!m_list->currentItem()) m_list->setCurrentRow(0);
    m_filling = false;
}

void MapsPanel::add() {
    Groom after = m_context.document.committed();
    const std::string name = freeMapName(after, "map");
    after.maps.set(name, Map(1024, 1024, 1, TexelFormat::U8, 1.0f));
    m_context.document.edit(std::move(after), tr("New map"));
    m_list->setCurrentRow(m_list->count() - 1);
}

void MapsPanel::load(const QString& file, bool colour) {
    std::vector<std::string> repairs;
    const Result<Map> map = runWithProgress<Map>(window(), tr("Loading %1").arg(file), [&](Progress&) {
        return readImage(pathOf(file), colour ? ImageUse::Colour : ImageUse::Data, &repairs);
    });
    if (!map) {
        m_context.messages.say(MessageBar::Kind::Error, QString::fromStdString(map.error().message));
        return;
    }
    Groom after = m_context.document.committed();
    const std::string name = freeMapName(after, pathOf(file).stem().string());
    after.maps.set(name, *map);
    after.countAnew();
    m_context.document.edit(std::move(after), tr("Load map %1").arg(QString::fromStdString(name)));
    m_list->setCurrentRow(m_list->count() - 1);
    QStringList details;
    for (const std::string& repair : repairs) details.push_back(QString::fromStdString(repair));
    if (!details.isEmpty()) m_context.messages.say(MessageBar::Kind::Warning, tr("The map was repaired."), details);
}

void MapsPanel::save(const QString& file) {
    const Map* map = m_context.document.committed().maps.find(current());
    if (!map) return;
    const Map copy = *map;
    const Result<void> saved = runWithProgress<void>(window(), tr("Saving %1").arg(file),
                                                     [&](Progress&) { return writeImage(copy, pathOf(file)); });
    if (saved)
        m_context.messages.say(MessageBar::Kind::Info, tr("Saved %1.").arg(file));
    else
        m_context.messages.say(MessageBar::Kind::Error, QString::fromStdString(saved.error().message));
}

void MapsPanel::remove() {
    Groom after = m_context.document.committed();
    if (removeMap(after, current())) m_context.document.edit(std::move(after), tr("Remove map"));
}

void MapsPanel::flip() {
    Groom after = m_context.document.committed();
    Map* map = after.maps.edit(current());
    if (!map) return;
    map->flipV = !map->flipV;
    m_context.document.edit(std::move(after), tr("Flip map"));
}

void MapsPanel::paint() {
    BrushOptions options = m_context.state.brushOptions();
    options.map.name = current();
    m_context.state.setBrushOptions(options);
    m_context.state.setBrush(findBrush("paint"));
}

void MapsPanel::rename(QListWidgetItem* item) {
    if (m_filling) return;
    Groom after = m_context.document.committed();
    const std::string from = item->data(Qt::UserRole).toString().toStdString();
    const Result<void> renamed = renameMap(after, from, item->text().trimmed().toStdString());
    if (renamed)
        m_context.document.edit(std::move(after), tr("Rename map"));
    else
        m_context.messages.say(MessageBar::Kind::Warning, QString::fromStdString(renamed.error().message));
    m_seen = {};
    refresh();
}

}  // namespace whorl
