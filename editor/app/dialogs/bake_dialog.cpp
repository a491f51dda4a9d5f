// SPDX-License-Identifier: Apache-2.0
#include "editor/app/dialogs/bake_dialog.h"

#include "editor/app/widgets/param_source.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>

namespace whorl {

BakeDialog::BakeDialog(QWidget* parent) : QDialog(parent) {
    setObjectName("bake_dialog");
    setWindowTitle(tr("Bake hair texture"));
    auto* form = new QFormLayout(this);
    const QSettings settings;

    const QString labels[] = {tr("Colour"), tr("Opacity"), tr("Flow"), tr("Height")};
    const QString tips[] = {tr("Colour of the hair."), tr("How much hair lies there."),
                            tr("Direction of the hair in the tangent frame of the UVs: red along u, green along v, "
                               "half where no hair lies. "
                               "Green is up, as in OpenGL; for DirectX turn it over."),
                            tr("Height of the light hairs above the dark ones.")};
    auto* maps = new QVBoxLayout;
    for (std::size_t k = 0; k < bakeMapNames.size(); ++k) {
        const QString name = qtext(bakeMapNames[k]);
        m_maps[k] = new QCheckBox(labels[k], this);
        m_maps[k]->setObjectName("bake_" + name);
        m_maps[k]->setToolTip(tips[k]);
        m_maps[k]->setChecked(settings.value("bake/" + name, true).toBool());
        maps->addWidget(m_maps[k]);
        connect(m_maps[k], &QCheckBox::toggled, this, [this] { refresh(); });
    }
    form->addRow(tr("Maps"), maps);

    const BakeOptions usual;
    const auto number = [&](const char* name, const QString& label, int low, int high, int value) {
        auto* box = new QSpinBox(this);
        box->setObjectName(QString("bake_") + name);
        box->setRange(low, high);
        box->setValue(settings.value(QString("bake/") + name, value).toInt());
        box->setSuffix(tr(" px"));
        form->addRow(label, box);
        return box;
    };
    m_size = number("size", tr("Size"), 16, BakeOptions::maxSize, usual.size);
    m_size->setToolTip(tr("Texels a side."));
    m_margin = number("margin", tr("Margin"), 0, BakeOptions::maxMargin, usual.margin);
    m_margin->setToolTip(tr("How far around the parts of the UVs values go on."));

    m_format = new QComboBox(this);
    m_format->setObjectName("bake_format");
    m_format->addItem(tr("PNG"), "png");
    m_format->addItem(tr("EXR, floats"), "exr");
    m_format->addItem(tr("EXR, half floats"), "exr, half");
    m_format->setToolTip(tr("Half floats have three digits, which is enough to draw with, in half the size."));
    m_format->setCurrentIndex(std::max(m_format->findData(settings.value("bake/format", "png")), 0));
    form->addRow(tr("Format"), m_format);

    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    m_ok = buttons->button(QDialogButtonBox::Ok);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    form->addRow(buttons);
    refresh();
}

void BakeDialog::refresh() {
    m_ok->setEnabled(std::ranges::any_of(m_maps, &QCheckBox::isChecked));
}

BakeRequest BakeDialog::request() const {
    BakeRequest request;
    for (std::size_t k = 0; k < m_maps.size(); ++k) {
        if (m_maps[k]->isChecked()) request.maps.push_back(static_cast<BakeMap>(k));
    }
    request.options.size = m_size->value();
    request.options.margin = m_margin->value();
    const QString format = m_format->currentData().toString();
    request.format = format == "png" ? "png" : "exr";
    if (format == "exr, half") request.bits = 16;
    return request;
}

void BakeDialog::remember() const {
    QSettings settings;
    for (std::size_t k = 0; k < m_maps.size(); ++k)
        settings.setValue("bake/" + qtext(bakeMapNames[k]), m_maps[k]->isChecked());
    settings.setValue("bake/size", m_size->value());
    settings.setValue("bake/margin", m_margin->value());
    settings.setValue("bake/format", m_format->currentData());
}

}  // namespace whorl
