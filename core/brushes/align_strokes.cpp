// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/drawn_line.h"
#include "core/surface/parting_line.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace whorl {
namespace {

/// Smooths the field where it is drawn: pieces of strokes under the brush turn towards what all of them there do on
/// average, so that bends straighten and strokes that disagree come together. Lengths stay.
class AlignStrokesBrush : public Brush {
    void step(BrushStep& step) override {
        if (!(step.strength > 0.0f)) return;
        const std::vector<FieldStroke>& strokes = *step.groom.strokes;
        std::vector<Line> lines;
        glm::vec3 mean(0.0f);
        for (std::size_t s = 0; s < strokes.size(); ++s) {
            if (strokes[s].kind != StrokeKind::Along || pixelsTo(step, strokes[s].points) > step.radiusPixels) continue;
            Line line{s, {}, {}};
            for (const SurfacePoint& point : strokes[s].points)
                line.places.push_back(positionAt(step.surface.mesh(), point));
            for (std::size_t k = 0; k + 1 < line.places.size(); ++k) {
                const glm::vec3 middle = (line.places[k] + line.places[k + 1]) * 0.5f;
                const auto pixel = step.view.pixelFromGroom(middle);
                const float distance = pixel ? glm::distance(*pixel, step.pixel) / step.radiusPixels : 1.0f;
                line.weights.push_back(brushFalloff(distance));
                mean += (line.places[k + 1] - line.places[k]) * line.weights.back() * strokes[s].weight;
            }
            lines.push_back(std::move(line));
        }
        const float length = glm::length(mean);
        if (!(length > 0.0f)) return;
        mean /= length;
        for (Line& line : lines) {
            turn(line, mean, step.strength * 0.5f);
            auto traced = tracedParting(step.surface, line.places);
            if (!traced || *traced == strokes[line.stroke].points) continue;
            step.groom.strokes.edit()[line.stroke].points = std::move(*traced);
            step.changed = true;
        }
    }

    struct Line {
        std::size_t stroke;
        std::vector<glm::vec3> places;
        std::vector<float> weights;  // of each piece
    };

    // The middle of the line stays where it is.
    static void turn(Line& line, const glm::vec3& mean, float strength) {
        std::vector<glm::vec3> pieces;
        glm::vec3 centre(0.0f);
        for (const glm::vec3& place : line.places) centre += place / static_cast<float>(line.places.size());
        for (std::size_t k = 0; k + 1 < line.places.size(); ++k) {
            const glm::vec3 piece = line.places[k + 1] - line.places[k];
            const float length = glm::length(piece);
            const glm::vec3 wanted = piece + (mean * length - piece) * (strength * line.weights[k]);
            const float now = glm::length(wanted);
            pieces.push_back(now > 0.0f ? wanted * (length / now) : piece);
        }
        glm::vec3 after(0.0f);
        for (std::size_t k = 0; k < pieces.size(); ++k) line.places[k + 1] = line.places[k] + pieces[k];
        for (const glm::vec3& place : line.places) after += place / static_cast<float>(line.places.size());
        for (glm::vec3& place : line.places) place += centre - after;
    }
};

}  // namespace

std::unique_ptr<Brush> makeAlignStrokes() {
    return std::make_unique<AlignStrokesBrush>();
}

}  // namespace whorl
