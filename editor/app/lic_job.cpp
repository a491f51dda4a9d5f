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
        std::shared_ptr<const LicTexture> texture;
        if (surface) {
            auto made = m_live.update(groom, surface, size, progress);
            if (!made) return;  // cancelled: a newer request follows
            texture = std::move(*made);
        }
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        QMetaObject::invokeMethod(
            this, [=, this] { deliver(serial, texture, spent.count()); }, Qt::QueuedConnection);
    };
    m_job.submit(std::move(work), interactive ? LatestJob::Running::Finish : LatestJob::Running::Cancel);
}

void LicJob::deliver(std::uint64_t serial, std::shared_ptr<const LicTexture> texture, double milliseconds) {
    if (serial <= m_delivered) return;
    m_delivered = serial;
    m_milliseconds = milliseconds;
    m_texture = std::move(texture);
    Q_EMIT delivered();
}

}  // namespace whorl
