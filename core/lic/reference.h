// SPDX-License-Identifier: Apache-2.0
// Line integral convolution on the skin, written for reading: the law for whatever is faster.
#pragma once

#include "core/field/direction_field.h"
#include "core/surface/surface_walk.h"

#include <memory>
#include <optional>
#include <vector>

// Seed 002 (Mao et al., section 3.1): solid white noise, hashed from the place, is averaged along the streamline of the
// direction field through a place, both ways, with a low-pass kernel. Hair by hair, the texture is even along the hair
// and uncorrelated across it.

namespace whorl {

enum class LicKernel { Box, Hann };

struct LicOptions {
    float length = 0.015f;  ///< of the streamline each way, metres
    float grain = 0.0006f;  ///< side of a cell of the noise, metres: the width of a hair
    float white = 0.5f;     ///< share of cells that are white, 0 to 1
    LicKernel kernel = LicKernel::Hann;
    int seed = 1;
};

/// White (1) or black (0) at a place: a hash of the cell that it lies in.
float solidNoise(const glm::vec3& place, const LicOptions& options);

/// Immutable; any thread may ask.
class LicReference {
public:
    /// `field` is that of `surface`.
    LicReference(std::shared_ptr<const Surface> surface, DirectionField field);

    const Surface& surface() const { return *m_surface; }
    const DirectionField& field() const { return m_field; }

    struct Place {
        SurfacePoint point;
        glm::vec3 position{0.0f};
    };
    /// Places along the field from `from` (the first one), `step` metres apart, by fourth-order Runge-Kutta steps over
    /// the surface, until `metres` or where the field, the growing area or one side of a parting ends. `backward`:
    /// against the field.
    std::vector<Place> streamline(const SurfacePoint& from, float metres, float step, bool backward) const;
    /// Brightness, 0 to 1; nothing where no hair lies.
    std::optional<float> at(const SurfacePoint& point, const LicOptions& options) const;

private:
    glm::vec3 direction(const SurfacePoint& at, float sign) const { return m_field.at(at) * sign; }
    std::shared_ptr<const Surface> m_surface;
    DirectionField m_field;
    SurfaceWalk m_walk;
};

}  // namespace whorl
