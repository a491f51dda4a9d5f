// SPDX-License-Identifier: Apache-2.0
// Hair texture over a whole mesh by line integral convolution, fast enough to follow a brush.
#pragma once

#include "core/field/direction_field.h"
#include "core/lic/texel_atlas.h"
#include "core/lic/texture.h"
#include "core/model/groom.h"

// The same texture as LicReference makes place by place. The convolution runs in the texture: for every texel one word
// holds the step to the next place along the field and the noise there, so that a step is one look-up. Words near a
// seam lead on to the other chart, those at a parting and at the border of the growing area end the streamline.

namespace whorl {

/// Any thread may call; paints take turns.
class LicPainter {
public:
    static constexpr int maxSize = 8192;

    /// What the mesh alone decides: about 0.1 s for 100,000 triangles at 1024. Fails only when cancelled.
    static Result<LicPainter> make(std::shared_ptr<const Surface> surface, int size, Progress& progress,
                                   LicLayout layout = LicLayout::Best);

    /// The texture of the groom's LicParams, densities and colours along `field`, which is that of its strokes and
    /// partings. `groom` has the mesh of the painter. `before`: null, or what the last paint gave; then only what
    /// differs is made again, and changedFrom and changedTo say where. The bytes are the same either way, at any number
    /// of threads. An empty field gives a texture without hair. Fails only when cancelled.
    Result<LicTexture> paint(const Groom& groom, const DirectionField& field, const LicTexture* before,
                             Progress& progress) const;

    int size() const;
    /// Where texels lie on the mesh.
    const TexelAtlas& atlas() const;

private:
    struct State;
    explicit LicPainter(std::shared_ptr<State> state) : m_state(std::move(state)) {}
    std::shared_ptr<State> m_state;
};

}  // namespace whorl
