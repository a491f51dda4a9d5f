// SPDX-License-Identifier: Apache-2.0
#include "editor/app/edit_groom.h"

#include "editor/app/document.h"

namespace whorl {

EditGroom::EditGroom(Document& document, Groom before, Groom after, const QString& text, const QString& mergeKey)
    : QUndoCommand(text),
      m_document(document),
      m_before(std::move(before)),
      m_after(std::move(after)),
      m_mergeKey(mergeKey),
      m_bytes(m_after.bytesNotSharedWith(m_before)) {}

bool EditGroom::mergeWith(const QUndoCommand* other) {
    const auto* next = static_cast<const EditGroom*>(other);
    if (m_mergeKey.isEmpty() || next->m_restored || next->m_mergeKey != m_mergeKey) return false;
    m_after = next->m_after;
    m_bytes = m_after.bytesNotSharedWith(m_before);
    setText(next->text());
    return true;
}

void EditGroom::undo() {
    m_document.show(m_before);
}

void EditGroom::redo() {
    m_document.show(m_after);
}

EditGroom* EditGroom::restored() const {
    auto* copy = new EditGroom(m_document, m_before, m_after, text(), m_mergeKey);
    copy->m_restored = true;
    return copy;
}

}  // namespace whorl
