// SPDX-License-Identifier: Apache-2.0
// OpenGL without a window or display.
#pragma once

#include "core/base/result.h"

namespace whorl::gl {

/// An OpenGL 4.5 core context on EGL's surfaceless platform. Made current by `create`; one thread.
class HeadlessContext {
public:
    static Result<HeadlessContext> create();
    HeadlessContext(HeadlessContext&& other) noexcept;
    HeadlessContext& operator=(HeadlessContext&& other) noexcept;
    ~HeadlessContext();
    /// Needed before every use when the thread has several contexts.
    void makeCurrent() const;

private:
    HeadlessContext() = default;
    void* m_display = nullptr;
    void* m_context = nullptr;
};

}  // namespace whorl::gl
