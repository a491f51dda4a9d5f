// SPDX-License-Identifier: Apache-2.0
// Draws a groom and its hair; uploads only what changed since the last picture.
#pragma once

#include "core/base/result.h"
#include "core/field/direction_field.h"
#include "core/hair/strands.h"
#include "core/model/groom.h"
#include "core/surface/surface.h"
#include "render/camera.h"
#include "render/lic_image.h"
#include "render/uploads.h"
#include "render/view_settings.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace whorl {

/// Needs a current OpenGL 4.5 context in every call, always the same and in one thread (also in the destructor).
/// Inside Qt that is the QOpenGLWidget's; headless it is render/gl/headless.h.
class Renderer {
public:
    static Result<std::unique_ptr<Renderer>> create();
    ~Renderer();

    /// What to draw from now on. Compares parts with what was there (sameAs, tiles, blocks) and uploads the rest.
    /// `strands` may be null.
    void setGroom(const Groom& groom, std::shared_ptr<const Surface> surface);
    void setStrands(std::shared_ptr<const Strands> strands);

    /// Hair painted on the mesh, which ViewSettings::showLic shows as Groom::lic lights it; may be null. Painted for
    /// another mesh than the groom's it is not shown. Uploads the tiles that are not those of the image before.
    void setLicImage(std::shared_ptr<const LicImage> image);

    /// Colours of the mesh's triangles (linear, opacity last) that ViewSettings::heat shows; may be null.
    void setTriangleColours(std::shared_ptr<const std::vector<glm::vec4>> colours);

    /// Where the groom's field turns, shown with the strokes.
    void setSingularities(const std::vector<FieldSingularity>& places);

    /// A hair that is looked at and the guides that shape it, drawn over everything; empty for none. Points in the
    /// space of the mesh.
    void setHighlight(const std::vector<glm::vec3>& hair, std::span<const std::vector<glm::vec3>> guides);

    /// Draws into framebuffer object `target` (0: the window) of `size` pixels, multisampled in an own framebuffer and
    /// resolved there.
    void draw(const Camera& camera, const ViewSettings& settings, const OverlayState& overlay, unsigned target,
              glm::ivec2 size);

    /// Nearest guide to a pixel within `radius` pixels, not hidden by the mesh; its index.
    std::optional<std::size_t> pickGuide(const Camera& camera, glm::vec2 pixel, float radius, glm::ivec2 size) const;

    /// Number (in the strands that are shown) of the foremost hair within `radius` pixels, not hidden by the mesh.
    std::optional<std::size_t> pickHair(const Camera& camera, glm::vec2 pixel, float radius, glm::ivec2 size) const;

    /// Milliseconds of the last draw, by pass, for the overlay and the bench.
    struct Timing {
        double upload = 0;
        double shadows = 0;
        double draw = 0;
    };
    Timing timing() const;

    /// What was uploaded since the renderer was made: shows that only changes travel.
    const Uploads& uploads() const;
    /// Drawn by the processor, without a graphics card: draw with ViewSettings::interactive while the view moves.
    bool software() const;
    /// Hair and guides are drawn by the processor, many times faster than triangles are without a graphics card: so it
    /// is where `software` says so. Both ways give the same picture but for rounding.
    void setHairByProcessor(bool on);

private:
    Renderer();
    struct State;
    std::unique_ptr<State> m_state;
};

}  // namespace whorl
