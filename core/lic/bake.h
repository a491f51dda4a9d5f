// SPDX-License-Identifier: Apache-2.0
// Hair texture as images in the mesh's UVs, for games and for renderers without hair.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/field/direction_field.h"
#include "core/model/groom.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace whorl {

enum class BakeMap { Colour, Opacity, Flow, Height };
inline constexpr std::array<std::string_view, 4> bakeMapNames{"colour", "opacity", "flow", "height"};

struct BakeOptions {
    static constexpr int maxSize = 8192;
    static constexpr int maxMargin = 256;

    int size = 1024;         ///< texels a side, 1 to maxSize
    int margin = 8;          ///< texels around charts that get a value, 0 to maxMargin
    bool reference = false;  ///< the convolution place by place, by Runge-Kutta steps on the mesh: slow
};

/// Square images; row 0 is the top (v = 1), one value a texel.
struct LicBake {
    /// What a texel is. Those in the margin hold what is next to them in the chart, or beyond its seam.
    enum class Texel : std::uint8_t { Outside, Inside, Margin };

    int size = 0;
    std::vector<Texel> texels;
    std::vector<glm::vec3> colour;  ///< linear: the hair's colour, light and dark hairs told apart by the contrast
    std::vector<float> opacity;     ///< how much hair lies there, 0 to 1
    /// Direction of the hair in the frame of tangentFrame at the texel's place: x along the tangent (u grows), y along
    /// the bitangent (v grows); unit length, or zero where no hair lies.
    std::vector<glm::vec2> flow;
    std::vector<float> height;  ///< metres above the dark hairs: 0 to LicParams::height
    float mostHeight = 0.0f;    ///< LicParams::height
};

/// One texel a place of the skin, those whose middle lies in a triangle's UVs; where UVs overlap the last triangle
/// counts. `field` is the groom's (groomField), `surface` that of its mesh. All of LicParams count but those of light.
/// Fails only when cancelled.
Result<LicBake> bakeLic(const Groom& groom, std::shared_ptr<const Surface> surface, const DirectionField& field,
                        const BakeOptions& options, Progress& progress);

/// A number of 0 to 1 a channel as files hold it: colour encoded for the eye (sRGB) when `encoded`. Three channels for
/// colour and flow, one for opacity and height. Flow: red and green are 0.5 + 0.5 * direction, both 0.5 where no hair
/// lies; blue is 0. Green is up, as in OpenGL and glTF; DirectX' convention has it as 1 - green. Height: a share of
/// mostHeight.
Map imageOf(const LicBake& bake, BakeMap map, TexelFormat format, bool encoded);

/// Tangent and bitangent at a place: unit, perpendicular to the normal and to each other, along growing u, and to the
/// side where v grows (as MikkTSpace has them for a triangle). Nothing where the triangle's UVs have no area.
struct TangentFrame {
    glm::vec3 tangent{0.0f};
    glm::vec3 bitangent{0.0f};
};
std::optional<TangentFrame> tangentFrame(const SurfaceMesh& mesh, const SurfacePoint& point);

/// The place of the skin in the middle of each of size * size texels; triangle noTriangle where there is none.
std::vector<SurfacePoint> placesOfTexels(const SurfaceMesh& mesh, int size);

}  // namespace whorl
