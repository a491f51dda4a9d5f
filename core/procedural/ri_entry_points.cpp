// SPDX-License-Identifier: Apache-2.0
// Entry points that RenderMan looks for: the classic dynamic library (ConvertParameters, Subdivide, Free) and
// Procedural2 (Subdivide2, Bound). Declared as the public interface describes them.
#include "core/procedural/ri_curves.h"

#include <dlfcn.h>

#include <cmath>
#include <exception>
#include <new>
#include <string>

using namespace whorl;
using namespace whorl::procedural;

namespace whorl::procedural {
namespace {

template <class Function>
void look(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// One primitive of the classic interface.
struct Primitive {
    Result<RiRequest> request = Error{};
    std::shared_ptr<SharedGroom> groom{};
};

/// No exception goes to the host.
template <class Work>
void contained(const RiHost& host, Work&& work) noexcept {
    try {
        work();
    } catch (const std::bad_alloc&) {
        host.tell(riNoMemory, "The hair needs more memory than there is.");
    } catch (const std::exception& exception) {
        host.tell(riBadFile, exception.what());
    } catch (...) {
        host.tell(riBadFile, "The hair can not be made: something unknown failed.");
    }
}

}  // namespace

RiHost RiHost::find() {
    RiHost host;
    look(host.attributeBegin, "RiAttributeBegin");
    look(host.attributeEnd, "RiAttributeEnd");
    look(host.basis, "RiBasis");
    look(host.curvesV, "RiCurvesV");
    look(host.motionBeginV, "RiMotionBeginV");
    look(host.motionEnd, "RiMotionEnd");
    look(host.context, "RiContext");
    look(host.errorPrint, "RiErrorPrint");
    return host;
}

bool RiHost::complete() const {
    return attributeBegin && attributeEnd && basis && curvesV && motionBeginV && motionEnd;
}

void RiHost::tell(RtInt code, const char* sentence) const {
    if (errorPrint) errorPrint(code, riError, const_cast<char*>(sentence));
}

}  // namespace whorl::procedural

extern "C" {

__attribute__((visibility("default"))) RtPointer ConvertParameters(RtString text) {
    Primitive* primitive = nullptr;
    contained(RiHost::find(), [&] {
        auto made = std::make_unique<Primitive>();
        made->request = parseRequest(text ? std::string_view(text) : std::string_view());
        if (made->request) made->groom = SharedGroom::of(*made->request);
        primitive = made.release();
    });
    return primitive;
}

__attribute__((visibility("default"))) void Subdivide(RtPointer data, RtFloat detail) {
    const RiHost host = RiHost::find();
    if (!host.complete() || !data) return;
    contained(host, [&] {
        const auto& primitive = *static_cast<const Primitive*>(data);
        if (!primitive.request) return host.tell(riBadFile, primitive.request.error().message.c_str());
        drawHair(host, *primitive.request, *primitive.groom, detail);
    });
}

__attribute__((visibility("default"))) void Free(RtPointer data) {
    delete static_cast<Primitive*>(data);
}

__attribute__((visibility("default"))) void Subdivide2(RtContextHandle context, RtFloat detail, RtInt n,
                                                       const RtToken* tokens, const RtPointer* values) {
    const RiHost host = RiHost::find();
    if (!host.complete()) return;
    contained(host, [&] {
        if (host.context && context) host.context(context);
        const auto request = parseRequest(n, tokens, values);
        if (!request) return host.tell(riBadFile, request.error().message.c_str());
        const auto groom = SharedGroom::of(*request);
        drawHair(host, *request, *groom, detail);
    });
}

/// Boxes when the shutter opens and when it closes. RIB with "SimpleBound" and a box from the package, as in groom.rib,
/// needs no call, and does not depend on how a renderer declares this one.
__attribute__((visibility("default"))) void Bound(RtInt n, const RtToken* tokens, const RtPointer* values,
                                                  RtBound* bounds) {
    const RiHost host = RiHost::find();
    if (!bounds) return;
    for (int i = 0; i < 2; ++i)
        for (int side = 0; side < 6; ++side) bounds[i][side] = 0.0f;
    contained(host, [&] {
        const auto request = parseRequest(n, tokens, values);
        if (!request) return host.tell(riBadFile, request.error().message.c_str());
        WhorlStatus status = WHORL_OK;
        WhorlError error{};
        const auto shared = SharedGroom::of(*request);
        const WhorlGroom* groom = shared->get(status, error);
        if (!groom) return host.tell(riBadFile, error.text);
        const RiWish wish = wishOf(*request, *groom);
        // Hair moves between more samples than two as well: the same box for both ends.
        RtBound box;
        status = whorl_box(groom, &wish.request, box, &error);
        if (status != WHORL_OK) return host.tell(riBadFile, error.text);
        if (!(box[0] <= box[1])) return;
        for (int i = 0; i < 2; ++i) std::copy(box, box + 6, bounds[i]);
    });
}

}  // extern "C"
