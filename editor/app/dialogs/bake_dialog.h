// SPDX-License-Identifier: Apache-2.0
// What to bake of the hair texture.
#pragma once

#include "core/io/bake_files.h"

#include <QDialog>
#include <array>

class QCheckBox;
class QComboBox;
class QPushButton;
class QSpinBox;

namespace whorl {

/// Maps, size, margin and format; as they were last time.
class BakeDialog : public QDialog {
    Q_OBJECT

public:
    explicit BakeDialog(QWidget* parent);

    /// What is chosen, without a file.
    BakeRequest request() const;
    /// For the next time.
    void remember() const;

private:
    void refresh();
    std::array<QCheckBox*, bakeMapNames.size()> m_maps{};
    QSpinBox* m_size;
    QSpinBox* m_margin;
    QComboBox* m_format;
    QPushButton* m_ok;
};

}  // namespace whorl
