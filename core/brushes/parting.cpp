// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_index.h"
#include "core/brushes/brush_list.h"
#include "core/surface/parting_line.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace whorl {
namespace {

constexpr std::size_t mostPlaces = 2000;

/// Draws one parting along the stroke; with Ctrl it erases the partings that it meets.
class PartingBrush : public Brush {
    Result<void> begin(const Groom& groom, const BrushSettings& settings) override {
        if (!settings.invert && groom.partings->size() >= Parting::maxPartings)
            return Error{"A groom has at most " + std::to_string(Parting::maxPartings) +
                         " partings; erase some with Ctrl first."};
        return {};
    }

    void step(BrushStep& step) override {
        if (!(step.strength > 0.0f)) return;
        if (step.settings.invert) {
            erase(step);
        } else {
            draw(step);
        }
    }

    void draw(BrushStep& step) {
        // Steps off the skin are left out; the line goes on where the pointer comes back.
        if (!step.hit || m_places.size() >= mostPlaces) return;
        if (!m_places.empty() && glm::distance(m_places.back(), step.hit->position) < partingStep(step.surface) * 0.25f)
            return;
        m_places.push_back(step.hit->position);
        if (m_places.size() < 2) return;
        auto line = tracedParting(step.surface, steadied());
        if (!line) return;
        const std::vector<Parting>& partings = *step.groom.partings;
        const auto own = std::ranges::find(partings, m_id, &Parting::id);
        if (m_id == 0 || own == partings.end()) {
            // The mirror image may have taken the last place.
            if (partings.size() >= Parting::maxPartings) return;
            m_id = nextPartingId(partings);
            step.groom.partings.edit().push_back({m_id, {}, std::move(*line)});
        } else {
            if (own->points == *line) return;
            const auto place = own - partings.begin();
            step.groom.partings.edit()[static_cast<std::size_t>(place)].points = std::move(*line);
        }
        step.changed = true;
    }

    // Without the shaking of the hand; both ends stay.
    std::vector<glm::vec3> steadied() const {
        std::vector<glm::vec3> places = m_places;
        for (int pass = 0; pass < 2; ++pass) {
            glm::vec3 before = places.front();
            for (std::size_t i = 1; i + 1 < places.size(); ++i) {
                const glm::vec3 here = places[i];
                places[i] = (before + here * 2.0f + places[i + 1]) * 0.25f;
                before = here;
            }
        }
        return places;
    }

    static bool isUnder(const BrushStep& step, const Parting& parting) {
        return std::ranges::any_of(parting.points, [&](const SurfacePoint& point) {
            const auto pixel = step.view.pixelFromGroom(positionAt(step.surface.mesh(), point));
            return pixel && glm::distance(*pixel, step.pixel) <= step.radiusPixels &&
                   (!step.settings.frontOnly || rootFacesEye(step.surface, step.view, point));
        });
    }

    static void erase(BrushStep& step) {
        const auto under = [&](const Parting& parting) { return isUnder(step, parting); };
        if (std::ranges::none_of(*step.groom.partings, under)) return;
        std::erase_if(step.groom.partings.edit(), under);
        step.changed = true;
    }

    std::vector<glm::vec3> m_places;
    std::uint32_t m_id = 0;
};

}  // namespace

std::unique_ptr<Brush> makeParting() {
    return std::make_unique<PartingBrush>();
}

}  // namespace whorl
