// SPDX-License-Identifier: Apache-2.0
// Colours of the mesh's triangles by asked and placed hairs, made in the background.
#pragma once

#include "core/hair/strands.h"
#include "core/model/groom.h"
#include "editor/app/latest_job.h"

#include <glm/vec4.hpp>

#include <QObject>
#include <memory>
#include <vector>

namespace whorl {

/// Requests come from the GUI thread, results arrive there.
class HeatJob : public QObject {
    Q_OBJECT

public:
    using Colours = std::shared_ptr<const std::vector<glm::vec4>>;

    explicit HeatJob(QObject* parent = nullptr);
    ~HeatJob() override;

    /// Compares the roots of `strands` with what `groom` asks for. A request before is forgotten.
    void request(const Groom& groom, std::shared_ptr<const Strands> strands);
    /// Null until the first result.
    Colours colours() const { return m_colours; }
    bool busy() const { return m_delivered != m_requested; }

Q_SIGNALS:
    void delivered();

private:
    void deliver(std::uint64_t serial, Colours colours);

    Colours m_colours;
    std::uint64_t m_requested = 0;
    std::uint64_t m_delivered = 0;
    LatestJob m_job;  // last: its thread ends before the rest goes
};

}  // namespace whorl
