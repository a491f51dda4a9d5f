// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace whorl {

void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0) return;
    grain = std::max<std::size_t>(grain, 1);
    const std::size_t blocks = (count + grain - 1) / grain;
    if (blocks == 1) {
        body(0, count);
        return;
    }
    tbb::parallel_for(std::size_t{0}, blocks,
                      [&](std::size_t block) { body(block * grain, std::min(count, (block + 1) * grain)); });
}

ThreadLimit::ThreadLimit(unsigned threads) {
    if (threads > 0) m_control = new tbb::global_control(tbb::global_control::max_allowed_parallelism, threads);
}

ThreadLimit::~ThreadLimit() {
    delete static_cast<tbb::global_control*>(m_control);
}

}  // namespace whorl
