// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/guide_brush.h"
#include "core/brushes/stroke_scratch.h"

#include <vector>

namespace whorl {
namespace {

/// Deletes guides by their roots: hair that only hangs through the brush stays.
class DeleteBrush : public Brush {
    void step(BrushStep& step) override {
        if (!(step.strength > 0.0f) || step.groom.guides.empty()) return;
        const std::optional<BrushArea> area = brushArea(step);
        if (!area) return;
        step.scratch->guides.select(step.groom, step.surface, *area, step.view, step.settings.frontOnly, step.mirrored,
                                    m_selection);
        m_doomed.clear();
        for (const BrushIndex::Touched& touched : m_selection.guides) {
            if (m_selection.weights[touched.firstWeight] > 0.0f) m_doomed.push_back(touched.guide);
        }
        if (m_doomed.empty()) return;
        step.groom.guides.erase(m_doomed);
        step.scratch->guides.forget();
        step.changed = true;
    }

    BrushIndex::Selection m_selection;
    std::vector<std::size_t> m_doomed;
};

}  // namespace

std::unique_ptr<Brush> makeDelete() {
    return std::make_unique<DeleteBrush>();
}

}  // namespace whorl
