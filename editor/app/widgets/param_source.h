// SPDX-License-Identifier: Apache-2.0
// Where a form of parameters reads and writes.
#pragma once

#include "core/param/param.h"

#include <QObject>
#include <QString>
#include <QStringList>
#include <vector>

namespace whorl {

/// One living block of parameters, seen by a ParamForm.
class ParamSource : public QObject {
    Q_OBJECT

public:
    using QObject::QObject;

    /// The values as they stand, in declared order. Good until the next call; for reading.
    virtual std::vector<ParamRef> values() = 0;
    /// The same with default values.
    virtual std::vector<ParamRef> defaults() = 0;
    /// The artist moved `param` to `value`; `dragging`: more will come, show it only.
    virtual void set(const ParamRef& param, const ParamValue& value, bool dragging) = 0;
    /// The drag was given up.
    virtual void drop() = 0;
    /// Another map for `param`; empty takes it off.
    virtual void setMap(const ParamRef& param, const std::string& map) = 0;
    /// Names of the maps to choose from.
    virtual QStringList maps(bool colour) const = 0;
    /// Makes a new map, gives it to `param`; false when maps can not be made here.
    virtual bool createMap(const ParamRef& param) = 0;
    /// True when maps multiply this block's values.
    virtual bool takesMaps() const = 0;

Q_SIGNALS:
    /// Values may differ from what they were.
    void changed();
};

inline QString qtext(std::string_view view) {
    return QString::fromUtf8(view.data(), static_cast<qsizetype>(view.size()));
}

}  // namespace whorl
