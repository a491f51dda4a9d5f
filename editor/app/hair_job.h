// SPDX-License-Identifier: Apache-2.0
// The hair that the viewport shows, generated in the background.
#pragma once

#include "core/hair/generate.h"
#include "editor/app/latest_job.h"

#include <QObject>
#include <atomic>
#include <memory>

namespace whorl {

/// Requests come from the GUI thread, results arrive there; results never arrive out of order.
class HairJob : public QObject {
    Q_OBJECT

public:
    explicit HairJob(QObject* parent = nullptr);
    ~HairJob() override;

    /// `interactive`: the artist is dragging; a generation that runs is finished and shown before the newest one.
    void request(const Groom& groom, std::shared_ptr<const Surface> surface, const GenerateOptions& options,
                 bool interactive);
    bool busy() const { return m_job.busy() || m_delivered != m_requested; }
    /// Milliseconds of the last generation.
    double milliseconds() const { return m_milliseconds; }

Q_SIGNALS:
    void delivered(std::shared_ptr<const whorl::Strands> strands);
    void failed(const QString& sentence);

private:
    void deliver(std::uint64_t serial, std::shared_ptr<const Strands> strands, double milliseconds, QString problem);

    Generator m_generator;  // used by the job's thread only
    std::uint64_t m_requested = 0;
    std::uint64_t m_delivered = 0;
    double m_milliseconds = 0.0;
    LatestJob m_job;  // last: its thread ends before the generator goes
};

}  // namespace whorl
