// SPDX-License-Identifier: Apache-2.0
// All that is derived from a mesh alone, made once and shared by brushes, generator and renderer.
#pragma once

#include "core/surface/distance_field.h"
#include "core/surface/surface_query.h"

#include <memory>
#include <mutex>

namespace whorl {

class PaintPlaces;

/// Immutable once made; any thread may ask.
class Surface {
public:
    explicit Surface(Cow<SurfaceMesh> mesh);

    const SurfaceMesh& mesh() const { return query.mesh(); }
    /// Made at the first call (tens of milliseconds to a second), then kept.
    const DistanceField& skin() const { return *sharedSkin(); }
    std::shared_ptr<const DistanceField> sharedSkin() const;
    /// What painting has found out about the newest shape of map, for as long as the surface lives: see
    /// core/brushes/paint_places.h. Null at first.
    std::shared_ptr<PaintPlaces> paintPlaces() const;
    void setPaintPlaces(std::shared_ptr<PaintPlaces> places) const;

    Cow<SurfaceMesh> shared;
    SurfaceQuery query;
    Bounds bounds;

private:
    mutable std::once_flag m_skinOnce;
    mutable std::shared_ptr<const DistanceField> m_skin;
    mutable std::mutex m_placesMutex;
    mutable std::shared_ptr<PaintPlaces> m_places;
};

/// Keeps the Surface of the newest mesh. Thread-safe.
class SurfaceCache {
public:
    std::shared_ptr<const Surface> get(const Cow<SurfaceMesh>& mesh);

private:
    std::mutex m_mutex;
    std::shared_ptr<const Surface> m_newest;
};

}  // namespace whorl
