// SPDX-License-Identifier: Apache-2.0
#include "editor/app/viewport/viewport.h"

#include <QLocale>
#include <QOpenGLContext>
#include <QSurfaceFormat>
#include <chrono>
#include <utility>

namespace whorl {
namespace {

constexpr int stillMilliseconds = 180;
constexpr std::uint32_t interactiveHairs = 10000;
constexpr int frameMilliseconds = 16;
constexpr float pickRadius = 4.0f;

/// True when hair generated from `a` can differ from that of `b`.
bool hairMayDiffer(const Groom& a, const Groom& b) {
    return !a.mesh.sameAs(b.mesh) || !a.partSettings.sameAs(b.partSettings) || !a.guides.sameAs(b.guides) ||
           !a.maps.sameAs(b.maps) || !a.groups.sameAs(b.groups) || !a.counts.sameAs(b.counts) ||
           !a.partings.sameAs(b.partings);
}

}  // namespace

Viewport::Viewport(Document& document, EditorState& state, QWidget* parent)
    : QOpenGLWidget(parent), m_document(document), m_state(state), m_stroke(document, state), m_adjust(state) {
    setObjectName("viewport");
    setAccessibleName(tr("View"));
    setAccessibleDescription(tr("The model with its hair. Brushes work here."));
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setTabletTracking(true);
    setMinimumSize(200, 150);
    QSurfaceFormat format;
    format.setRenderableType(QSurfaceFormat::OpenGL);
    format.setVersion(4, 5);
    format.setProfile(QSurfaceFormat::CoreProfile);
    setFormat(format);
    m_settle.setSingleShot(true);
    m_settle.setInterval(stillMilliseconds);
    connect(&m_settle, &QTimer::timeout, this, [this] {
        requestHair();
        update();
    });
    m_frame.setSingleShot(true);
    m_frame.setInterval(frameMilliseconds);
    connect(&m_frame, &QTimer::timeout, this, qOverload<>(&QWidget::update));
    connect(&m_document, &Document::changed, this, &Viewport::documentChanged);
    connect(&m_state, &EditorState::changed, this, [this] {
        setCursor(m_state.brush() ? Qt::CrossCursor : Qt::ArrowCursor);
        Q_EMIT hintChanged(hint());
        requestHeat();
        requestHair();
        requestLic();
        update();
    });
    connect(&m_lic, &LicJob::delivered, this, qOverload<>(&QWidget::update));
    connect(&m_heat, &HeatJob::delivered, this, qOverload<>(&QWidget::update));
    connect(&m_hair, &HairJob::delivered, this, [this](std::shared_ptr<const Strands> strands) {
        m_strands = std::move(strands);
        m_frame.stop();
        requestHeat();
        update();
    });
    connect(&m_hair, &HairJob::failed, this, &Viewport::said);
}

Viewport::~Viewport() {
    disconnect(&m_document, nullptr, this, nullptr);
    releaseRenderer();
}

void Viewport::releaseRenderer() {
    if (!m_renderer) return;
    makeCurrent();
    m_renderer.reset();
    doneCurrent();
}

void Viewport::initializeGL() {
    // A lost or moved context comes here again; everything is uploaded anew from the document.
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &Viewport::releaseRenderer, Qt::UniqueConnection);
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create();
    if (renderer) {
        m_renderer = std::move(*renderer);
        m_lookedChanged = true;
    } else {
        Q_EMIT failed(QString::fromStdString(renderer.error().message));
    }
}

void Viewport::paintGL() {
    if (!m_renderer) return;
    const auto start = std::chrono::steady_clock::now();
    const std::shared_ptr<const Surface> surface = m_document.surface();
    m_renderer->setGroom(m_document.groom(), surface);
    m_renderer->setStrands(m_strands);
    m_renderer->setLicImage(m_lic.image());
    m_renderer->setSingularities(m_lic.singularities());
    m_renderer->setTriangleColours(m_heat.colours());
    if (std::exchange(m_lookedChanged, false)) m_renderer->setHighlight(m_looked, m_lookedBy);
    ViewSettings settings = viewSettings();
    // Until the hair is there, a quick picture: the final one would be drawn twice.
    settings.interactive = interacting() || m_hair.busy() || m_lic.busy();
    const double ratio = devicePixelRatio();
    const glm::ivec2 size(static_cast<int>(width() * ratio), static_cast<int>(height() * ratio));
    m_renderer->draw(m_camera, settings, overlay(), defaultFramebufferObject(), size);
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
    m_drawMilliseconds = spent.count();
}

ViewSettings Viewport::viewSettings() const {
    ViewSettings settings = m_state.viewOptions().settings();
    const BrushInfo* brush = m_state.brush();
    // Looking around and painting, the artist wants to see the hair and the map.
    settings.showGuides = settings.showGuides && brush && !brush->paintsMap;
    settings.showStrokes = brush && brush->drawsStrokes;
    settings.pickedStroke = m_state.pickedStroke();
    if (brush && brush->paintsMap) {
        const Groom& groom = m_document.groom();
        settings.overlayGroups = brush->paintsGroups;
        const std::string& map = brush->paintsGroups ? groom.counts->groupMap.name : m_state.brushOptions().map.name;
        if (groom.maps.find(map)) settings.overlayMap = map;
    }
    return settings;
}

OverlayState Viewport::overlay() const {
    OverlayState overlay;
    const float ratio = static_cast<float>(devicePixelRatio());
    overlay.showBrush = m_state.brush() && (m_inside || m_adjust.active()) && !m_navigation.active();
    overlay.brushPixel = (m_adjust.active() ? m_adjust.centre() : m_pixel) * ratio;
    overlay.brushRadius = m_state.brushOptions().radius * ratio;
    overlay.scale = ratio;
    overlay.brushStrength = m_state.brushOptions().strength;
    overlay.text = statusText().toStdString();
    return overlay;
}

QString Viewport::statusText() const {
    if (!m_document.hasGroom()) return {};
    const auto count = [](std::size_t n) { return QLocale().toString(static_cast<qulonglong>(n)); };
    QString text = tr("%1 hairs shown, %2 guides   hair %3 ms, picture %4 ms")
                       .arg(count(m_strands ? m_strands->count() : 0), count(m_document.groom().guides.count()))
                       .arg(m_hair.milliseconds(), 0, 'f', 0)
                       .arg(m_drawMilliseconds, 0, 'f', 0);
    // The first texture of a mesh of a million triangles takes ten seconds.
    const auto texture = licTexture();
    const bool here = texture && texture->mesh && texture->mesh.get() == &*m_document.groom().mesh;
    if (m_lic.busy() && viewSettings().showLic && !here) text += tr("   painting hair texture...");
    return text;
}

void Viewport::documentChanged() {
    // Undo, or a jump in the history, ends a stroke that is on its way.
    if (m_stroke.active() && !m_document.previewing()) m_stroke.drop();
    const bool otherMesh = !m_document.groom().mesh.sameAs(m_seen.mesh);
    requestHair();
    requestLic();
    if (otherMesh) {
        lookFrom("three-quarter");
        frameAll();
    }
    if (m_document.previewing()) m_settle.start();
    // Hair that is about to arrive is worth a frame's wait: guides and hair then move in one picture, not in two.
    const bool soon = m_document.previewing() && m_hair.busy() && m_hair.milliseconds() < frameMilliseconds;
    if (!soon) {
        update();
    } else if (!m_frame.isActive()) {
        m_frame.start();
    }
}

void Viewport::requestHair() {
    const Groom& groom = m_document.groom();
    const std::uint32_t wanted = static_cast<std::uint32_t>(std::max(groom.counts->shownHairs, 0));
    // Fewer hairs follow a stroke; turning the view keeps them all, so that none comes and goes.
    const bool live = (m_document.previewing() || m_settle.isActive()) && !m_navigation.active() &&
                      wanted > interactiveHairs && m_state.brush();
    GenerateOptions options;
    options.hairCount = live ? interactiveHairs : wanted;
    options.time = m_state.viewOptions().time;
    options.lod = m_state.viewOptions().detail;
    if (!hairMayDiffer(groom, m_seen) && options == m_seenOptions) return;
    const bool reseeded = !groom.mesh.sameAs(m_seen.mesh);
    m_seen = groom;
    m_seenOptions = options;
    if (reseeded) m_strands.reset();
    m_hair.request(groom, m_document.surface(), options, m_document.previewing());
}

void Viewport::setHighlight(std::vector<glm::vec3> hair, std::vector<std::vector<glm::vec3>> guides) {
    m_looked = std::move(hair);
    m_lookedBy = std::move(guides);
    m_lookedChanged = true;
    update();
}

void Viewport::pick(glm::vec2 pixel) {
    if (!m_renderer || !m_strands) return;
    const auto hair = m_renderer->pickHair(m_camera, pixel, pickRadius, glm::ivec2(sizePixels()));
    Q_EMIT hairPicked(hair ? std::optional(m_strands->ids[*hair]) : std::nullopt);
}

void Viewport::requestLic() {
    const int size = m_state.viewOptions().licSize();
    const bool strokes = m_state.brush() && m_state.brush()->drawsStrokes;
    if (size == 0 && !strokes) return;
    const Groom& groom = m_document.groom();
    if (size == m_licSize && !LiveTexture::differs(m_licSeen, groom)) return;
    m_licSeen = groom;
    m_licSize = size;
    m_lic.request(groom, m_document.surface(), size, m_document.previewing());
}

void Viewport::requestHeat() {
    if (!m_state.viewOptions().heat || !m_strands || m_strands == m_heatStrands) return;
    m_heatStrands = m_strands;
    m_heat.request(m_document.groom(), m_strands);
}

bool Viewport::interacting() const {
    return m_navigation.active() || m_document.previewing() || m_settle.isActive();
}

void Viewport::interacted() {
    m_settle.start();
    update();
}

bool Viewport::settled() const {
    return !interacting() && !m_hair.busy() && !m_heat.busy() && !m_lic.busy();
}

Bounds Viewport::sceneBounds() const {
    Bounds bounds;
    if (const auto surface = m_document.surface()) bounds = surface->bounds;
    const GuideSet& guides = m_document.groom().guides;
    for (std::size_t i = 0; i < guides.blockCount(); ++i) {
        for (const glm::vec3& p : guides.block(i).points) bounds.add(p);
    }
    return bounds;
}

glm::vec2 Viewport::sizePixels() const {
    return {static_cast<float>(width()), static_cast<float>(height())};
}

void Viewport::setCamera(const Camera& camera) {
    m_camera = camera;
    interacted();
}

void Viewport::frameAll() {
    const Bounds bounds = sceneBounds();
    if (bounds.empty()) return;
    m_camera.frame(bounds, sizePixels());
    interacted();
}

void Viewport::frameHair() {
    Bounds bounds;
    const GuideSet& guides = m_document.groom().guides;
    for (std::size_t i = 0; i < guides.blockCount(); ++i) {
        for (const glm::vec3& p : guides.block(i).points) bounds.add(p);
    }
    if (bounds.empty()) return frameAll();
    m_camera.frame(bounds, sizePixels());
    interacted();
}

void Viewport::lookFrom(const char* name) {
    const Bounds bounds = sceneBounds();
    if (bounds.empty()) return;
    const Result<Camera> camera = Camera::named(name, bounds, sizePixels());
    if (!camera) return;
    // Only the direction changes: the artist stays as near to the place as before.
    m_camera.azimuth = camera->azimuth;
    m_camera.elevation = camera->elevation;
    interacted();
}

}  // namespace whorl
