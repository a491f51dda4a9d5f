// SPDX-License-Identifier: Apache-2.0
#include "render/gl/headless.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <utility>

namespace whorl::gl {

Result<HeadlessContext> HeadlessContext::create() {
    if (!epoxy_has_egl()) return Error{"Pictures without a window need EGL; install libegl1."};
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
        return Error{"This EGL can not draw without a window; install Mesa's libegl-mesa0 and libgl1-mesa-dri."};
    }
    EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
        return Error{"EGL does not start; install libgl1-mesa-dri, or check the graphics driver."};
    }
    eglBindAPI(EGL_OPENGL_API);
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) {
        return Error{"The graphics driver gives no OpenGL 4.5 context; install a newer driver or Mesa."};
    }
    HeadlessContext result;
    result.m_display = display;
    result.m_context = context;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
        return Error{"The graphics driver can not draw without a window; install Mesa's libegl-mesa0."};
    }
    return result;
}

HeadlessContext::HeadlessContext(HeadlessContext&& other) noexcept
    : m_display(std::exchange(other.m_display, nullptr)), m_context(std::exchange(other.m_context, nullptr)) {}

HeadlessContext& HeadlessContext::operator=(HeadlessContext&& other) noexcept {
    std::swap(m_display, other.m_display);
    std::swap(m_context, other.m_context);
    return *this;
}

HeadlessContext::~HeadlessContext() {
    if (m_context == nullptr) return;
    // The display is shared by the whole process and stays: ending it would end other contexts, too.
    if (eglGetCurrentContext() == m_context) {
        eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(m_display, m_context);
}

void HeadlessContext::makeCurrent() const {
    eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_context);
}

}  // namespace whorl::gl
