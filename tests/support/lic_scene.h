// SPDX-License-Identifier: Apache-2.0
// Grooms with a direction field for tests of hair texture, and measures of what is painted on them.
#pragma once

#include "core/base/correlation.h"
#include "core/field/direction_field.h"
#include "core/lic/painter.h"
#include "core/model/groom.h"

#include <optional>
#include <vector>

namespace whorl::testing {

/// Lines by places in space; each leads over the skin through the places nearest to them.
using Lines = std::vector<std::vector<glm::vec3>>;

/// Three strokes on a ball of radius 0.1 about the origin.
extern const Lines aroundTheBall;

/// A groom with all that a texture is painted from.
struct LicScene {
    Groom groom;
    std::shared_ptr<const Surface> surface;
    DirectionField field;             ///< of the groom as it was when last solved
    std::vector<std::uint8_t> grows;  ///< one a triangle; empty: as the groom's densities have it

    /// A new groom, solved.
    explicit LicScene(SurfaceMesh mesh, const Lines& strokes = {}, const Lines& partings = {});
    /// One as it is, solved.
    explicit LicScene(Groom made);
    void stroke(const std::vector<glm::vec3>& places);
    void part(const std::vector<glm::vec3>& places);
    void solve();
    LicParams& lic() { return groom.lic.edit(); }
    SurfacePoint placeAt(const glm::vec3& position) const { return surface->query.nearest(position)->point; }
};

LicPainter painterFor(const LicScene& scene, int size, LicLayout layout = LicLayout::Best);
LicTexture painted(const LicPainter& painter, const LicScene& scene, const LicTexture* before = nullptr);

/// Number of a texel in the layers; nothing in the frame around.
std::optional<std::size_t> texelOf(const LicPainter& painter, const TexelAtlas::Slot& slot);
/// The same by a place of the skin.
std::size_t texelAt(const LicTexture& texture, const SurfacePoint& at);

float degreesBetween(const glm::vec3& a, const glm::vec3& b);

}  // namespace whorl::testing
