// SPDX-License-Identifier: Apache-2.0
// Strokes of the direction field, and where the field turns, as lines on the skin.
#pragma once

#include "core/field/direction_field.h"
#include "core/model/groom.h"
#include "render/passes/line_ribbons.h"

namespace whorl {

class StrokesPass {
public:
    static Result<StrokesPass> create();
    /// Uploads all of them when they, the mesh or the selected one (its id; 0: none) differ from the last call.
    void setGroom(const Groom& groom, std::uint32_t selected, Uploads& uploads);
    /// Uploads when they or the mesh differ from the last call. Places around which directions turn; drawn as small
    /// stars, saddles in another colour.
    void setSingularities(const Groom& groom, std::span<const FieldSingularity> places, Uploads& uploads);
    /// Over a picture that is shown with `size` pixels; fainter where something stands before them.
    void draw(glm::ivec2 size);

private:
    Cow<SurfaceMesh> m_mesh;
    Cow<std::vector<FieldStroke>> m_strokes;
    std::uint32_t m_selected = 0;
    Cow<SurfaceMesh> m_starsMesh;
    std::vector<FieldSingularity> m_stars;
    LineRibbons m_lines;
    LineRibbons m_chosen;
    LineRibbons m_circles;
    LineRibbons m_turns;
    LineRibbons m_saddles;
};

}  // namespace whorl
