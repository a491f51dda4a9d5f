// SPDX-License-Identifier: Apache-2.0
// Small meshes and grooms for tests.
#pragma once

#include "core/model/groom.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace whorl::testing {

/// Unit square in x and z at y = 0, normal up, `cells` x `cells` x 2 triangles, UVs = (x, z) + 0.5.
SurfaceMesh plane(int cells, float size = 1.0f);
/// Latitude-longitude sphere with UVs, poles along y, outward.
SurfaceMesh sphere(int rings, int sectors, float radius = 0.1f);
/// Guides along the normals at evenly chosen triangle centres, without any sampler.
Groom groomOn(SurfaceMesh mesh, int guides, int segments = 15, float length = 0.05f);
/// A groom with random parameters, groups, maps and bent guides: for property tests.
Groom randomGroom(std::uint32_t seed);
/// Every byte that a groom means (guides, maps, parameters, mesh), for "the same bytes" tests.
std::uint64_t groomDigest(const Groom& groom);
/// $WHORL_TEST_DATA/name when that folder of real data is there.
std::optional<std::filesystem::path> realData(const std::string& name);
/// A fresh empty folder, removed at exit.
std::filesystem::path scratchFolder(const std::string& name);

}  // namespace whorl::testing
