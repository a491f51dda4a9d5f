// SPDX-License-Identifier: Apache-2.0
// The hair texture of a groom that changes under the artist's hands.
#pragma once

#include "core/field/groom_field.h"
#include "core/lic/painter.h"

#include <memory>
#include <optional>
#include <vector>

namespace whorl {

/// Keeps what mesh, growing area, partings and strokes decide, so that a change makes anew what it touches. One thread
/// at a time.
class LiveTexture {
public:
    /// The texture of `groom` along its field (see groomField). `surface` is that of its mesh; `size` texels a side, 1
    /// to LicPainter::maxSize. The same object as before when nothing differs. Fails only when cancelled.
    Result<std::shared_ptr<const LicTexture>> update(const Groom& groom, std::shared_ptr<const Surface> surface,
                                                     int size, Progress& progress);
    /// The groom's field alone.
    Result<DirectionField> field(const Groom& groom, const std::shared_ptr<const Surface>& surface, Progress& progress);
    /// True when the textures of two grooms can differ.
    static bool differs(const Groom& a, const Groom& b);

private:
    Result<bool> updateField(const Groom& groom, const std::shared_ptr<const Surface>& surface, Progress& progress);

    std::optional<FieldSolver> m_solver;
    std::vector<std::uint8_t> m_grows;
    DirectionField m_field;
    std::optional<LicPainter> m_painter;
    Groom m_solved;   // what m_field was made from
    Groom m_painted;  // what m_texture was made from
    std::shared_ptr<const LicTexture> m_texture;
};

}  // namespace whorl
