// SPDX-License-Identifier: Apache-2.0
#include "core/surface/surface.h"

namespace whorl {

Surface::Surface(Cow<SurfaceMesh> mesh) : shared(mesh), query(std::move(mesh)), bounds(boundsOf(*shared)) {}

std::shared_ptr<const DistanceField> Surface::sharedSkin() const {
    std::call_once(m_skinOnce,
                   [this] { m_skin = std::make_shared<const DistanceField>(DistanceField::build(mesh())); });
    return m_skin;
}

std::shared_ptr<PaintPlaces> Surface::paintPlaces() const {
    const std::lock_guard lock(m_placesMutex);
    return m_places;
}

void Surface::setPaintPlaces(std::shared_ptr<PaintPlaces> places) const {
    const std::lock_guard lock(m_placesMutex);
    m_places.swap(places);
}

std::shared_ptr<const Surface> SurfaceCache::get(const Cow<SurfaceMesh>& mesh) {
    const std::lock_guard lock(m_mutex);
    if (!m_newest || !m_newest->shared.sameAs(mesh)) m_newest = std::make_shared<Surface>(mesh);
    return m_newest;
}

}  // namespace whorl
