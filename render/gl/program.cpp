// SPDX-License-Identifier: Apache-2.0
#include "render/gl/program.h"

#include <epoxy/gl.h>
#include <glm/gtc/type_ptr.hpp>

#include <vector>

namespace whorl::gl {
namespace {

void deleteProgram(unsigned name) {
    glDeleteProgram(name);
}
void deleteShader(unsigned name) {
    glDeleteShader(name);
}

// One text of all included files. Files are numbered in #line, so that a fault can be named by file.
struct Expanded {
    std::string text;
    std::vector<std::string> files;
};

void expand(std::string_view file, std::string_view source, std::string_view defines, Expanded& out) {
    for (const std::string& seen : out.files) {
        if (seen == file) return;
    }
    const std::size_t number = out.files.size();
    out.files.emplace_back(file);
    if (number == 0) {
        out.text += "#version 450 core\n";
        out.text += defines;
        out.text += "\n";
    }
    out.text += "#line 1 " + std::to_string(number) + "\n";
    std::size_t line = 1;
    while (!source.empty()) {
        const std::size_t end = std::min(source.find('\n'), source.size());
        const std::string_view row = source.substr(0, end);
        constexpr std::string_view word = "#include \"";
        if (row.starts_with(word)) {
            const std::string_view name = row.substr(word.size(), row.find('"', word.size()) - word.size());
            const std::string_view included = shaderText(name);
            if (included.empty()) {
                out.text += "#error the file " + std::string(name) + " is not in resources/shaders\n";
            }
            expand(name, included, "", out);
            out.text += "#line " + std::to_string(line + 1) + " " + std::to_string(number) + "\n";
        } else {
            out.text += row;
            out.text += '\n';
        }
        source.remove_prefix(std::min(end + 1, source.size()));
        ++line;
    }
}

// Drivers write "0:12(3): error: ..." (Mesa), "0(12) : error ..." (NVIDIA) or "ERROR: 0:12: ..." (others).
std::string readable(const std::string& log, const std::vector<std::string>& files) {
    std::string first = log.substr(0, log.find('\n'));
    std::size_t at = first.find_first_of("0123456789");
    if (at == std::string::npos) return first;
    std::size_t end = at;
    std::size_t file = 0;
    while (end < first.size() && first[end] >= '0' && first[end] <= '9' && file < 1000) {
        file = file * 10 + static_cast<std::size_t>(first[end++] - '0');
    }
    if (file >= files.size() || end >= first.size() || (first[end] != ':' && first[end] != '(')) return first;
    std::size_t lineEnd = ++end;
    while (lineEnd < first.size() && first[lineEnd] >= '0' && first[lineEnd] <= '9') ++lineEnd;
    return files[file] + ", line " + first.substr(end, lineEnd - end) + ": " + first;
}

Result<Name> compile(unsigned kind, std::string_view file, std::string_view source, std::string_view defines) {
    Expanded full;
    expand(file, source, defines, full);
    Name shader(glCreateShader(kind), deleteShader);
    const char* text = full.text.c_str();
    glShaderSource(shader.get(), 1, &text, nullptr);
    glCompileShader(shader.get());
    int good = 0;
    glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &good);
    if (good != 0) return shader;
    int length = 0;
    glGetShaderiv(shader.get(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader.get(), length, nullptr, log.data());
    return Error{"The graphics driver refuses the shader " + readable(log.c_str(), full.files) +
                 "; update the driver."};
}

}  // namespace

struct Program::Stage {
    unsigned kind;
    std::string_view file;
};

Result<Program> Program::link(std::string_view text, std::initializer_list<Stage> stages, std::string_view defines) {
    Program program;
    program.m_name = Name(glCreateProgram(), deleteProgram);
    const unsigned name = program.m_name.get();
    glObjectLabel(GL_PROGRAM, name, static_cast<GLsizei>(text.size()), text.data());
    std::vector<Name> shaders;
    for (const Stage& stage : stages) {
        const std::string_view source = shaderText(stage.file);
        if (source.empty()) return Error{"The shader " + std::string(stage.file) + " is missing in this build."};
        Result<Name> shader = compile(stage.kind, stage.file, source, defines);
        if (!shader) return shader.error();
        glAttachShader(name, shader->get());
        shaders.push_back(std::move(*shader));
    }
    glLinkProgram(name);
    for (const Name& shader : shaders) glDetachShader(name, shader.get());
    int good = 0;
    glGetProgramiv(name, GL_LINK_STATUS, &good);
    if (good == 0) {
        std::string log(1024, '\0');
        glGetProgramInfoLog(name, 1024, nullptr, log.data());
        log = log.c_str();
        return Error{"The graphics driver can not link the shader " + std::string(text) + ": " +
                     log.substr(0, log.find('\n')) + "; update the driver."};
    }
    return program;
}

Result<Program> Program::draw(std::string_view vertex, std::string_view fragment, std::string_view defines) {
    return link(fragment, {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}}, defines);
}

Result<Program> Program::compute(std::string_view file, std::string_view defines) {
    return link(file, {{GL_COMPUTE_SHADER, file}}, defines);
}

void Program::use() const {
    glUseProgram(m_name.get());
}

int Program::location(std::string_view uniform) {
    const auto found = m_locations.find(uniform);
    if (found != m_locations.end()) return found->second;
    const std::string name(uniform);
    const int place = glGetUniformLocation(m_name.get(), name.c_str());
    m_locations.emplace(name, place);
    return place;
}

void Program::set(std::string_view uniform, int value) {
    glProgramUniform1i(m_name.get(), location(uniform), value);
}
void Program::set(std::string_view uniform, unsigned value) {
    glProgramUniform1ui(m_name.get(), location(uniform), value);
}
void Program::set(std::string_view uniform, float value) {
    glProgramUniform1f(m_name.get(), location(uniform), value);
}
void Program::set(std::string_view uniform, glm::vec2 value) {
    glProgramUniform2f(m_name.get(), location(uniform), value.x, value.y);
}
void Program::set(std::string_view uniform, glm::ivec2 value) {
    glProgramUniform2i(m_name.get(), location(uniform), value.x, value.y);
}
void Program::set(std::string_view uniform, glm::vec3 value) {
    glProgramUniform3f(m_name.get(), location(uniform), value.x, value.y, value.z);
}
void Program::set(std::string_view uniform, glm::vec4 value) {
    glProgramUniform4f(m_name.get(), location(uniform), value.x, value.y, value.z, value.w);
}
void Program::set(std::string_view uniform, const glm::mat4& value) {
    glProgramUniformMatrix4fv(m_name.get(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

Result<void> tryCompile(std::string_view file, std::string_view source) {
    Result<Name> shader = compile(GL_FRAGMENT_SHADER, file, source, "");
    if (!shader) return shader.error();
    return {};
}

}  // namespace whorl::gl
