// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/drawn_line.h"

#include <algorithm>

namespace whorl {
namespace {

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
        if (!m_line.add(step) || m_line.size() < 2) return;
        auto line = m_line.traced(step.surface);
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

    static void erase(BrushStep& step) {
        const auto under = [&](const Parting& parting) { return pixelsTo(step, parting.points) <= step.radiusPixels; };
        if (std::ranges::none_of(*step.groom.partings, under)) return;
        std::erase_if(step.groom.partings.edit(), under);
        step.changed = true;
    }

    DrawnLine m_line;
    std::uint32_t m_id = 0;
};

}  // namespace

std::unique_ptr<Brush> makeParting() {
    return std::make_unique<PartingBrush>();
}

}  // namespace whorl
