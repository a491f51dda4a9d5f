// SPDX-License-Identifier: Apache-2.0
#include "editor/app/heat_job.h"

#include "core/sampling/heat_map.h"

#include <QMetaObject>
#include <algorithm>

namespace whorl {
namespace {

constexpr float opacity = 0.9f;

std::vector<glm::vec4> coloursOf(const Groom& groom, const Strands& strands, Progress& progress) {
    const SurfaceMesh& mesh = *groom.mesh;
    const DensityLookup density(groom);
    const Result<SubTriangleSampler> sampler = SubTriangleSampler::build(mesh, density, {}, progress);
    if (!sampler) return {};
    std::size_t growing = 0;
    std::vector<std::uint8_t> grows(mesh.triangleCount(), 0);
    for (const auto& piece : sampler->subTriangles()) {
        growing += grows[piece.triangle] == 0 && piece.weight > 0.0f ? 1 : 0;
        if (piece.weight > 0.0f) grows[piece.triangle] = 1;
    }
    // Each pass reaches about one triangle more; chance fades where some thirty hairs come together.
    const std::size_t hairs = std::max<std::size_t>(strands.count(), 1);
    const auto passes = static_cast<int>(std::clamp<std::size_t>(30 * growing / hairs, 2, 60));
    const Result<HeatMap> heat = heatMap(mesh, *sampler, strands.roots, passes, progress);
    if (!heat) return {};
    std::vector<glm::vec4> colours(mesh.triangleCount());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        // Smoothing carries hairs over the edge of what grows; outside nothing is asked for.
        const bool shown = grows[i] != 0 || heat->placed[i] > 0.5f;
        colours[i] = shown ? glm::vec4(heatColour(heat->asked[i], heat->placed[i]), opacity) : glm::vec4(0.0f);
    }
    return colours;
}

}  // namespace

HeatJob::HeatJob(QObject* parent) : QObject(parent) {}

HeatJob::~HeatJob() = default;

void HeatJob::request(const Groom& groom, std::shared_ptr<const Strands> strands) {
    const std::uint64_t serial = ++m_requested;
    auto work = [this, serial, groom, strands = std::move(strands)](Progress& progress) {
        auto colours = std::make_shared<const std::vector<glm::vec4>>(coloursOf(groom, *strands, progress));
        if (progress.cancelled()) return;
        QMetaObject::invokeMethod(
            this, [=, this] { deliver(serial, colours); }, Qt::QueuedConnection);
    };
    m_job.submit(std::move(work), LatestJob::Running::Cancel);
}

void HeatJob::deliver(std::uint64_t serial, Colours colours) {
    if (serial <= m_delivered) return;
    m_delivered = serial;
    m_colours = std::move(colours);
    Q_EMIT delivered();
}

}  // namespace whorl
