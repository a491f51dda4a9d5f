// SPDX-License-Identifier: Apache-2.0
#include "editor/app/hair_job.h"

#include <QMetaObject>
#include <chrono>

namespace whorl {

HairJob::HairJob(QObject* parent) : QObject(parent) {}

HairJob::~HairJob() = default;

void HairJob::request(const Groom& groom, std::shared_ptr<const Surface> surface, const GenerateOptions& options,
                      bool interactive) {
    const std::uint64_t serial = ++m_requested;
    auto work = [this, serial, groom, surface = std::move(surface), options](Progress& progress) {
        const auto start = std::chrono::steady_clock::now();
        if (surface) m_generator.setSurface(surface);
        Result<std::shared_ptr<const Strands>> result = m_generator.generateShared(groom, options, progress);
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        std::shared_ptr<const Strands> strands;
        QString problem;
        if (result) {
            strands = std::move(*result);
        } else if (result.error().cancelled) {
            return;
        } else {
            problem = QString::fromStdString(result.error().message);
        }
        QMetaObject::invokeMethod(
            this, [=, this] { deliver(serial, strands, spent.count(), problem); }, Qt::QueuedConnection);
    };
    m_job.submit(std::move(work), interactive ? LatestJob::Running::Finish : LatestJob::Running::Cancel);
}

void HairJob::deliver(std::uint64_t serial, std::shared_ptr<const Strands> strands, double milliseconds,
                      QString problem) {
    if (serial <= m_delivered) return;
    m_delivered = serial;
    m_milliseconds = milliseconds;
    if (strands) {
        Q_EMIT delivered(strands);
    } else {
        Q_EMIT failed(problem);
    }
}

}  // namespace whorl
