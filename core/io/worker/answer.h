// SPDX-License-Identifier: Apache-2.0
// The worker's two jobs and how they answer.
#pragma once

#include "core/io/image_protocol.h"

#include <cstddef>
#include <string>

namespace whorl::image_worker {

/// Sends all bytes to descriptor 1. False when nobody listens any more.
bool send(const void* data, std::size_t bytes);
/// Sends a failed Answer with `text` and gives the exit status 1.
int fail(const std::string& text);

/// Ends this program by SIGPROF once it has used maxHeaderMilliseconds from now; `endHeaderLimit` calls that off.
bool beginHeaderLimit();
void endHeaderLimit();

/// Replaces descriptor 0 by a copy without Exif, XMP and texts where the format (PNG, JPEG) lets that be done surely.
/// False when there is no memory for it.
bool leaveOutMetadata(const std::string& plugin);

/// Decodes descriptor 0 by the OpenImageIO format `plugin` and sends one channel (data) or three (colour).
int readImage(const std::string& plugin, bool colour);
/// Encodes the Request on descriptor 0 to `path`.
int writeImage(const std::string& plugin, const std::string& path);

}  // namespace whorl::image_worker
