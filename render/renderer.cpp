// SPDX-License-Identifier: Apache-2.0
#include "render/renderer.h"

#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/passes/guides_pass.h"
#include "render/passes/hair_pass.h"
#include "render/passes/line_ribbons.h"
#include "render/passes/mesh_pass.h"
#include "render/passes/overlay_pass.h"
#include "render/passes/partings_pass.h"
#include "render/passes/pick.h"
#include "render/passes/picture_pass.h"
#include "render/passes/shadow_pass.h"
#include "render/passes/strokes_pass.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace whorl {
namespace {

double milliseconds(std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since).count();
}

// How much is drawn: everything, or what a processor alone draws in a frame's time.
struct Effort {
    HairDetail hair{};
    int samples = 1;
    int shadowTaps = 9;
    bool byProcessor = false;
    bool quickHair = false;
    float resolution = 1.0f;
    bool litByVertex = false;
    std::uint32_t guidePieces = 255;
    float lightSlack = 0.0f;  // radians that the light may turn before shadows follow
};

Effort effortFor(const ViewSettings& settings, const gl::ContextInfo& context, std::size_t triangles,
                 const Strands* strands, glm::ivec2 size, bool byProcessor) {
    Effort effort;
    effort.byProcessor = byProcessor;
    effort.samples = std::clamp(settings.samples, 1, std::min(4, context.maxSamples));
    if (effort.samples == 3) effort.samples = 2;
    const bool reduced = settings.interactive && context.software;
    if (reduced) {
        effort.samples = 1;
        effort.shadowTaps = 1;
        effort.quickHair = true;
        effort.guidePieces = 7;
        // Making a small picture large costs as much as drawing a mesh: only where full size would cost more.
        constexpr float pixels = 1.0e6f;
        effort.resolution = std::min(1.0f, std::sqrt(pixels / static_cast<float>(size.x * size.y)));
        effort.litByVertex = triangles < 40000;
        effort.lightSlack = 0.15f;
    }
    if (strands != nullptr && strands->count() > 0) {
        const std::size_t count = strands->count();
        const std::size_t pieces = std::max<std::size_t>(strands->vertexCount() / count, 2) - 1;
        const std::size_t most = reduced ? 7 : 255;
        effort.hair.pointsPerHair = static_cast<std::uint32_t>(std::min(pieces, most)) + 1;
        if (reduced) {
            constexpr std::size_t segments = 48000;
            const std::size_t hairs = std::max<std::size_t>(segments / (effort.hair.pointsPerHair - 1), 1);
            effort.hair.stride = static_cast<std::uint32_t>((count + hairs - 1) / hairs);
        }
        const float drawn = static_cast<float>(effort.hair.hairs(*strands));
        const float fuller = std::pow(std::max(settings.fullCount / static_cast<float>(count), 1.0f), 0.6f);
        effort.hair.widthScale = std::min(fuller, 3.0f) * std::pow(static_cast<float>(count) / drawn, 0.8f);
    }
    return effort;
}

}  // namespace

struct Renderer::State {
    gl::ContextInfo context;
    gl::VertexArray vertexArray;
    MeshPass mesh;
    GuidesPass guides;
    PartingsPass partings;
    StrokesPass strokes;
    LineRibbons looked;    // at: the hair
    LineRibbons lookedBy;  // the guides that shape it
    HairPass hair;
    ShadowPass shadows;
    LicPass lic;
    PicturePass picture;
    OverlayPass overlay;
    gl::Buffer sceneBuffer;
    gl::TimerQuery shadowTimer;
    gl::TimerQuery drawTimer;
    StrandRaster raster{};
    GuideRibbons guideRibbons{};
    bool byProcessor = false;

    Groom groom{};
    std::shared_ptr<const Surface> surface{};
    std::shared_ptr<const Strands> strands{};
    Bounds hairBounds{};
    Bounds guideBounds{};
    Uploads uploads{};
    double uploadMilliseconds = 0.0;
    double shadowMilliseconds = 0.0;

    Bounds sceneBounds() const {
        Bounds bounds;
        if (surface != nullptr) bounds.add(surface->bounds);
        if (!hairBounds.empty()) bounds.add(hairBounds);
        if (!guideBounds.empty()) bounds.add(guideBounds);
        return bounds;
    }
};

Renderer::Renderer() = default;
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create() {
    Result<gl::ContextInfo> context = gl::contextInfo();
    if (!context) return context.error();
    Result<MeshPass> mesh = MeshPass::create(context->maxTextureSize);
    if (!mesh) return mesh.error();
    Result<GuidesPass> guides = GuidesPass::create();
    if (!guides) return guides.error();
    Result<PartingsPass> partings = PartingsPass::create();
    if (!partings) return partings.error();
    Result<StrokesPass> strokes = StrokesPass::create();
    if (!strokes) return strokes.error();
    Result<LineRibbons> looked = LineRibbons::create();
    if (!looked) return looked.error();
    Result<LineRibbons> lookedBy = LineRibbons::create();
    if (!lookedBy) return lookedBy.error();
    Result<HairPass> hair = HairPass::create();
    if (!hair) return hair.error();
    Result<PicturePass> picture = PicturePass::create();
    if (!picture) return picture.error();
    Result<OverlayPass> overlay = OverlayPass::create();
    if (!overlay) return overlay.error();
    std::unique_ptr<Renderer> renderer(new Renderer);
    renderer->m_state = std::unique_ptr<State>(
        new State{std::move(*context), gl::VertexArray(), std::move(*mesh), std::move(*guides), std::move(*partings),
                  std::move(*strokes), std::move(*looked), std::move(*lookedBy), std::move(*hair), ShadowPass(),
                  LicPass(), std::move(*picture), std::move(*overlay), gl::Buffer("scene"),
                  gl::TimerQuery("shadow time"), gl::TimerQuery("draw time")});
    renderer->m_state->byProcessor = renderer->m_state->context.software;
    return renderer;
}

void Renderer::setGroom(const Groom& groom, std::shared_ptr<const Surface> surface) {
    const auto start = std::chrono::steady_clock::now();
    State& state = *m_state;
    const bool meshChanged = !state.groom.mesh.sameAs(groom.mesh);
    const bool partsChanged = !state.groom.partSettings.sameAs(groom.partSettings);
    state.mesh.setGroom(groom, state.uploads);
    if (!state.groom.guides.sameAs(groom.guides)) {
        state.guides.setGuides(groom.guides, state.uploads);
        state.guideBounds = {};
        for (std::size_t i = 0; i < groom.guides.blockCount(); ++i) {
            for (const glm::vec3& p : groom.guides.block(i).points) state.guideBounds.add(p);
        }
    }
    state.partings.setGroom(groom, state.uploads);
    if (meshChanged || partsChanged) state.shadows.meshChanged();
    state.groom = groom;
    state.surface = std::move(surface);
    state.uploadMilliseconds = milliseconds(start);
}

void Renderer::setSingularities(const std::vector<FieldSingularity>& places) {
    m_state->strokes.setSingularities(m_state->groom, places, m_state->uploads);
}

void Renderer::setStrands(std::shared_ptr<const Strands> strands) {
    State& state = *m_state;
    if (strands == state.strands) return;
    const auto start = std::chrono::steady_clock::now();
    state.strands = std::move(strands);
    state.hair.setStrands(state.strands, *state.groom.mesh, state.uploads);
    state.hairBounds = state.hair.strands() != nullptr ? vertexBounds(*state.hair.strands()) : Bounds{};
    state.shadows.hairChanged();
    state.uploadMilliseconds = milliseconds(start);
}

void Renderer::setLicImage(std::shared_ptr<const LicImage> image) {
    const auto start = std::chrono::steady_clock::now();
    m_state->lic.setImage(std::move(image), m_state->uploads);
    m_state->uploadMilliseconds = milliseconds(start);
}

void Renderer::setTriangleColours(std::shared_ptr<const std::vector<glm::vec4>> colours) {
    m_state->mesh.setTriangleColours(std::move(colours));
}

void Renderer::setHighlight(const std::vector<glm::vec3>& hair, std::span<const std::vector<glm::vec3>> guides) {
    m_state->looked.set({&hair, 1}, m_state->uploads);
    m_state->lookedBy.set(guides, m_state->uploads);
}

void Renderer::draw(const Camera& camera, const ViewSettings& settings, const OverlayState& overlay, unsigned target,
                    glm::ivec2 size) {
    State& state = *m_state;
    size = glm::max(size, glm::ivec2(1));
    const Strands* hair = settings.showHair ? state.hair.strands() : nullptr;
    const Effort effort = effortFor(settings, state.context, state.mesh.triangles(), hair, size, state.byProcessor);
    const glm::ivec2 drawn = glm::max(glm::ivec2(glm::vec2(size) * effort.resolution + 0.5f), glm::ivec2(1));

    state.vertexArray.bind();
    const Bounds bounds = state.sceneBounds();
    SceneBlock scene = sceneBlock(camera, settings, bounds, drawn);
    scene.shadow.w = static_cast<float>(effort.shadowTaps);
    const auto shadowStart = std::chrono::steady_clock::now();
    state.shadowTimer.begin();
    state.shadows.update(hair, settings, effort.hair, effort.lightSlack,
                         state.surface != nullptr ? state.surface->bounds : bounds,
                         settings.showMesh ? &state.mesh : nullptr, scene, state.sceneBuffer);
    state.shadowTimer.end();
    state.shadowMilliseconds = milliseconds(shadowStart);

    state.drawTimer.begin();
    state.sceneBuffer.upload(&scene, sizeof(scene));
    state.sceneBuffer.bindUniform(0);
    state.shadows.bind();
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye());
    // Guides fade around the middle of the model, as deep as a quarter of it.
    const Bounds model = state.surface != nullptr ? state.surface->bounds : bounds;
    const float middle = glm::dot(model.centre() - camera.eye(), forward);
    const float depth = glm::length(model.size()) * 0.125f;
    GuideLook look;
    look.fade = {middle - 0.5f * depth, middle + depth};

    if (hair != nullptr && effort.byProcessor) {
        state.hair.preparePoints(effort.hair, camera.eye(), forward, effort.quickHair);
    } else if (hair != nullptr) {
        state.hair.prepare(effort.hair, camera.eye(), forward);
    }
    state.picture.begin(drawn, effort.samples);
    state.picture.drawBackground(settings);
    if (settings.showMesh) state.mesh.draw(settings, effort.litByVertex, &state.lic, state.uploads);
    if (!effort.byProcessor) {
        if (hair != nullptr) state.hair.draw();
        state.vertexArray.bind();
        if (settings.showGuides) state.guides.draw(overlay, size, look);
    } else if (hair != nullptr || (settings.showGuides && !state.groom.guides.empty())) {
        state.raster.begin(drawn, state.picture.resolveDepth(), scene.pixel.z);
        if (hair != nullptr) state.raster.add(state.hair.points(), state.hair.segments());
        if (settings.showGuides) {
            makeGuideRibbons(state.groom.guides, effort.guidePieces, scene, overlay, look, drawn, size,
                             state.guideRibbons);
            state.raster.add(state.guideRibbons.points, state.guideRibbons.segments);
        }
        state.raster.draw();
        state.picture.drawLayer(state.raster);
    }
    if (settings.showGuides) {
        state.vertexArray.bind();
        state.partings.draw(size);
    }
    if (settings.showStrokes) {
        state.vertexArray.bind();
        state.strokes.setGroom(state.groom, settings.pickedStroke, state.uploads);
        state.strokes.draw(size);
    }
    state.vertexArray.bind();
    state.lookedBy.draw(size, {.root = glm::vec3(0.1f, 0.5f, 1.0f),
                               .tip = glm::vec3(0.35f, 0.85f, 1.0f),
                               .halfWidth = 1.4f,
                               .opacity = 0.9f,
                               .hiddenOpacity = 0.45f});
    state.looked.draw(size, {.root = glm::vec3(1.0f, 0.35f, 0.05f),
                             .tip = glm::vec3(1.0f, 0.8f, 0.15f),
                             .halfWidth = 2.0f,
                             .opacity = 1.0f,
                             .hiddenOpacity = 0.7f});
    state.picture.finish(settings, target, size);
    state.overlay.draw(overlay, size);
    state.drawTimer.end();
    gl::restoreState();
}

std::optional<std::size_t> Renderer::pickGuide(const Camera& camera, glm::vec2 pixel, float radius,
                                               glm::ivec2 size) const {
    const State& state = *m_state;
    const glm::vec2 pixels(glm::max(size, glm::ivec2(1)));
    const glm::mat4 clip = camera.clipFromView(pixels, state.sceneBounds()) * camera.viewFromGroom();
    return whorl::pickGuide(state.groom.guides, state.surface != nullptr ? &state.surface->query : nullptr, clip,
                            camera.eye(), pixel, radius, pixels);
}

std::optional<std::size_t> Renderer::pickHair(const Camera& camera, glm::vec2 pixel, float radius,
                                              glm::ivec2 size) const {
    const State& state = *m_state;
    if (state.strands == nullptr) return std::nullopt;
    const glm::vec2 pixels(glm::max(size, glm::ivec2(1)));
    const glm::mat4 clip = camera.clipFromView(pixels, state.sceneBounds()) * camera.viewFromGroom();
    return whorl::pickHair(*state.strands, state.surface != nullptr ? &state.surface->query : nullptr, clip,
                           camera.eye(), pixel, radius, pixels);
}

Renderer::Timing Renderer::timing() const {
    State& state = *m_state;
    return {state.uploadMilliseconds, std::max(state.shadowTimer.milliseconds(), state.shadowMilliseconds),
            state.drawTimer.milliseconds()};
}

const Uploads& Renderer::uploads() const {
    return m_state->uploads;
}

void Renderer::setHairByProcessor(bool on) {
    m_state->byProcessor = on;
}

bool Renderer::software() const {
    return m_state->context.software;
}

}  // namespace whorl
