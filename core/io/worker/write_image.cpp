// SPDX-License-Identifier: Apache-2.0
// Encoding: the parent made the file and renames it when all went well.
#include "core/io/worker/answer.h"

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <vector>

namespace whorl::image_worker {
namespace {

bool receive(void* data, std::size_t bytes) {
    char* to = static_cast<char*>(data);
    while (bytes > 0) {
        const ssize_t got = ::read(STDIN_FILENO, to, bytes);
        if (got <= 0) return false;
        to += got;
        bytes -= static_cast<std::size_t>(got);
    }
    return true;
}

}  // namespace

int writeImage(const std::string& plugin, const std::string& path) {
    image_protocol::Request request;
    if (!receive(&request, sizeof request) || request.magic != image_protocol::requestMagic) {
        return fail("the pixels did not arrive");
    }
    const OIIO::TypeDesc type = request.format == 0   ? OIIO::TypeDesc::UINT8
                                : request.format == 1 ? OIIO::TypeDesc::UINT16
                                                      : OIIO::TypeDesc::FLOAT;
    std::vector<unsigned char> pixels(std::size_t{request.width} * request.height * request.channels *
                                      image_protocol::formatBytes(request.format));
    if (!receive(pixels.data(), pixels.size())) return fail("the pixels did not arrive");

    OIIO::attribute("threads", 1);
    auto output = OIIO::ImageOutput::create(plugin);
    if (!output) return fail("this build of OpenImageIO can not write the format " + plugin);
    OIIO::ImageSpec spec(static_cast<int>(request.width), static_cast<int>(request.height),
                         static_cast<int>(request.channels),
                         request.half != 0 ? OIIO::TypeDesc(OIIO::TypeDesc::HALF) : type);
    spec.attribute("oiio:ColorSpace", request.srgb != 0 ? "sRGB" : "Linear");
    spec.attribute("Software", "Whorl");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (plugin == "jpeg") spec.attribute("compression", "jpeg:95");
    if (plugin == "openexr" || plugin == "tiff") spec.attribute("compression", "zip");
    if (!output->open(path, spec) || !output->write_image(type, pixels.data()) || !output->close()) {
        const std::string error = output->geterror();
        return fail(error.empty() ? "the disk is full or the folder can not be written to"
                                  : error.substr(0, error.find('\n')));
    }
    const image_protocol::Answer answer{};
    return send(&answer, sizeof answer) ? 0 : 1;
}

}  // namespace whorl::image_worker
