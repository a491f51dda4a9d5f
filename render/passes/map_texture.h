// SPDX-License-Identifier: Apache-2.0
// A map of the groom on the graphics card; painting uploads only the tiles it touched.
#pragma once

#include "core/model/map.h"
#include "render/gl/objects.h"
#include "render/uploads.h"

namespace whorl {

class MapTexture {
public:
    /// Makes the texture, or brings its changed tiles. Maps beyond `maxSize` are thinned to a part of their texels.
    void update(const Map& map, int maxSize, Uploads& uploads);
    void bind(unsigned unit) const { m_texture.bind(unit); }
    const Map& map() const { return m_map; }
    bool empty() const { return m_map.empty(); }

private:
    void uploadTile(const Map& map, int column, int row, Uploads& uploads);

    Map m_map;  // what is on the card; tiles are shared with the groom
    gl::Texture m_texture;
    int m_step = 1;  // every m_step-th texel is kept
};

}  // namespace whorl
