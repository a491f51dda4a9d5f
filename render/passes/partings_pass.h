// SPDX-License-Identifier: Apache-2.0
// Partings as lines on the skin.
#pragma once

#include "core/model/groom.h"
#include "render/passes/line_ribbons.h"

namespace whorl {

class PartingsPass {
public:
    static Result<PartingsPass> create();
    /// Uploads all of them when they or the mesh differ from the last call.
    void setGroom(const Groom& groom, Uploads& uploads);
    /// Over a picture that is shown with `size` pixels; fainter where something stands before them.
    void draw(glm::ivec2 size);

private:
    Cow<SurfaceMesh> m_mesh;
    Cow<std::vector<Parting>> m_partings;
    LineRibbons m_lines;
};

}  // namespace whorl
