// SPDX-License-Identifier: Apache-2.0
// The openers that hair_file.cpp lists, one a format.
#pragma once

#include "core/io/hair_file.h"

namespace whorl {

/// PLY 1.0, binary: vertices with position, normal, width and sRGB colour with opacity, then `edge` elements.
Result<std::unique_ptr<HairWriter>> openHairPly(const std::filesystem::path& file, bool normals);
/// OBJ: `v` lines and one `l a b` line a piece (Blender reads only two indices a line).
Result<std::unique_ptr<HairWriter>> openHairObj(const std::filesystem::path& file, bool normals);
/// RIB for RenderMan: Catmull-Rom `Curves` with P, width, N, Cs, Os, s, t, hair_id (see numberOf), hair_member and
/// hair_group, first and last vertices twice.
Result<std::unique_ptr<HairWriter>> openHairRib(const std::filesystem::path& file, bool normals);
/// Cem Yuksel's .hair with segments, points, thickness, transparency and colours.
Result<std::unique_ptr<HairWriter>> openHairYuksel(const std::filesystem::path& file, bool normals);

}  // namespace whorl
