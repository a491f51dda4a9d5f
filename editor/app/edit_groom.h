// SPDX-License-Identifier: Apache-2.0
// The only undo command: one groom becomes another.
#pragma once

#include "core/model/groom.h"

#include <QString>
#include <QUndoCommand>

namespace whorl {

class Document;

/// Holds the groom before and after an edit. Guides, texels, parameters and groups all undo through it.
class EditGroom : public QUndoCommand {
public:
    /// `mergeKey`: the next command with the same, not empty key becomes part of this one.
    EditGroom(Document& document, Groom before, Groom after, const QString& text, const QString& mergeKey);

    int id() const override { return 1; }
    bool mergeWith(const QUndoCommand* other) override;
    void undo() override;
    void redo() override;

    /// Memory that this step keeps beyond what its neighbours share.
    std::size_t bytes() const { return m_bytes; }
    /// The same step for a history that is built anew; it never merges into the step before it.
    EditGroom* restored() const;

private:
    Document& m_document;
    Groom m_before;
    Groom m_after;
    QString m_mergeKey;
    std::size_t m_bytes = 0;
    bool m_restored = false;
};

}  // namespace whorl
