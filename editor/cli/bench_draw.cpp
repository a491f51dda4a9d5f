// SPDX-License-Identifier: Apache-2.0
// Drawing against plain OpenGL lines; voxel shadows against plain loops; depth order against a comparison sort.
#include "core/base/random.h"
#include "editor/cli/bench.h"
#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/offscreen.h"
#include "render/passes/scene_block.h"
#include "render/passes/voxel_shadow.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numeric>

namespace whorl {

std::vector<BenchRow> benchDraw();

namespace {

constexpr glm::ivec2 frameSize(1280, 720);
constexpr int hairCount = 10000;
constexpr int verticesPerHair = 16;
constexpr int processorRuns = 7;
constexpr float ballRadius = 0.09f;

SurfaceMesh ball() {
    constexpr std::uint32_t rings = 64;
    constexpr std::uint32_t sectors = 96;
    SurfaceMesh mesh;
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const float polar =
                3.14159265f * (static_cast<float>(ring) + 0.001f) / (static_cast<float>(rings) + 0.002f);
            const float turn = 6.2831853f * static_cast<float>(sector) / static_cast<float>(sectors);
            const glm::vec3 normal(std::sin(polar) * std::cos(turn), std::cos(polar),
                                   -std::sin(polar) * std::sin(turn));
            mesh.normals.push_back(normal);
            mesh.positions.push_back(normal * ballRadius);
        }
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const std::uint32_t a = ring * sectors + sector;
            const std::uint32_t b = ring * sectors + (sector + 1) % sectors;
            mesh.triangles.push_back(glm::uvec3(a, a + sectors, b));
            mesh.triangles.push_back(glm::uvec3(b, a + sectors, b + sectors));
        }
    }
    mesh.cornerUvs.assign(mesh.triangles.size() * 3, glm::vec2(0.5f));
    mesh.parts.push_back({.name = "ball", .triangleCount = mesh.triangleCount()});
    return mesh;
}

// Hair of a head's size: out of the ball, then down.
std::shared_ptr<const Strands> hairOnBall(const SurfaceMesh& mesh) {
    auto strands = std::make_shared<Strands>();
    for (int i = 0; i < hairCount; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        const auto triangle = static_cast<std::uint32_t>(index * mesh.triangleCount() / hairCount);
        const SurfacePoint root{triangle, randomFloat(1, index, 0) * 0.5f, randomFloat(1, index, 1) * 0.5f};
        const glm::vec3 normal = normalAt(mesh, root);
        glm::vec3 place = positionAt(mesh, root);
        glm::vec3 way = normal;
        for (int j = 0; j < verticesPerHair; ++j) {
            const float t = static_cast<float>(j) / static_cast<float>(verticesPerHair - 1);
            strands->positions.push_back(place);
            strands->normals.push_back(normal);
            strands->widths.push_back(0.00009f - 0.00006f * t);
            strands->colours.push_back(glm::vec4(0.1f + 0.2f * t, 0.06f + 0.1f * t, 0.03f + 0.05f * t, 1.0f));
            way = glm::normalize(way + glm::vec3(0.0f, -0.16f, 0.0f) + normal * 0.04f);
            place += way * (0.1f / static_cast<float>(verticesPerHair - 1));
        }
        strands->firstVertex.push_back(static_cast<std::uint32_t>(strands->positions.size()));
        strands->ids.push_back(static_cast<std::uint32_t>(i));
        strands->roots.push_back(root);
        strands->rootUvs.push_back(glm::vec2(0.5f));
        strands->groups.push_back(0);
    }
    return strands;
}

// The usual way: every segment a line of one pixel with one colour, no shadows, no order.
class PlainLines {
public:
    static Result<PlainLines> create(const Strands& strands) {
        PlainLines lines;
        Result<gl::Program> program = gl::Program::draw("plain_lines.vert.glsl", "plain_lines.frag.glsl");
        if (!program) return program.error();
        lines.m_program = std::move(*program);
        lines.m_colour = gl::Texture::make2D("lines", gl::Format::Rgba8, frameSize, gl::Wrap::Clamp);
        lines.m_depth = gl::Texture::make2D("lines depth", gl::Format::Depth32F, frameSize, gl::Wrap::Clamp);
        lines.m_target = gl::Framebuffer("lines", &lines.m_colour, &lines.m_depth);
        lines.m_array.attribute(0, gl::VertexArray::Type::Float, 3, 0);
        lines.m_positions.upload(strands.positions);
        std::vector<std::uint32_t> indices;
        for (std::size_t hair = 0; hair < strands.count(); ++hair) {
            for (std::uint32_t i = strands.firstVertex[hair]; i + 1 < strands.firstVertex[hair + 1]; ++i) {
                indices.push_back(i);
                indices.push_back(i + 1);
            }
        }
        lines.m_count = indices.size();
        lines.m_indices.upload(indices);
        return lines;
    }

    void draw(const Camera& camera, const Bounds& bounds) {
        const SceneBlock scene = sceneBlock(camera, ViewSettings{}, bounds, frameSize);
        m_scene.upload(&scene, sizeof(scene));
        m_scene.bindUniform(0);
        m_target.bind();
        m_target.clearColour(glm::vec4(0.0f));
        m_target.clearDepth();
        gl::apply({});
        m_program.use();
        m_array.bind(m_positions, sizeof(glm::vec3), m_indices);
        gl::drawIndexedLines32(m_count);
    }

private:
    gl::Program m_program;
    gl::Texture m_colour;
    gl::Texture m_depth;
    gl::Framebuffer m_target;
    gl::VertexArray m_array;
    gl::Buffer m_positions{"lines positions"};
    gl::Buffer m_indices{"lines indices"};
    gl::Buffer m_scene{"lines scene"};
    std::size_t m_count = 0;
};

BenchRow failed(const Error& error) {
    BenchRow row;
    row.name = "draw";
    row.correct = false;
    row.note = error.message;
    return row;
}

// Means of blocks of 8 x 8 pixels: what the eye sees from further away, where single hairs no longer count.
std::vector<double> blockMeans(const Picture& picture) {
    constexpr int block = 8;
    constexpr int channels = 4;
    const int columns = picture.width / block;
    const int rows = picture.height / block;
    std::vector<double> means(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 3);
    for (int y = 0; y < rows * block; ++y) {
        for (int x = 0; x < columns * block; ++x) {
            const auto pixel = static_cast<std::size_t>(y * picture.width + x) * channels;
            const auto mean = static_cast<std::size_t>(y / block * columns + x / block) * 3;
            for (std::size_t c = 0; c < 3; ++c) means[mean + c] += picture.pixels[pixel + c] / double{block * block};
        }
    }
    return means;
}

// Mean difference of two pictures of one size, in steps of 8 bits.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum / static_cast<double>(std::max<std::size_t>(a.size(), 1));
}

void benchFrames(std::vector<BenchRow>& rows, const Groom& groom, const std::shared_ptr<const Surface>& surface,
                 const std::shared_ptr<const Strands>& strands) {
    Result<OffscreenRenderer> offscreen = OffscreenRenderer::create();
    if (!offscreen) {
        rows.push_back(failed(offscreen.error()));
        return;
    }
    Renderer& renderer = offscreen->renderer();
    renderer.setGroom(groom, surface);
    renderer.setStrands(strands);
    Result<PlainLines> lines = PlainLines::create(*strands);
    if (!lines) {
        rows.push_back(failed(lines.error()));
        return;
    }
    Bounds bounds = surface->bounds;
    bounds.add(vertexBounds(*strands));
    Camera camera = *Camera::named("three-quarter", bounds, glm::vec2(frameSize));
    gl::Texture colour = gl::Texture::make2D("bench frame", gl::Format::Rgba8, frameSize, gl::Wrap::Clamp);
    const gl::Framebuffer target("bench frame", &colour, nullptr);

    ViewSettings still;
    const auto picture = [&](const ViewSettings& settings) {
        return blockMeans(offscreen->draw(camera, settings, {}, frameSize.x, frameSize.y));
    };
    const std::vector<double> full = picture(still);
    ViewSettings bald = still;
    bald.showHair = false;
    const double ofHair = difference(full, picture(bald));
    Groom combed = groom;
    for (std::size_t hair = 0; hair < strands->count(); hair += 5) {
        const std::span all(strands->positions);
        combed.guides.append(strands->roots[hair], 0, all.subspan(strands->firstVertex[hair], verticesPerHair));
    }
    struct Kind {
        const char* name;
        bool interactive;
        int samples;
        bool guides;
    };
    for (const Kind kind :
         {Kind{"while the view moves", true, 4, false}, Kind{"while combing 2,000 guides", true, 4, true},
          Kind{"still, 1 sample", false, 1, false}, Kind{"still, 4 samples", false, 4, false}}) {
        renderer.setGroom(kind.guides ? combed : groom, surface);
        ViewSettings settings = still;
        settings.showGuides = kind.guides;
        OverlayState overlay;
        overlay.showBrush = kind.guides;
        overlay.brushPixel = glm::vec2(frameSize) * 0.5f;
        overlay.brushRadius = 60.0f;
        settings.interactive = kind.interactive;
        settings.samples = kind.samples;
        const double ofQuick = kind.guides ? 0.0 : difference(full, picture(settings));
        // The view turns a little before every frame, so that nothing is kept from the last one.
        const auto ours = [&] {
            camera.orbit(glm::vec2(1.0f, 0.0f));
            renderer.draw(camera, settings, overlay, target.target(), frameSize);
            gl::finish();
        };
        const auto baseline = [&] {
            lines->draw(camera, bounds);
            gl::finish();
        };
        const Medians medians = interleaved(ours, baseline);
        const std::clock_t before = std::clock();
        for (int i = 0; i < processorRuns; ++i) ours();
        const double processor = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC / processorRuns;
        BenchRow row;
        row.name = std::string("draw/10k hairs x 16, 1280x720, ") + kind.name;
        row.seconds = medians.ours;
        row.baselineSeconds = medians.baseline;
        row.baseline = "plain GL lines without mesh, shadows and antialiasing";
        row.items = 1;
        row.unit = "frames";
        // Hair changes the picture, and the quick one is much nearer to the full one than the bald ball is. Not the
        // mean light: hair may be as bright as what it covers.
        row.correct = ofHair > 2.0 && ofQuick < 0.5 * ofHair;
        row.note = (renderer.software() ? "no graphics card, " : "graphics card, ") +
                   std::to_string(std::lround(processor * 1000.0)) + " ms of processor time";
        rows.push_back(row);
    }
}

void benchVoxels(std::vector<BenchRow>& rows, const Strands& strands) {
    const glm::vec3 light = glm::normalize(glm::vec3(0.45f, 0.75f, 0.65f));
    VoxelShadow ours;
    VoxelShadow reference;
    const HairDetail all{.pointsPerHair = verticesPerHair};
    const Medians medians =
        interleaved([&] { ours.build(strands, all, light); }, [&] { reference.buildReference(strands, all, light); });
    BenchRow row;
    row.name = "voxel shadow/10k hairs x 16, 128^3";
    row.seconds = medians.ours;
    row.baselineSeconds = medians.baseline;
    row.baseline = "one thread, plain loops";
    row.items = hairCount;
    row.unit = "hairs";
    row.correct = ours.texels() == reference.texels();
    rows.push_back(row);
}

void benchOrder(std::vector<BenchRow>& rows, const Strands& strands) {
    const HairDetail all{.pointsPerHair = verticesPerHair};
    const glm::vec3 eye(0.0f, 0.0f, 1.0f);
    const glm::vec3 forward(0.0f, 0.0f, -1.0f);
    HairOrder order;
    std::vector<std::uint32_t> sorted;
    std::vector<float> depths;
    constexpr std::uint32_t pieces = verticesPerHair - 1;
    const auto depthOf = [&](std::uint32_t segment) {
        const std::size_t vertex = std::size_t{segment / pieces} * verticesPerHair + segment % pieces;
        return glm::dot((strands.positions[vertex] + strands.positions[vertex + 1]) * 0.5f - eye, forward);
    };
    const Medians medians = interleaved(
        [&] {
            order.clear();
            order.update(strands, all, eye, forward);
        },
        [&] {
            sorted.resize(std::size_t{hairCount} * pieces);
            std::iota(sorted.begin(), sorted.end(), 0u);
            depths.resize(sorted.size());
            for (std::uint32_t i = 0; i < sorted.size(); ++i) depths[i] = depthOf(i);
            std::stable_sort(sorted.begin(), sorted.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return depths[a] > depths[b]; });
        });
    BenchRow row;
    row.name = "hair order/10k hairs x 15 segments";
    row.seconds = medians.ours;
    row.baselineSeconds = medians.baseline;
    row.baseline = "std::stable_sort";
    row.items = static_cast<double>(sorted.size());
    row.unit = "segments";
    // Ours compares depths in 4,096 steps: never further off than two of them.
    float low = depths[sorted.back()];
    float high = depths[sorted.front()];
    const float slack = 2.0f * (high - low) / 4096.0f;
    bool good = order.order().size() == sorted.size();
    float nearest = high;
    for (const std::uint32_t segment : order.order()) {
        good = good && depths[segment] <= nearest + slack;
        nearest = std::min(nearest, depths[segment]);
    }
    row.correct = good;
    rows.push_back(row);
}

}  // namespace

std::vector<BenchRow> benchDraw() {
    const Groom groom = makeGroom(ball());
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    const std::shared_ptr<const Strands> strands = hairOnBall(*groom.mesh);
    std::vector<BenchRow> rows;
    benchFrames(rows, groom, surface, strands);
    benchVoxels(rows, *strands);
    benchOrder(rows, *strands);
    return rows;
}

}  // namespace whorl
