// SPDX-License-Identifier: Apache-2.0
#include "render/passes/overlay_pass.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

namespace whorl {

Result<OverlayPass> OverlayPass::create() {
    OverlayPass pass;
    Result<gl::Program> program = gl::Program::draw("overlay.vert.glsl", "overlay.frag.glsl");
    if (!program) return program.error();
    pass.m_program = std::move(*program);
    ImGuiContext* const before = ImGui::GetCurrentContext();
    pass.m_context = ImGui::CreateContext();
    ImGui::SetCurrentContext(pass.m_context);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    unsigned char* texels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
    pass.m_font = gl::Texture::make2D("overlay font", gl::Format::Rgba8, glm::ivec2(width, height), gl::Wrap::Clamp);
    pass.m_font.upload(glm::ivec2(0), glm::ivec2(width, height), texels);
    pass.m_vertices = gl::Buffer("overlay vertices");
    pass.m_indices = gl::Buffer("overlay indices");
    ImGui::SetCurrentContext(before);
    return pass;
}

OverlayPass::OverlayPass(OverlayPass&& other) noexcept
    : m_context(std::exchange(other.m_context, nullptr)),
      m_program(std::move(other.m_program)),
      m_vertices(std::move(other.m_vertices)),
      m_indices(std::move(other.m_indices)),
      m_font(std::move(other.m_font)) {}

OverlayPass& OverlayPass::operator=(OverlayPass&& other) noexcept {
    std::swap(m_context, other.m_context);
    std::swap(m_program, other.m_program);
    std::swap(m_vertices, other.m_vertices);
    std::swap(m_indices, other.m_indices);
    std::swap(m_font, other.m_font);
    return *this;
}

OverlayPass::~OverlayPass() {
    if (m_context != nullptr) ImGui::DestroyContext(m_context);
}

void OverlayPass::draw(const OverlayState& overlay, glm::ivec2 size) {
    if (!overlay.showBrush && overlay.text.empty()) return;
    ImGuiContext* const before = ImGui::GetCurrentContext();
    ImGui::SetCurrentContext(m_context);
    ImGui::GetIO().DisplaySize = ImVec2(static_cast<float>(size.x), static_cast<float>(size.y));
    ImGui::NewFrame();
    const float scale = std::clamp(overlay.scale, 0.5f, 8.0f);
    ImDrawList* list = ImGui::GetForegroundDrawList();
    if (overlay.showBrush && overlay.brushRadius > 0.0f) {
        const ImVec2 centre(overlay.brushPixel.x, overlay.brushPixel.y);
        const int corners = std::clamp(static_cast<int>(overlay.brushRadius), 32, 256);
        // A dark line beside the bright one, so that the circle shows on skin, hair and background.
        list->AddCircle(centre, overlay.brushRadius + scale, IM_COL32(0, 0, 0, 130), corners, 1.5f * scale);
        list->AddCircle(centre, overlay.brushRadius, IM_COL32(255, 255, 255, 225), corners, 1.5f * scale);
        const float strength = std::clamp(overlay.brushStrength, 0.0f, 1.0f);
        if (strength > 0.0f) {
            list->AddCircle(centre, std::max(overlay.brushRadius * strength, 1.0f), IM_COL32(255, 190, 90, 150),
                            corners, scale);
        }
        list->AddCircleFilled(centre, 1.75f * scale, IM_COL32(255, 255, 255, 225));
    }
    if (!overlay.text.empty()) {
        const float height = ImGui::GetFontSize() * scale;
        const ImVec2 at(12.0f * scale, static_cast<float>(size.y) - height - 10.0f * scale);
        const ImVec2 shadow(at.x + scale, at.y + scale);
        list->AddText(ImGui::GetFont(), height, shadow, IM_COL32(0, 0, 0, 200), overlay.text.c_str());
        list->AddText(ImGui::GetFont(), height, at, IM_COL32(230, 232, 236, 235), overlay.text.c_str());
    }
    ImGui::Render();
    const ImDrawData* data = ImGui::GetDrawData();
    gl::apply({.depth = gl::Depth::None, .blend = gl::Blend::Over});
    m_font.bind(0);
    m_program.set("viewportPixels", glm::vec2(size));
    for (int i = 0; i < data->CmdListsCount; ++i) {
        const ImDrawList& commands = *data->CmdLists[i];
        m_vertices.upload(commands.VtxBuffer.Data,
                          static_cast<std::size_t>(commands.VtxBuffer.Size) * sizeof(ImDrawVert));
        m_indices.upload(commands.IdxBuffer.Data,
                         static_cast<std::size_t>(commands.IdxBuffer.Size) * sizeof(ImDrawIdx));
        static_assert(sizeof(ImDrawVert) == 20 && sizeof(ImDrawIdx) == 2);
        m_vertices.bindStorage(0);
        m_indices.bindIndices();
        for (const ImDrawCmd& command : commands.CmdBuffer) {
            const ImVec4& box = command.ClipRect;
            const int left = std::max(static_cast<int>(box.x), 0);
            const int bottom = std::max(size.y - static_cast<int>(box.w), 0);
            gl::scissor(glm::ivec4(left, bottom, std::max(static_cast<int>(box.z) - left, 0),
                                   std::max(size.y - static_cast<int>(box.y) - bottom, 0)));
            m_program.set("firstVertex", static_cast<unsigned>(command.VtxOffset));
            m_program.use();
            gl::drawIndexed16(command.IdxOffset, command.ElemCount);
        }
    }
    gl::noScissor();
    ImGui::SetCurrentContext(before);
}

}  // namespace whorl
