// SPDX-License-Identifier: Apache-2.0
// A form made from a block's declaration: a row a parameter, with map button and reset.
#pragma once

#include "editor/app/widgets/param_source.h"

#include <QWidget>
#include <vector>

class QGridLayout;
class QLabel;
class QToolButton;

namespace whorl {

class ParamEditor;

class ParamForm : public QWidget {
    Q_OBJECT

public:
    /// `source` must outlive the form. `only`: ids of the rows to show; empty shows all.
    explicit ParamForm(ParamSource& source, QStringList only = {}, QWidget* parent = nullptr);

    /// Shows only these rows from now on (all when empty).
    void showOnly(const QStringList& ids);
    /// Reads all values again.
    void refresh();

private:
    struct Row {
        QString id;
        QLabel* label = nullptr;
        ParamEditor* editor = nullptr;
        QToolButton* map = nullptr;
        QToolButton* reset = nullptr;
    };
    void addRow(QGridLayout& grid, std::size_t index, const ParamRef& param);
    void fillMapMenu(std::size_t index);
    void resetRow(std::size_t index);

    ParamSource& m_source;
    QStringList m_only;
    std::vector<Row> m_rows;
};

/// A title that folds what is below it.
class Section : public QWidget {
    Q_OBJECT

public:
    Section(const QString& title, QWidget* content, QWidget* parent = nullptr);
    void setOpen(bool open);
    bool isOpen() const;

private:
    QToolButton* m_title;
    QWidget* m_content;
};

}  // namespace whorl
