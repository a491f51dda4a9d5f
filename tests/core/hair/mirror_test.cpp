// SPDX-License-Identifier: Apache-2.0
#include "core/hair/evaluate.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <cmath>
#include <numeric>

using namespace whorl;

namespace {

glm::vec3 mirrored(const glm::vec3& p) {
    return {-p.x, p.y, p.z};
}

// The mesh seen in a mirror at x = 0: corners b and c of every triangle change places, so that outside stays outside.
SurfaceMesh mirrored(SurfaceMesh mesh) {
    for (glm::vec3& p : mesh.positions) p = mirrored(p);
    for (glm::vec3& n : mesh.normals) n = mirrored(n);
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    for (std::size_t i = 0; i + 2 < mesh.cornerUvs.size(); i += 3)
        std::swap(mesh.cornerUvs[i + 1], mesh.cornerUvs[i + 2]);
    return mesh;
}

SurfacePoint mirrored(const SurfacePoint& root) {
    return {root.triangle, root.v, root.u};
}

Groom bent() {
    Groom groom = testing::groomOn(testing::sphere(20, 40), 120, 12);
    GeneralParams& general = groom.groups.edit()[0].params.general;
    general.segments = 12;
    general.keepOutside = false;
    general.cut.value = 0.83f;
    general.randomScale.value = 0.5f;
    general.displacement.value = 0.001f;
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        const std::span<glm::vec3> points = groom.guides.editPoints(g);
        for (std::size_t v = 1; v < points.size(); ++v) {
            const float t = static_cast<float>(v) / 12.0f;
            points[v] += t * t * glm::vec3(0.03f * std::sin(static_cast<float>(g)), -0.05f, 0.02f);
        }
    }
    return groom;
}

Groom mirrored(const Groom& groom) {
    Groom other = makeGroom(mirrored(*groom.mesh));
    other.groups = groom.groups;
    other.counts = groom.counts;
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        std::vector<glm::vec3> points;
        for (const glm::vec3& p : groom.guides.points(g)) points.push_back(mirrored(p));
        other.guides.append(mirrored(groom.guides.root(g)), groom.guides.group(g), points);
    }
    return other;
}

Strands grownFrom(const Groom& groom, const std::vector<HairRoot>& roots) {
    Progress progress;
    const TraitLookup lookup(groom);
    const GuideShapes shapes(groom);
    const Bindings bindings = bindHairs(groom, GuideIndex(groom), roots, progress);
    const TraitList traits = makeTraits(lookup, roots, progress);
    const ModifierChain chain(groom);
    const ClumpSet clumps;
    const CentresOfHairs centres;
    std::vector<std::uint32_t> order(roots.size());
    std::iota(order.begin(), order.end(), 0u);
    const HairSources sources{groom,   roots, bindings, traits,  shapes, lookup.kinkOffset(),
                              nullptr, chain, clumps,   centres, order};
    Strands strands;
    const GrownHairs grown = layOut(sources, strands);
    std::vector<std::uint32_t> all(grown.count());
    std::iota(all.begin(), all.end(), 0u);
    evaluateHairs(sources, grown, all, strands, progress);
    return strands;
}

std::vector<HairRoot> someRoots(const Groom& groom) {
    Progress progress;
    const DensityLookup density(groom);
    const Result<RootSampler> sampler = RootSampler::build(groom, density, progress);
    return makeRoots({*groom.mesh, *sampler, density, {1500.0, 1}}, {}, progress);
}

}  // namespace

class MirrorTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aMirroredGroomGrowsMirroredHair() {
        const Groom groom = bent(), other = mirrored(groom);
        const std::vector<HairRoot> roots = someRoots(groom);
        std::vector<HairRoot> otherRoots = roots;
        for (HairRoot& root : otherRoots) {
            root.point = mirrored(root.point);
            root.position = mirrored(root.position);
            root.normal = mirrored(root.normal);
        }
        const Strands a = grownFrom(groom, roots), b = grownFrom(other, otherRoots);
        QCOMPARE(a.count(), std::size_t{1500});
        QCOMPARE(a.firstVertex, b.firstVertex);
        for (std::size_t v = 0; v < a.vertexCount(); ++v) {
            QVERIFY(glm::distance(mirrored(a.positions[v]), b.positions[v]) < 1e-6f);
            QVERIFY(glm::distance(mirrored(a.normals[v]), b.normals[v]) < 1e-3f);
        }
    }

    // A hair on the root of a guide has the guide's shape.
    void aHairAtAGuideIsTheGuide() {
        Groom groom = bent();
        GeneralParams& general = groom.groups.edit()[0].params.general;
        general.cut.value = 1.0f;
        general.randomScale.value = general.displacement.value = 0.0f;
        std::vector<HairRoot> roots(groom.guides.count());
        for (std::uint32_t g = 0; g < roots.size(); ++g) {
            roots[g].id = g;
            roots[g].point = groom.guides.root(g);
            roots[g].position = positionAt(*groom.mesh, roots[g].point);
            roots[g].normal = normalAt(*groom.mesh, roots[g].point);
        }
        const Strands strands = grownFrom(groom, roots);
        for (std::size_t g = 0; g < roots.size(); ++g) {
            const std::span<const glm::vec3> points = groom.guides.points(g);
            for (std::size_t v = 0; v < points.size(); ++v)
                QVERIFY(glm::distance(points[v], strands.positions[strands.firstVertex[g] + v]) < 1e-6f);
        }
    }
};

QTEST_APPLESS_MAIN(MirrorTest)
#include "mirror_test.moc"
