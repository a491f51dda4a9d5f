// SPDX-License-Identifier: Apache-2.0
// The hair texture that the viewport shows, painted in the background.
#pragma once

#include "core/lic/live_texture.h"
#include "editor/app/latest_job.h"
#include "render/lic_image.h"

#include <QObject>
#include <memory>

namespace whorl {

/// Requests come from the GUI thread, results arrive there; results never arrive out of order.
class LicJob : public QObject {
    Q_OBJECT

public:
    explicit LicJob(QObject* parent = nullptr);
    ~LicJob() override;

    /// `size`: texels a side; 0 for the field alone. `interactive`: the artist is dragging; a texture that is being
    /// painted is finished and shown before the newest.
    void request(const Groom& groom, std::shared_ptr<const Surface> surface, int size, bool interactive);
    bool busy() const { return m_job.busy() || m_delivered != m_requested; }
    /// Null until the first result.
    std::shared_ptr<const LicImage> image() const { return m_image; }
    /// Where the field of the last result turns.
    const std::vector<FieldSingularity>& singularities() const { return m_singularities; }
    /// Milliseconds of the last one, field, texture and its image.
    double milliseconds() const { return m_milliseconds; }

Q_SIGNALS:
    void delivered();

private:
    struct Made {
        std::shared_ptr<const LicImage> image;
        std::vector<FieldSingularity> singularities;
        double milliseconds = 0.0;
    };
    void deliver(std::uint64_t serial, Made made);

    LiveTexture m_live;                         // used by the job's thread only
    std::shared_ptr<const LicImage> m_painted;  // likewise: the last one
    std::shared_ptr<const LicImage> m_image;
    std::vector<FieldSingularity> m_singularities;
    std::uint64_t m_requested = 0;
    std::uint64_t m_delivered = 0;
    double m_milliseconds = 0.0;
    LatestJob m_job;  // last: its thread ends before the rest goes
};

}  // namespace whorl
