// SPDX-License-Identifier: Apache-2.0
#include "core/surface/atlas_pack.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace whorl::atlas {
namespace {

// Above this many rectangles shelves are full enough and much faster than a skyline.
constexpr std::size_t mostForSkyline = 4000;

struct Step {
    int x, y, width;
};

std::optional<std::vector<glm::ivec2>> packShelves(const std::vector<glm::ivec2>& sizes,
                                                   const std::vector<std::size_t>& order, int side) {
    std::vector<glm::ivec2> places(sizes.size());
    int x = 0, y = 0, height = 0;
    for (const std::size_t i : order) {
        if (x + sizes[i].x > side) {
            x = 0;
            y += height;
            height = 0;
        }
        if (height == 0) height = sizes[i].y;
        if (sizes[i].x > side || y + height > side) return std::nullopt;
        places[i] = {x, y};
        x += sizes[i].x;
    }
    return places;
}

// Height at which a rectangle of `width` rests on the steps from `first` on; -1 when it sticks out.
int restingHeight(const std::vector<Step>& skyline, std::size_t first, int width, int side) {
    if (skyline[first].x + width > side) return -1;
    int height = 0;
    int left = width;
    for (std::size_t i = first; left > 0; ++i) {
        height = std::max(height, skyline[i].y);
        left -= skyline[i].width;
    }
    return height;
}

void raise(std::vector<Step>& skyline, std::size_t first, const glm::ivec2& size, int y) {
    const Step raised{skyline[first].x, y + size.y, size.x};
    const int end = raised.x + raised.width;
    std::size_t last = first;
    while (last < skyline.size() && skyline[last].x + skyline[last].width <= end) ++last;
    if (last < skyline.size() && skyline[last].x < end) {
        skyline[last].width -= end - skyline[last].x;
        skyline[last].x = end;
    }
    skyline.erase(skyline.begin() + static_cast<std::ptrdiff_t>(first),
                  skyline.begin() + static_cast<std::ptrdiff_t>(last));
    skyline.insert(skyline.begin() + static_cast<std::ptrdiff_t>(first), raised);
}

}  // namespace

std::optional<std::vector<glm::ivec2>> pack(const std::vector<glm::ivec2>& sizes, int side) {
    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return sizes[a].y != sizes[b].y ? sizes[a].y > sizes[b].y : sizes[a].x > sizes[b].x;
    });
    if (sizes.size() > mostForSkyline) return packShelves(sizes, order, side);

    std::vector<glm::ivec2> places(sizes.size());
    std::vector<Step> skyline{{0, 0, side}};
    for (const std::size_t i : order) {
        std::size_t best = skyline.size();
        int bestTop = std::numeric_limits<int>::max();
        for (std::size_t step = 0; step < skyline.size(); ++step) {
            const int y = restingHeight(skyline, step, sizes[i].x, side);
            if (y < 0) break;
            if (y + sizes[i].y < bestTop && y + sizes[i].y <= side) {
                best = step;
                bestTop = y + sizes[i].y;
            }
        }
        if (best == skyline.size()) return std::nullopt;
        places[i] = {skyline[best].x, bestTop - sizes[i].y};
        raise(skyline, best, sizes[i], places[i].y);
    }
    return places;
}

}  // namespace whorl::atlas
