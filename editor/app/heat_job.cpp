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
    const Result<RootSampler> sampler = RootSampler::build(groom, density, progress);
    if (!sampler) return {};
    const std::vector<double> shares = sampler->sharesByTriangle(mesh.triangleCount());
    const auto growing =
        static_cast<std::size_t>(std::count_if(shares.begin(), shares.end(), [](double share) { return share > 0.0; }));
    // A strand is one root, however many hairs it has.
    std::vector<SurfacePoint> roots;
    for (std::size_t i = 0; i < strands.count(); ++i)
        if (strands.members[i] == 0) roots.push_back(strands.roots[i]);
    // Each pass reaches about one triangle more; chance fades where some thirty hairs come together.
    const std::size_t hairs = std::max<std::size_t>(roots.size(), 1);
    const auto passes = static_cast<int>(std::clamp<std::size_t>(30 * growing / hairs, 2, 60));
    const Result<HeatMap> heat = heatMap(mesh, *sampler, roots, passes, progress);
    if (!heat) return {};
    std::vector<glm::vec4> colours(mesh.triangleCount());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        // Smoothing carries hairs over the edge of what grows; outside nothing is asked for.
        const bool shown = shares[i] > 0.0 || heat->placed[i] > 0.5f;
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
