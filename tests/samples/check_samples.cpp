// SPDX-License-Identifier: Apache-2.0
// Self-check of the sample sculptures: geometry, texture layout, symmetry and repeatability.
#include "resources/samples/source/sculpt.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

using glm::vec2;
using glm::vec3;
using namespace whorl::samples;

namespace {

int failures = 0;

void expect(bool ok, const std::string& what) {
    std::printf("  %s %s\n", ok ? "ok  " : "FAIL", what.c_str());
    failures += !ok;
}

class Hash {
public:
    template <typename T>
    void add(const std::vector<T>& values) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
        for (size_t i = 0; i < values.size() * sizeof(T); ++i) {
            m_value = (m_value ^ bytes[i]) * 1099511628211ull;
        }
    }
    uint64_t value() const { return m_value; }

private:
    uint64_t m_value = 14695981039346656037ull;
};

uint64_t hashOf(const Sculpture& s) {
    Hash hash;
    hash.add(s.positions);
    hash.add(s.normals);
    hash.add(s.uvs);
    for (const SculptPart& part : s.parts) {
        hash.add(part.triangles);
    }
    return hash.value();
}

using Key = std::array<float, 3>;
Key keyOf(const vec3& p) {
    return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
}  // + 0 turns -0 into 0

std::vector<std::array<uint32_t, 3>> allTriangles(const Sculpture& s) {
    std::vector<std::array<uint32_t, 3>> all;
    for (const SculptPart& part : s.parts) {
        all.insert(all.end(), part.triangles.begin(), part.triangles.end());
    }
    return all;
}

void checkGeometry(const Sculpture& s) {
    bool finite = true, unit = true, inside = true;
    for (size_t i = 0; i < s.positions.size(); ++i) {
        const vec3 p = s.positions[i], n = s.normals[i];
        const vec2 uv = s.uvs[i];
        finite = finite && std::isfinite(p.x + p.y + p.z + n.x + n.y + n.z + uv.x + uv.y);
        unit = unit && std::abs(glm::length(n) - 1.0f) < 1e-3f;
        inside = inside && uv.x > 0.0f && uv.y > 0.0f && uv.x < 1.0f && uv.y < 1.0f;
    }
    expect(finite, "all values finite");
    expect(unit, "normals have unit length");
    expect(inside, "texture coordinates within 0..1");
    double volume = 0.0;
    float smallest = 1.0f, leastFacing = 1.0f, thinnest = 180.0f;
    for (const auto& t : allTriangles(s)) {
        const vec3 a = s.positions[t[0]], b = s.positions[t[1]], c = s.positions[t[2]];
        const vec3 n = glm::cross(b - a, c - a);
        volume += double(glm::dot(a, glm::cross(b, c))) / 6.0;
        smallest = std::min(smallest, 0.5f * glm::length(n));
        leastFacing =
            std::min(leastFacing,
                     glm::dot(glm::normalize(n), glm::normalize(s.normals[t[0]] + s.normals[t[1]] + s.normals[t[2]])));
        for (int k = 0; k < 3; ++k) {
            const vec3 u = s.positions[t[(k + 1) % 3]] - s.positions[t[k]];
            const vec3 v = s.positions[t[(k + 2) % 3]] - s.positions[t[k]];
            thinnest = std::min(thinnest, glm::degrees(std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v))));
        }
    }
    std::printf("  volume %.6f m3, smallest triangle %.3g mm2, smallest angle %.2f deg, least facing %.2f\n", volume,
                double(smallest) * 1e6, double(thinnest), double(leastFacing));
    expect(volume > 0.0, "winding is outward");
    expect(smallest > 1e-9f && thinnest > 0.5f, "no degenerate triangles");
    expect(leastFacing > 0.0f, "normals agree with the winding");
}

void checkManifold(const Sculpture& s) {
    std::map<Key, uint32_t> index;
    for (const vec3& p : s.positions) {
        index.emplace(keyOf(p), uint32_t(index.size()));
    }
    std::map<std::pair<uint32_t, uint32_t>, int> directed;
    for (const auto& t : allTriangles(s)) {
        for (int c = 0; c < 3; ++c) {
            ++directed[{index[keyOf(s.positions[t[c]])], index[keyOf(s.positions[t[(c + 1) % 3]])]}];
        }
    }
    size_t bad = 0;
    for (const auto& [edge, count] : directed) {
        const auto twin = directed.find({edge.second, edge.first});
        bad += count != 1 || twin == directed.end() || twin->second != 1;
    }
    expect(bad == 0, "closed two-manifold once seams are welded (" + std::to_string(bad) + " bad edges)");
}

void checkMirror(const Sculpture& s) {
    std::map<Key, int> seen;
    for (const vec3& p : s.positions) {
        ++seen[keyOf(p)];
    }
    size_t alone = 0;
    for (const vec3& p : s.positions) {
        alone += seen.count(keyOf({-p.x, p.y, p.z})) == 0;
    }
    expect(alone == 0, "every vertex has an exact mirror twin (" + std::to_string(alone) + " without)");
}

/// Texels whose centre lies strictly inside two triangles, and the smallest distance between charts.
void checkLayout(const Sculpture& s) {
    constexpr int kSize = 2048;
    std::vector<uint8_t> hits(size_t(kSize) * kSize, 0);
    size_t covered = 0, twice = 0, flipped = 0;
    double stretch = 0.0, area = 0.0;
    for (const auto& t : allTriangles(s)) {
        std::array<glm::dvec2, 3> p;
        for (int c = 0; c < 3; ++c) {
            p[c] = glm::dvec2(s.uvs[t[c]]) * double(kSize);
        }
        const glm::dvec2 u = p[1] - p[0], v = p[2] - p[0];
        const double twiceArea = u.x * v.y - u.y * v.x;
        flipped += twiceArea <= 0.0;
        const double world = 0.5 * double(glm::length(glm::cross(s.positions[t[1]] - s.positions[t[0]],
                                                                 s.positions[t[2]] - s.positions[t[0]])));
        area += world;
        stretch += 0.5 * twiceArea;
        const glm::dvec2 lo = glm::min(p[0], glm::min(p[1], p[2])), hi = glm::max(p[0], glm::max(p[1], p[2]));
        for (int y = std::max(int(lo.y), 0); y <= std::min(int(hi.y), kSize - 1); ++y) {
            for (int x = std::max(int(lo.x), 0); x <= std::min(int(hi.x), kSize - 1); ++x) {
                const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - p[0];
                const double b = (d.x * v.y - d.y * v.x) / twiceArea, c = (u.x * d.y - u.y * d.x) / twiceArea;
                if (b > 1e-6 && c > 1e-6 && b + c < 1.0 - 1e-6) {
                    uint8_t& hit = hits[size_t(y) * kSize + size_t(x)];
                    covered += hit == 0;
                    twice += hit == 1;
                    hit = uint8_t(std::min(hit + 1, 2));
                }
            }
        }
    }
    std::printf("  texture use %.1f %%, %.0f texels per metre at 2048\n", 100.0 * double(covered) / kSize / kSize,
                std::sqrt(stretch / area));
    expect(flipped == 0, "no flipped texture triangles (" + std::to_string(flipped) + ")");
    expect(twice == 0, "texture triangles do not overlap (" + std::to_string(twice) + " texels hit twice)");
}

/// Charts by connected vertices; the gap between any two is measured on a 1024 grid.
void checkMargins(const Sculpture& s) {
    std::vector<uint32_t> leader(s.positions.size());
    for (uint32_t i = 0; i < leader.size(); ++i) {
        leader[i] = i;
    }
    auto find = [&](uint32_t i) {
        while (leader[i] != i) {
            i = leader[i] = leader[leader[i]];
        }
        return i;
    };
    for (const auto& t : allTriangles(s)) {
        for (int c = 0; c < 3; ++c) {
            const uint32_t a = find(t[c]), b = find(t[(c + 1) % 3]);
            leader[std::max(a, b)] = std::min(a, b);
        }
    }
    constexpr int kSize = 1024, kMargin = 4;
    std::vector<uint32_t> owner(size_t(kSize) * kSize, ~0u);
    std::map<uint32_t, int> charts;
    bool apart = true;
    for (uint32_t i = 0; i < s.uvs.size(); ++i) {
        const uint32_t chart = find(i);
        ++charts[chart];
        const int x = int(s.uvs[i].x * kSize), y = int(s.uvs[i].y * kSize);
        for (int dy = -kMargin / 2; dy <= kMargin / 2; ++dy) {
            for (int dx = -kMargin / 2; dx <= kMargin / 2; ++dx) {
                if (x + dx < 0 || y + dy < 0 || x + dx >= kSize || y + dy >= kSize) {
                    apart = false;
                    continue;
                }
                uint32_t& o = owner[size_t(y + dy) * kSize + size_t(x + dx)];
                apart = apart && (o == ~0u || o == chart);
                o = chart;
            }
        }
    }
    expect(apart, std::to_string(charts.size()) + " charts keep a margin of 4 texels at 1024");
}

template <typename Image>
uint64_t hashImage(const Image& image) {
    Hash hash;
    hash.add(image.values);
    return hash.value();
}

void checkScalar(const char* name, ScalarImage (*paint)(int)) {
    const ScalarImage a = paint(512), b = paint(512);
    float lo = 1e9f, hi = -1e9f;
    double sum = 0.0;
    for (float v : a.values) {
        lo = std::min(lo, v);
        hi = std::max(hi, v);
        sum += double(v);
    }
    std::printf("  %s: %.3f..%.3f, mean %.3f\n", name, double(lo), double(hi), sum / double(a.values.size()));
    expect(lo >= 0.0f && hi <= 1.0f && hi > 0.5f && a.values.size() == 512u * 512u, std::string(name) + " in range");
    expect(hashImage(a) == hashImage(b), std::string(name) + " repeatable");
}

void checkColour(const char* name, ColourImage (*paint)(int)) {
    const ColourImage a = paint(512), b = paint(512);
    const bool good = std::all_of(a.values.begin(), a.values.end(), [](const vec3& c) {
        return glm::all(glm::greaterThanEqual(c, vec3(0.0f))) && glm::all(glm::lessThanEqual(c, vec3(1.0f)));
    });
    expect(good && a.values.size() == 512u * 512u, std::string(name) + " in range");
    expect(hashImage(a) == hashImage(b), std::string(name) + " repeatable");
}

void checkSculpture(const char* name, Sculpture (*build)(), size_t most = 40000) {
    const auto start = std::chrono::steady_clock::now();
    const Sculpture s = build();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const size_t count = allTriangles(s).size();
    std::printf("%s: %zu vertices, %zu triangles, %.2f s\n", name, s.positions.size(), count, seconds);
    expect(count >= 20000 && count <= most, "triangle count within 20000.." + std::to_string(most));
    checkGeometry(s);
    checkManifold(s);
    checkMirror(s);
    checkLayout(s);
    checkMargins(s);
    const uint64_t first = hashOf(s), second = hashOf(build());
    std::printf("  hash %016llx\n", static_cast<unsigned long long>(first));
    expect(first == second, "two runs give the same bytes");
}

}  // namespace

int main() {
    checkSculpture("bust", sculptBust);
    checkScalar("bustScalpDensity", bustScalpDensity);
    checkScalar("bustBrowDensity", bustBrowDensity);
    checkColour("bustSkin", bustSkin);
    checkSculpture("bob", sculptBob, 60000);
    checkScalar("bobDensity", bobDensity);
    checkSculpture("creature", sculptCreature);
    checkScalar("creatureDensity", creatureDensity);
    checkScalar("creatureLength", creatureLength);
    checkColour("creatureSkin", creatureSkin);
    checkColour("creatureFurColour", creatureFurColour);
    std::printf("%d failures\n", failures);
    return failures == 0 ? 0 : 1;
}
