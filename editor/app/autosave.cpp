// SPDX-License-Identifier: Apache-2.0
#include "editor/app/autosave.h"

#include "editor/app/document.h"

namespace whorl {

Autosave::Autosave(Document& document, std::filesystem::path folder, QObject* parent)
    : QObject(parent), m_document(document), m_folder(std::move(folder)), m_written(document.revision()) {
    m_timer.setInterval(seconds * 1000);
    connect(&m_timer, &QTimer::timeout, this, &Autosave::writeNow);
    connect(&document, &Document::changed, this, &Autosave::documentChanged);
    m_timer.start();
}

Autosave::~Autosave() = default;

void Autosave::documentChanged() {
    if (!m_document.clean() && m_document.revision() >= m_written + steps) writeNow();
}

void Autosave::writeNow() {
    if (m_document.clean() || !m_document.hasGroom() || (m_document.revision() == m_written && !m_retry)) return;
    m_retry = false;
    m_written = m_document.revision();
    m_timer.start();
    m_job.submit(
        [this, place = m_place, folder = m_folder, groom = m_document.committed(),
         file = m_document.file()](Progress& progress) {
            Result<void> done;
            if (!place->journal) {
                Result<Journal> journal = Journal::create(folder, file);
                if (journal)
                    place->journal.emplace(std::move(*journal));
                else
                    done = journal.error();
            }
            if (place->journal) done = place->journal->write(groom, progress);
            if (done || done.error().cancelled) return;
            const QString sentence = QString::fromStdString(done.error().message);
            QMetaObject::invokeMethod(
                this,
                [this, sentence] {
                    m_retry = true;
                    // Once is enough: the artist knows, and is not interrupted every minute.
                    if (!m_complained) Q_EMIT failed(tr("Unsaved work can not be kept safe: %1").arg(sentence));
                    m_complained = true;
                },
                Qt::QueuedConnection);
        },
        LatestJob::Running::Finish);
}

void Autosave::discard() {
    m_job.wait();
    if (m_place->journal) m_place->journal->discard();
    m_place->journal.reset();
    m_written = m_document.revision();
}

std::filesystem::path Autosave::file() const {
    if (m_job.busy() || !m_place->journal) return {};
    return m_place->journal->file();
}

}  // namespace whorl
