// SPDX-License-Identifier: Apache-2.0
// A brush turns a groom into another, step by step along a stroke.
#pragma once

#include "core/base/result.h"
#include "core/model/groom.h"
#include "core/surface/surface.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// A brush is one file core/brushes/NAME.cpp and one line in brushes.cpp. What all brushes share is done once in
// stroke.h: spacing, falloff, pressure, mirror, reach. Button, shortcut, tooltip, help page, script name and the law
// tests follow from the list.
//
// Spaces: "Groom" is the space of the mesh (metres); "Pixel" has its origin at the top left of the viewport.

namespace whorl {

/// The camera that a stroke is drawn through.
struct StrokeView {
    glm::mat4 clipFromGroom{1.0f};
    glm::vec3 eyeGroom{0.0f};
    glm::vec2 viewportPixels{1.0f};

    /// Place in the viewport; nothing for points at or behind the eye.
    std::optional<glm::vec2> pixelFromGroom(const glm::vec3& point) const;
    /// Unit direction of the ray through a pixel.
    glm::vec3 rayDirection(glm::vec2 pixel) const;
    glm::vec3 rayOrigin(glm::vec2 pixel) const;
    /// Length of one pixel at the depth of `point`, metres.
    float metresPerPixel(const glm::vec3& point) const;
};

enum class Reach : std::uint8_t {
    Projected,  ///< everything under the brush circle, at any depth
    Spherical,  ///< within the ball around the place on the skin or hair under the cursor
};

/// What the artist set for brushes; the editor keeps it beside the groom.
struct BrushSettings {
    float radiusPixels = 50.0f;  ///< 1 to 2000
    float strength = 0.5f;       ///< 0 to 1
    float value = 1.0f;          ///< what paint brushes paint, 0 to 1
    Reach reach = Reach::Projected;
    bool mirrorX = false;         ///< does the same on the other side of x = 0
    bool frontOnly = true;        ///< leaves guides alone whose root faces away or is hidden behind the mesh
    bool keepLength = true;       ///< combing keeps the length of every segment
    bool keepOutside = true;      ///< combing keeps guides out of the skin
    bool respectPartings = true;  ///< leaves guides alone that a parting separates from where the stroke is
    bool pressureSize = false;
    bool pressureStrength = true;
    bool invert = false;  ///< Ctrl: the brush's opposite (grow for cut, erase for paint)
    std::string map{};    ///< map that paint brushes paint; must be a data map of the groom
};

/// One place of the pointer on the way.
struct StrokePoint {
    glm::vec2 pixel{0.0f};
    float pressure = 1.0f;  ///< 0 to 1
};

/// What one stroke remembers for its brush and the brush's mirror image (index of the guides, texels under way).
struct StrokeScratch;

/// What a brush gets at every step; already spaced, mirrored and weighted by pressure.
struct BrushStep {
    Groom& groom;  ///< edited in place
    const Surface& surface;
    const StrokeView& view;
    const BrushSettings& settings;
    glm::vec2 pixel{0.0f};            ///< centre of the brush now
    glm::vec2 previousPixel{0.0f};    ///< centre at the last step
    std::optional<SurfaceHit> hit{};  ///< the skin under the cursor
    float radiusPixels = 0.0f;        ///< after pressure
    float strength = 0.0f;            ///< after pressure
    bool mirrored = false;            ///< this is the mirror image: the view is reflected already, pixels stay the same
    StrokeScratch* scratch = nullptr;  ///< shared by both; never null in a step
    bool changed = false;              ///< the brush says here whether it changed the groom
};

/// One stroke's worth of brush. Made anew for each stroke.
class Brush {
public:
    virtual ~Brush() = default;
    /// Once, before the first step; may refuse with a sentence ("Choose a map to paint first.").
    virtual Result<void> begin(const Groom& groom, const BrushSettings& settings);
    virtual void step(BrushStep& step) = 0;
    /// Once, after the last step.
    virtual void end(Groom& groom, const Surface& surface, const BrushSettings& settings);
};

/// A brush in the list: everything that menus, help and scripts need.
struct BrushInfo {
    std::string_view id;        ///< script name, for ever: "comb"
    std::string_view label;     ///< "Comb"
    std::string_view shortcut;  ///< "C"
    std::string_view tip;       ///< one or two sentences
    std::string_view undoText;  ///< "Comb guides"
    bool paintsMap = false;
    bool drawsStrokes = false;  ///< for the direction field: edits Groom::strokes only
    bool paintsGroups = false;  ///< paints the number of a group, BrushSettings::value * 255, into the group map
    float spacing = 0.1f;       ///< from step to step, in radii; never less than one pixel
    std::unique_ptr<Brush> (*make)() = nullptr;
};

/// All brushes in the order of the toolbar.
std::span<const BrushInfo> brushes();
const BrushInfo* findBrush(std::string_view id);

/// Weight of a brush at `distance` from its centre, in radii: 1 at 0, smooth, 0 from 1 on.
float brushFalloff(float distance);

/// A stroke in progress: feeds a brush with evenly spaced, mirrored steps. The result does not depend on how the
/// pointer's path was cut into events.
class Stroke {
public:
    /// Refuses as the brush does. `groom` is where the stroke starts; it is not changed.
    static Result<Stroke> begin(const BrushInfo& brush, Groom groom, std::shared_ptr<const Surface> surface,
                                const StrokeView& view, const BrushSettings& settings);
    /// The pointer moved here. True when the groom changed.
    bool moveTo(const StrokePoint& point);
    /// Ends the stroke and gives the result.
    Groom finish();
    /// The groom so far: what the viewport shows meanwhile.
    const Groom& groom() const { return m_groom; }

private:
    Stroke() = default;
    bool stepAt(glm::vec2 previous, glm::vec2 pixel, float pressure);
    bool stepOn(Brush& brush, const StrokeView& view, bool mirrored, glm::vec2 previous, glm::vec2 pixel,
                float pressure);

    const BrushInfo* m_info = nullptr;
    std::unique_ptr<Brush> m_brush;
    std::unique_ptr<Brush> m_mirrorBrush;
    Groom m_groom;
    std::shared_ptr<const Surface> m_surface;
    std::shared_ptr<StrokeScratch> m_scratch;
    StrokeView m_view;
    StrokeView m_mirrorView;
    BrushSettings m_settings;
    std::optional<StrokePoint> m_last;  // the newest event
    glm::vec2 m_lastStep{0.0f};         // centre of the newest step
    double m_distanceToNext = 0.0;      // pixels from m_last to the next step
};

}  // namespace whorl
