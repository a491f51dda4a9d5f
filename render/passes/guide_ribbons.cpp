// SPDX-License-Identifier: Apache-2.0
#include "render/passes/guide_ribbons.h"

#include "core/base/parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace whorl {
namespace {

constexpr float rimOpacity = 0.35f;
constexpr float rimWidth = 0.5f;
constexpr float leastRim = 0.05f;  // fainter rims are left out

struct Projection {
    const SceneBlock& scene;
    glm::vec2 pixels;
    glm::vec2 brush;  // pixels of the picture
    float reach;      // of the brush; 0 without one
    const GuideLook& look;

    // The opacity comes with the depth in view; half widths are set by the caller.
    RasterPoint operator()(const glm::vec3& p) const {
        RasterPoint point{};
        const glm::vec4 clip = scene.clipFromGroom * glm::vec4(p, 1.0f);
        point.halfWidth = -1.0f;
        if (clip.w < 1e-4f) return point;
        const glm::vec2 place = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * pixels;
        point.x = place.x;
        point.y = place.y;
        // A little towards the eye, so that lines lie on the skin and not in it.
        point.depth = clip.z / clip.w * 0.5f + 0.5f - 0.0002f;
        point.halfWidth = 0.0f;
        const float near =
            reach > 0.0f ? 1.0f - glm::smoothstep(reach, reach * 1.6f + 8.0f, glm::distance(place, brush)) : 0.0f;
        const float behind = glm::smoothstep(look.fade.x, look.fade.y, clip.w);
        point.colour[3] = glm::mix(look.opacityFar, look.opacityNear, near) * (1.0f - 0.75f * behind);
        return point;
    }
};

RasterPoint with(RasterPoint point, float halfWidth, const glm::vec3& colour, float opacity) {
    if (point.halfWidth >= 0.0f) point.halfWidth = halfWidth;
    for (int i = 0; i < 3; ++i) point.colour[i] = colour[i];
    point.colour[3] *= opacity;
    return point;
}

}  // namespace

void makeGuideRibbons(const GuideSet& guides, std::uint32_t pieces, const SceneBlock& scene,
                      const OverlayState& overlay, const GuideLook& look, glm::ivec2 drawn, glm::ivec2 shown,
                      GuideRibbons& ribbons) {
    const glm::vec2 pixels(drawn);
    const float scale = pixels.y / static_cast<float>(std::max(shown.y, 1));
    const Projection project{
        scene, pixels, glm::vec2(overlay.brushPixel.x, static_cast<float>(shown.y) - overlay.brushPixel.y) * scale,
        overlay.showBrush ? overlay.brushRadius * scale : 0.0f, look};
    const float half = std::max(look.halfWidth * scale, 0.4f);
    const float dot = std::max(look.rootRadius * scale, 0.4f);

    // Where each guide's points and segments begin: a rim, the line, a dot.
    struct Start {
        std::size_t point, segment;
        std::uint32_t steps;
    };
    std::vector<Start> starts;
    starts.reserve(guides.count() + 1);
    std::size_t pointCount = 0;
    std::size_t segmentCount = 0;
    for (std::size_t i = 0; i < guides.count(); ++i) {
        const auto last = static_cast<std::uint32_t>(guides.points(i).size()) - 1;
        const std::uint32_t steps = std::min(last, pieces);
        starts.push_back({pointCount, segmentCount, steps});
        pointCount += 2 * (steps + 1) + 2;
        segmentCount += 2 * steps + 1;
    }
    ribbons.points.resize(pointCount);
    ribbons.segments.resize(segmentCount);
    parallelFor(guides.count(), 128, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto points = guides.points(i);
            const Start& start = starts[i];
            const std::uint32_t steps = start.steps;
            RasterPoint* rim = ribbons.points.data() + start.point;
            RasterPoint* line = rim + steps + 1;
            std::uint32_t* segment = ribbons.segments.data() + start.segment;
            const auto last = static_cast<std::uint32_t>(points.size()) - 1;
            RasterPoint root = project(points[0]);
            for (std::uint32_t step = 0; step <= steps; ++step) {
                const std::uint32_t index = steps > 0 ? step * last / steps : 0;
                const RasterPoint place = step == 0 ? root : project(points[index]);
                const float along = static_cast<float>(step) / static_cast<float>(std::max(steps, 1u));
                rim[step] = with(place, half + rimWidth, glm::vec3(0.0f), rimOpacity);
                if (rim[step].colour[3] < leastRim) rim[step].halfWidth = -1.0f;
                line[step] = with(place, half, glm::mix(look.rootColour, look.tipColour, along), 1.0f);
                if (step == steps) break;
                segment[step] = static_cast<std::uint32_t>(start.point + step);
                segment[steps + step] = static_cast<std::uint32_t>(start.point + steps + 1 + step);
            }
            // A ribbon as long as wide stands for the dot.
            RasterPoint* ends = line + steps + 1;
            ends[0] = ends[1] = with(root, dot, look.dotColour, 1.0f);
            ends[0].x -= dot;
            ends[1].x += dot;
            segment[2 * steps] = static_cast<std::uint32_t>(start.point + 2 * (steps + 1));
        }
    });
}

}  // namespace whorl
