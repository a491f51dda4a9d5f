// SPDX-License-Identifier: Apache-2.0
// NAME.groom: the package that the render-time library turns into hair (seed 000, section 4.2.1).
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/hair/strands.h"
#include "core/model/groom.h"
#include "core/sampling/root_sampler.h"
#include "core/surface/surface.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

// A package is a folder, complete in itself:
//   groom.json     what all calls share: parameters of the groups, counts, digest of all hair, and the list of parts
//                  with their boxes; a checksum covers it
//   groom.rib      an example of how a RenderMan renderer is told of it; nothing reads it
//   shared.bin     mesh, guides and maps, once for all parts: hairs near the border of a part follow guides and lie
//                  over skin of its neighbours, so every call reads it
//   part-NNNN.bin  what one call alone needs to know: its range of the surface, number of its hairs, exact bounding
//   box, digest of its
//                  hair, and the piece of the mesh that it grows on (triangles with the number of roots on each)
// Nothing outside the folder is read, and links in it are refused.

namespace whorl {

/// Frames of a shot, whose boxes are kept: hair with animated frizz is elsewhere in each.
struct PackageFrames {
    static constexpr int most = 10000;
    int first = 0;
    int last = -1;  ///< below `first`: none
    double perSecond = 24.0;
    bool empty() const { return last < first; }
    std::size_t count() const { return empty() ? 0 : static_cast<std::size_t>(std::int64_t{last} - first) + 1; }
    /// Seconds, as GenerateOptions::time.
    float timeOf(int frame) const { return static_cast<float>(frame / perSecond); }
    bool operator==(const PackageFrames&) const = default;
};

struct PackagePart {
    std::string file;
    RootRange range{0, 0};
    std::uint64_t asked = 0;          ///< hairs of the whole groom
    Bounds bounds;                    ///< of the rendered hair at time 0; empty when nothing grows here
    std::vector<Bounds> frameBounds;  ///< of each of the package's frames
    std::uint64_t bytes = 0;
    std::uint64_t hairs = 0;                   ///< that grow there and were not cut away
    std::uint64_t vertices = 0;                ///< of these hairs
    std::uint64_t digest = 0;                  ///< of the hair of this part alone
    std::vector<std::uint32_t> triangles;      ///< with roots of this part, ascending
    std::vector<std::uint32_t> triangleHairs;  ///< hairs on each of them
};

struct Package {
    Groom groom;  ///< generates the very same hair
    std::vector<PackagePart> parts;
    PackageFrames frames;
    std::uint64_t digest = 0;  ///< of all hair at time 0, as exported
    Problems problems;
};

/// Writes to a temporary folder beside, reads it back, generates from that and checks the digest, then puts it in
/// place: the old package or the new one. Every part is generated once for its box. `parts` 0: counts.parts; at most
/// 4096. A folder that holds anything but a package is refused, not replaced. `surface`: that of the groom's mesh when
/// it is at hand. `frames`: those to keep boxes of, at most PackageFrames::most; older versions can not read packages
/// with frames.
Result<void> exportPackage(const Groom& groom, const std::filesystem::path& folder, std::uint32_t parts,
                           Progress& progress, std::shared_ptr<const Surface> surface = nullptr,
                           const PackageFrames& frames = {});
/// Refuses what is broken, incomplete or newer. Does not generate; compare `digest` with hairDigest for that.
Result<Package> openPackage(const std::filesystem::path& folder, Progress& progress);
/// True for a folder whose groom.json begins as that of a package does.
bool isPackage(const std::filesystem::path& folder);

}  // namespace whorl
