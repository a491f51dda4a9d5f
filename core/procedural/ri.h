// SPDX-License-Identifier: Apache-2.0
// What the library needs of the RenderMan interface: types and functions of its public C binding, found in the host at
// run time, so that the library neither links nor ships anything of a renderer.
#pragma once

namespace whorl::procedural {

using RtInt = int;
using RtFloat = float;
using RtToken = char*;
using RtString = char*;
using RtPointer = void*;
using RtBound = float[6];  // xmin, xmax, ymin, ymax, zmin, zmax
using RtBasis = float[4][4];
using RtContextHandle = void*;

// Codes and severity of error handlers.
constexpr RtInt riNoMemory = 1;
constexpr RtInt riBadFile = 4;
constexpr RtInt riError = 2;

/// Functions of the host. All of the first six are there, or nothing can be drawn.
struct RiHost {
    void (*attributeBegin)() = nullptr;
    void (*attributeEnd)() = nullptr;
    void (*basis)(RtBasis u, RtInt uStep, RtBasis v, RtInt vStep) = nullptr;
    void (*curvesV)(RtToken type, RtInt curves, RtInt* vertices, RtToken wrap, RtInt n, RtToken* tokens,
                    RtPointer* values) = nullptr;
    void (*motionBeginV)(RtInt n, RtFloat* times) = nullptr;
    void (*motionEnd)() = nullptr;
    // Where there are any.
    void (*context)(RtContextHandle) = nullptr;
    void (*errorPrint)(RtInt code, RtInt severity, char* message) = nullptr;

    static RiHost find();
    bool complete() const;
    /// Tells the host's error handler; nothing where there is none.
    void tell(RtInt code, const char* sentence) const;
};

}  // namespace whorl::procedural
