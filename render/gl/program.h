// SPDX-License-Identifier: Apache-2.0
// Shader programs from the sources in resources/shaders, which are compiled into the library.
#pragma once

#include "core/base/result.h"
#include "render/gl/objects.h"

#include <glm/mat4x4.hpp>

#include <map>
#include <string>
#include <string_view>

namespace whorl::gl {

/// Text of resources/shaders/NAME; empty when there is none.
std::string_view shaderText(std::string_view name);

/// A linked program. Faults name the shader's file and line.
class Program {
public:
    Program() = default;
    /// Files of resources/shaders. `#include "file.glsl"` works, one level deep or more. `defines` are lines that
    /// come after #version.
    static Result<Program> draw(std::string_view vertex, std::string_view fragment, std::string_view defines = "");
    static Result<Program> compute(std::string_view file, std::string_view defines = "");

    void use() const;
    void set(std::string_view uniform, int value);
    void set(std::string_view uniform, unsigned value);
    void set(std::string_view uniform, float value);
    void set(std::string_view uniform, glm::vec2 value);
    void set(std::string_view uniform, glm::ivec2 value);
    void set(std::string_view uniform, glm::vec3 value);
    void set(std::string_view uniform, glm::vec4 value);
    void set(std::string_view uniform, const glm::mat4& value);

private:
    struct Stage;
    static Result<Program> link(std::string_view label, std::initializer_list<Stage> stages, std::string_view defines);
    int location(std::string_view uniform);

    Name m_name;
    std::map<std::string, int, std::less<>> m_locations;
};

/// Compiles a source that is not in resources/shaders, for tests of the error texts.
Result<void> tryCompile(std::string_view file, std::string_view source);

}  // namespace whorl::gl
