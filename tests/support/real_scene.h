// SPDX-License-Identifier: Apache-2.0
// Meshes of artists with growing area, parting and strokes: unequal triangles, charts of their own, openings.
#pragma once

#include "tests/support/lic_scene.h"

#include <cmath>
#include <span>
#include <utility>

namespace whorl::testing {

struct RealMesh {
    const char* name;
    const char* file;  ///< of real data; a shipped sample: its name and .whorl
    glm::vec2 crown;   ///< x and z, shares of the bounds: hair grows around the highest place there
    float radius;      ///< metres over the largest side of the bounds
};

/// Samples first: those are always there.
std::span<const RealMesh> realMeshes();
/// `samples`: the folder of the samples. Nothing where the file is not.
std::optional<SurfaceMesh> meshOf(const RealMesh& real, const char* samples);

/// Hair around the crown, parted from front to back over it and beyond the border, with strokes away from the parting,
/// four on each side. The parting lies in a plane across x.
struct CrownScene : LicScene {
    CrownScene(const RealMesh& real, SurfaceMesh mesh);

    glm::vec3 crown{0.0f};
    float radius = 0.0f;  ///< of the growing area, metres
    float edge = 0.0f;    ///< mean length in it

    /// The highest places over a straight way past the crown as seen from above; in radii along x and z.
    std::vector<glm::vec3> under(glm::vec2 from, glm::vec2 to) const;
    /// -1 or 1.
    int sideOf(const glm::vec3& position) const { return position.x < crown.x ? -1 : 1; }
    /// So near the parting that its plane does not say on which side: a traced line leaves it by a little.
    bool onTheLine(const glm::vec3& position) const { return std::abs(position.x - crown.x) <= m_slack; }
    /// Turns the strokes of one side by `turn` radians about their middles as seen from above.
    void turnStrokes(int side, float turn);
    /// The sides of the growing area meet at the parting only, and no way leads round its ends.
    bool separates() const;

private:
    std::vector<glm::vec3> strokePlaces(int side, int number, float turn) const;
    float m_slack = 0.0f;
};

/// Greatest angle in degrees between the field and a stroke's own direction over an edge's length each way (flat
/// triangles put kinks into lines on them), at the points of it that are not in its first or last half edge; and how
/// many those are. Only where hair grows.
std::pair<float, int> worstAlong(const CrownScene& scene, const FieldStroke& stroke);

}  // namespace whorl::testing
