// SPDX-License-Identifier: Apache-2.0
// Where exceptions of libraries end.
#pragma once

#include "core/base/result.h"

#include <exception>
#include <new>
#include <string>

namespace whorl {

/// What `work` returns, or a sentence about `name` when a library (JSON, file names, memory) threw.
template <class Work>
auto guarded(const std::string& name, Work&& work) -> decltype(work()) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return Error{name + " needs more memory than there is."};
    } catch (const std::exception& exception) {
        return Error{name + " can not be handled: " + exception.what() + "."};
    }
}

}  // namespace whorl
