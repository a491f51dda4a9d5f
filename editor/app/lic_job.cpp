// SPDX-License-Identifier: Apache-2.0
#include "editor/app/lic_job.h"

#include <QMetaObject>
#include <chrono>

namespace whorl {

LicJob::LicJob(QObject* parent) : QObject(parent) {}

LicJob::~LicJob() = default;

void LicJob::request(const Groom& groom, std::shared_ptr<const Surface> surface, int size, bool interactive) {
    const std::uint64_t serial = ++m_requested;
    auto work = [this, serial, groom, surface = std::move(surface), size](Progress& progress) {
        const auto start = std::chrono::steady_clock::now();
        Made made;
        if (surface) {
            const auto field = m_live.field(groom, surface, progress);
            if (!field) return;  // cancelled: a newer request follows
            made.singularities = field->singularities();
            if (size > 0) {
                auto texture = m_live.update(groom, surface, size, progress);
                if (!texture) return;
                m_painted = LicImage::make(std::move(*texture), m_painted);
                made.image = m_painted;
            }
        }
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        made.milliseconds = spent.count();
        QMetaObject::invokeMethod(
            this, [=, this] { deliver(serial, made); }, Qt::QueuedConnection);
    };
    m_job.submit(std::move(work), interactive ? LatestJob::Running::Finish : LatestJob::Running::Cancel);
}

void LicJob::deliver(std::uint64_t serial, Made made) {
    if (serial <= m_delivered) return;
    m_delivered = serial;
    m_milliseconds = made.milliseconds;
    m_image = std::move(made.image);
    m_singularities = std::move(made.singularities);
    Q_EMIT delivered();
}

}  // namespace whorl
