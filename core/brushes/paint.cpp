// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/stroke_scratch.h"
#include "core/sampling/density_total.h"

#include <optional>

namespace whorl {
namespace {

/// Paints a data map in a ball around the skin under the cursor. Hard: numbers, without falloff and strength.
class PaintBrush : public Brush {
public:
    explicit PaintBrush(bool hard) : m_hard(hard) {}

private:
    Result<void> begin(const Groom& groom, const BrushSettings& settings) override {
        if (settings.map.empty()) return Error{"Choose a map to paint first."};
        const Map* map = groom.maps.find(settings.map);
        if (map == nullptr) return Error{"The groom has no map \"" + settings.map + "\"; choose another to paint."};
        if (map->channels() != 1 || map->empty()) {
            return Error{"The map \"" + settings.map + "\" holds colours; choose a map of numbers to paint."};
        }
        // Without guides there is no hair that could change: the number stands for all that will have been painted.
        if (groom.counts->densityTotal == 0.0f && !groom.guides.empty() && drivesDensity(groom, settings.map))
            m_before = groom;
        return {};
    }

    void step(BrushStep& step) override {
        if (!(step.strength > 0.0f) || !step.hit) return;
        const std::string& name = step.settings.map;
        std::unique_ptr<PaintCanvas>& canvas = step.scratch->canvas;
        if (!canvas) canvas = std::make_unique<PaintCanvas>(step.surface, *step.groom.maps.find(name));
        PaintDab dab{.centre = step.hit->position,
                     .strength = step.strength,
                     .frontOnly = step.settings.frontOnly,
                     .hard = m_hard};
        dab.radius = step.radiusPixels * step.view.metresPerPixel(dab.centre);
        // Without perspective rays are parallel: an eye far along this one faces the same triangles.
        dab.eye = step.view.rayOrigin(step.pixel);
        step.changed = canvas->paint(step.groom.maps, name, dab, step.settings.invert ? 0.0f : step.settings.value);
        // The rest of the hair stays as it is. The mirror image may have seen to that.
        if (step.changed && m_before && step.groom.counts->densityTotal == 0.0f)
            step.groom.counts.edit().densityTotal = densityTotalOf(*m_before);
        if (step.changed) m_before.reset();
    }

    bool m_hard;
    std::optional<Groom> m_before;  // while the number of hairs is to be pinned
};

}  // namespace

std::unique_ptr<Brush> makePaint() {
    return std::make_unique<PaintBrush>(false);
}

std::unique_ptr<Brush> makeGroup() {
    return std::make_unique<PaintBrush>(true);
}

}  // namespace whorl
