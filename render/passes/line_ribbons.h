// SPDX-License-Identifier: Apache-2.0
// Lines of one width on the screen over the picture: partings, a hair that is looked at.
#pragma once

#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/uploads.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace whorl {

class LineRibbons {
public:
    struct Look {
        glm::vec3 root{1.0f};    ///< linear colour at the first point
        glm::vec3 tip{1.0f};     ///< and at the last
        float halfWidth = 1.6f;  ///< pixels
        float opacity = 0.9f;
        float hiddenOpacity = 0.2f;  ///< where something stands before them
    };

    static Result<LineRibbons> create();
    /// Lines of two points or more; others are left out.
    void set(std::span<const std::vector<glm::vec3>> lines, Uploads& uploads);
    /// Over a picture that is shown with `size` pixels.
    void draw(glm::ivec2 size, const Look& look);

private:
    gl::Program m_lines;
    gl::Buffer m_points;
    gl::Buffer m_indices;
    std::size_t m_indexCount = 0;
};

}  // namespace whorl
