// SPDX-License-Identifier: Apache-2.0
// Hair texture over whole meshes, against the reference place by place.
#include "core/base/correlation.h"
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/field/growing_area.h"
#include "core/lic/painter.h"
#include "core/lic/reference.h"
#include "core/sampling/density.h"
#include "editor/cli/bench_grooms.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

namespace whorl {

std::vector<BenchRow> benchLic();

namespace {

constexpr float lengthTexels = 20.0f;  // each way: 40 in all
constexpr float grainTexels = 3.0f;

// Each triangle becomes four.
SurfaceMesh subdivided(const SurfaceMesh& mesh) {
    SurfaceMesh finer;
    finer.positions = mesh.positions;
    finer.normals = mesh.normals;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
        const auto next = static_cast<std::uint32_t>(finer.positions.size());
        const auto [known, fresh] = middles.try_emplace(std::minmax(a, b), next);
        if (fresh) {
            finer.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5f);
            finer.normals.push_back(glm::normalize(mesh.normals[a] + mesh.normals[b]));
        }
        return known->second;
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec3 v = mesh.triangles[t];
        const glm::uvec3 m(between(v.x, v.y), between(v.y, v.z), between(v.z, v.x));
        const glm::vec2* uv = &mesh.cornerUvs[t * 3];
        const glm::vec2 n[3] = {(uv[0] + uv[1]) * 0.5f, (uv[1] + uv[2]) * 0.5f, (uv[2] + uv[0]) * 0.5f};
        finer.triangles.insert(finer.triangles.end(), {{v.x, m.x, m.z}, {m.x, v.y, m.y}, {m.z, m.y, v.z}, m});
        finer.cornerUvs.insert(finer.cornerUvs.end(),
                               {uv[0], n[0], n[2], n[0], uv[1], n[1], n[2], n[1], uv[2], n[0], n[1], n[2]});
    }
    finer.parts.push_back({.name = "ball", .firstTriangle = 0, .triangleCount = finer.triangleCount()});
    return finer;
}

struct Scene {
    std::string name;
    Groom groom;
    std::shared_ptr<const Surface> surface;
    DirectionField field, other;  ///< downwards; aslant
    glm::vec2 dab{0.5f};          ///< where hair grows
};

Scene sceneOf(std::string name, Groom groom) {
    Scene scene{std::move(name), std::move(groom), nullptr, {}, {}, {}};
    scene.surface = std::make_shared<const Surface>(scene.groom.mesh);
    Progress progress;
    const auto solver =
        FieldSolver::make(scene.surface, growingTriangles(scene.groom), *scene.groom.partings, progress);
    FieldParams params = *scene.groom.field;
    scene.field = solver->defaults(params);
    params.gravity.value = {0.2f, -1.0f, 0.1f};
    scene.other = solver->defaults(params);
    const SurfaceMesh& mesh = *scene.groom.mesh;
    const DensityLookup density(scene.groom);
    for (std::uint32_t i = 0; i < mesh.triangleCount(); ++i) {
        const auto t = static_cast<std::uint32_t>((i + mesh.triangleCount() / 3) % mesh.triangleCount());
        scene.dab = uvAt(mesh, {t, 1.0f / 3.0f, 1.0f / 3.0f});
        if (scene.field.grows()[t] && density.at(t, scene.dab) > 0.5f * density.scale()) break;
    }
    for (const char* map : {"dab density", "dab length", "dab grain"})
        scene.groom.maps.set(map, Map(1024, 1024, 1, TexelFormat::U8, 1.0f));
    return scene;
}

bool same(const LicTexture& a, const LicTexture& b) {
    return *a.light == *b.light && *a.cover == *b.cover && *a.colours == *b.colours && *a.tangents == *b.tangents;
}

class LicBench {
public:
    LicBench(const Scene& scene, int size) : m_scene(scene), m_groom(scene.groom), m_size(size) {
        Progress progress;
        const auto start = std::chrono::steady_clock::now();
        m_painter.emplace(*LicPainter::make(scene.surface, size, progress));
        m_making = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        LicParams& lic = m_groom.lic.edit();
        lic.length.value = lengthTexels * m_painter->atlas().usualTexel();
        lic.grain.value = grainTexels * m_painter->atlas().usualTexel();
        m_texture = painted(m_groom, scene.field, nullptr);
        choosePlaces();
    }

    LicTexture painted(const Groom& groom, const DirectionField& field, const LicTexture* before) const {
        Progress progress;
        return *m_painter->paint(groom, field, before, progress);
    }

    // A row for `change`, which alters the groom or gives another field, and back again in the next run.
    template <class Change>
    BenchRow row(const std::string& what, unsigned threads, double texels, Change&& change) {
        const ThreadLimit limit(threads);
        bool flip = false;
        const DirectionField* field = &m_scene.field;
        const auto ours = [&] {
            flip = !flip;
            field = change(m_groom, flip);
            m_texture = painted(m_groom, *field, &m_texture);
        };
        const auto reference = [&] {
            for (const SurfacePoint& place : m_timed) m_sum += m_reference->at(place, options()).value_or(0.0f);
        };
        const Medians medians = interleaved(ours, reference, 9);
        BenchRow row;
        row.name = "lic/" + m_scene.name + " " + std::to_string(m_size) + ", " + what + ", " +
                   (threads == 1 ? "1 thread" : std::to_string(threads) + " threads");
        row.seconds = medians.ours;
        row.baselineSeconds = medians.baseline * texels / static_cast<double>(m_timed.size());
        row.baseline = "the reference at " + std::to_string(m_timed.size()) + " places, times texels; one thread";
        row.items = texels;
        row.unit = "texels";
        row.correct = same(m_texture, painted(m_groom, *field, nullptr)) && m_agreement >= 0.9;
        char note[160];
        std::snprintf(note, sizeof note, "%s; correlation with the reference %.3f; painter made in %.0f ms%s",
                      simdLevelName(simdLevel()), m_agreement, m_making * 1e3,
                      m_painter->atlas().ownUvs() ? " with its own atlas" : "");
        row.note = note;
        return row;
    }

    /// Texels with hair.
    double texels() const {
        return static_cast<double>(std::ranges::count_if(*m_texture.cover, [](std::uint8_t c) { return c > 0; }));
    }

private:
    LicOptions options() const {
        const LicParams& lic = *m_scene.groom.lic;
        LicOptions options;
        options.length = lengthTexels * m_painter->atlas().usualTexel();
        options.grain = grainTexels * m_painter->atlas().usualTexel();
        options.white = lic.white;
        options.seed = lic.seed;
        return options;
    }

    void choosePlaces() {
        m_reference.emplace(m_scene.surface, m_scene.field);
        const auto slots = m_painter->atlas().slots();
        const auto side = static_cast<std::uint32_t>(m_painter->atlas().side());
        const auto size = static_cast<std::uint32_t>(m_size);
        std::vector<double> ours, theirs;
        for (std::uint32_t i = 0; ours.size() < 600 && i < 60000; ++i) {
            const TexelAtlas::Slot& slot =
                slots[static_cast<std::size_t>(randomFloat(7, i, 0) * static_cast<float>(slots.size()))];
            const std::uint32_t x = slot.texel % side - TexelAtlas::pad, y = slot.texel / side - TexelAtlas::pad;
            if (x >= size || y >= size || slot.u < 0.0f || slot.v < 0.0f || slot.u + slot.v > 1.0f) continue;
            const std::size_t texel = std::size_t{y} * size + x;
            if ((*m_texture.cover)[texel] == 0) continue;
            // Evenly over the skin, however the UVs stretch.
            const TexelAtlas::Gradients g = m_painter->atlas().gradients(slot.triangle);
            const float usual = m_painter->atlas().usualTexel();
            if (randomFloat(8, i, 0) * glm::length(glm::cross(g.x, g.y)) * 2.0f * usual * usual > 1.0f) continue;
            const auto expected = m_reference->at(slot.point(), options());
            if (!expected) continue;
            ours.push_back((*m_texture.light)[texel] / 255.0);
            theirs.push_back(static_cast<double>(*expected));
            if (m_timed.size() < 50) m_timed.push_back(slot.point());
        }
        m_agreement = correlation(ours, theirs);
    }

    const Scene& m_scene;
    Groom m_groom;
    int m_size;
    double m_making = 0.0;
    double m_agreement = 0.0;
    float m_sum = 0.0f;
    std::optional<LicPainter> m_painter;
    std::optional<LicReference> m_reference;
    LicTexture m_texture;
    std::vector<SurfacePoint> m_timed;
};

// A square of the map becomes dark, or light again.
void dab(Groom& groom, const char* name, const Scene& scene, bool dark, float darkness = 0.6f) {
    Map& map = *groom.maps.edit(name);
    const glm::vec2 middle = map.texelFromUv(scene.dab);
    for (int y = -20; y <= 20; ++y) {
        for (int x = -20; x <= 20; ++x) {
            const int column = std::clamp(static_cast<int>(middle.x) + x, 0, map.width() - 1);
            const int line = std::clamp(static_cast<int>(middle.y) + y, 0, map.height() - 1);
            map.setTexel(column, line, 0, dark ? darkness : 1.0f);
        }
    }
}

void addDabs(LicBench& bench, const Scene& scene, std::vector<BenchRow>& rows) {
    constexpr double dabTexels = 41.0 * 41.0;
    rows.push_back(bench.row("dab of length", 2, dabTexels, [&](Groom& groom, bool flip) {
        groom.lic.edit().length.map = "dab length";
        dab(groom, "dab length", scene, flip);
        return &scene.field;
    }));
    rows.push_back(bench.row("dab of opacity", 2, dabTexels, [&](Groom& groom, bool flip) {
        groom.lic.edit().length.map.clear();
        groom.lic.edit().opacity.map = "dab density";
        dab(groom, "dab density", scene, flip);
        return &scene.field;
    }));
    const float usual = scene.groom.lic->border;
    struct Dab {
        const char* what;
        float darkness, border;
    };
    for (const Dab& density : {Dab{"dab of density", 0.6f, usual}, Dab{"dab that takes all hair away", 0.0f, usual},
                               Dab{"dab that takes all hair away, border of 40 mm", 0.0f, 0.04f}}) {
        rows.push_back(bench.row(density.what, 2, dabTexels, [&](Groom& groom, bool flip) {
            groom.lic.edit().opacity.map.clear();
            groom.lic.edit().border = density.border;
            if (groom.groups->front().params.general.density.map != "dab density") {
                for (Group& group : groom.groups.edit()) group.params.general.density.map = "dab density";
            }
            dab(groom, "dab density", scene, flip, density.darkness);
            return &scene.field;
        }));
    }
    rows.push_back(bench.row("dab of grain", 2, dabTexels, [&](Groom& groom, bool flip) {
        groom.groups = scene.groom.groups;
        groom.lic.edit().border = usual;
        groom.lic.edit().grain.map = "dab grain";
        dab(groom, "dab grain", scene, flip);
        return &scene.field;
    }));
}

void addScene(const Scene& scene, std::vector<BenchRow>& rows) {
    for (const int size : {512, 1024, 2048}) {
        LicBench bench(scene, size);
        for (const unsigned threads : {2u, 1u}) {
            rows.push_back(bench.row("all along another length", threads, bench.texels(), [&](Groom& groom, bool flip) {
                groom.lic.edit().length.value *= flip ? 1.0001f : 1.0f / 1.0001f;
                return &scene.field;
            }));
        }
        rows.push_back(bench.row("another field", 2, bench.texels(),
                                 [&](Groom&, bool flip) { return flip ? &scene.other : &scene.field; }));
        rows.push_back(bench.row("other noise", 2, bench.texels(), [&](Groom& groom, bool flip) {
            groom.lic.edit().seed = flip ? 2 : 1;
            return &scene.field;
        }));
        if (size == 1024) addDabs(bench, scene, rows);
    }
}

}  // namespace

std::vector<BenchRow> benchLic() {
    std::vector<BenchRow> rows;
    for (const char* sample : {"bust", "creature"}) {
        BenchDocument document = benchDocument(sample);
        addScene(sceneOf(document.name, std::move(document.groom)), rows);
    }
    SurfaceMesh fine = subdivided(subdivided(*benchGroom().mesh));
    const std::string name = "ball of " + std::to_string(fine.triangles.size() / 1000) + "k triangles";
    addScene(sceneOf(name, makeGroom(std::move(fine))), rows);
    return rows;
}

}  // namespace whorl
