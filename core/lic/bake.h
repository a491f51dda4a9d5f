// SPDX-License-Identifier: Apache-2.0
// Hair texture as an image in the mesh's UVs.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/lic/reference.h"
#include "core/model/map.h"

#include <functional>

namespace whorl {

struct LicBake {
    Map brightness;  ///< 0 to 1: the convolution, 8 bit; 0 where no hair lies
    Map coverage;    ///< how much hair lies there, 0 to 1; 8 bit
};

/// One texel a place of the skin: those whose middle lies in a triangle's UVs. Around charts, and over texels that no
/// middle falls into, values go on outward for `margin` texels, so that filtering takes in nothing foreign. `size`: 1
/// to Map::maxSize texels a side. `cover` says how much hair lies at a place that has a direction, 0 to 1 (any thread);
/// empty: all. Where UVs overlap the last triangle counts. Fails only when cancelled.
Result<LicBake> bakeLic(const LicReference& lic, const LicOptions& options, int size, int margin,
                        const std::function<float(const SurfacePoint&)>& cover, Progress& progress);

}  // namespace whorl
