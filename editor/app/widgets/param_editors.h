// SPDX-License-Identifier: Apache-2.0
// One editor widget a kind of parameter.
#pragma once

#include "core/param/param.h"

#include <QWidget>

namespace whorl {

class ParamSource;

/// Shows the value of a parameter and reports what the artist does to it.
class ParamEditor : public QWidget {
    Q_OBJECT

public:
    using QWidget::QWidget;
    /// Shows the value; tells nobody.
    virtual void show(const ParamRef& param) = 0;
    using QWidget::show;

Q_SIGNALS:
    void edited(const whorl::ParamValue& value, bool dragging);
    void dropped();
};

/// The editor for the type of `param`; `source` gives names of maps.
ParamEditor* makeParamEditor(const ParamRef& param, ParamSource& source, QWidget* parent);

}  // namespace whorl
