// SPDX-License-Identifier: Apache-2.0
// groom.rib: how a RenderMan renderer is told of a package.
#include "core/io/package_files.h"

#include <array>
#include <charconv>

namespace whorl {
namespace {

void addNumber(std::string& text, float number) {
    std::array<char, 32> digits;
    const auto done = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text.append(digits.data(), done.ptr);
}

/// As a word of the procedural's text, inside a string of RIB.
std::string ribWord(const std::string& name) {
    std::string word;
    for (const char c : name) {
        if (c == '"' || c == '\\') word += '\\';
        word += static_cast<unsigned char>(c) < 32 ? '?' : c;
    }
    return word.find(' ') == std::string::npos ? word : "'" + word + "'";
}

std::string commentLine(const std::string& text) {
    std::string line = "# ";
    for (const char c : text) line += static_cast<unsigned char>(c) < 32 ? '?' : c;
    return line + "\n";
}

}  // namespace

std::string packageRibText(const std::string& name, const std::vector<PackagePart>& parts,
                           const PackageFrames& frames) {
    std::string text = "##RenderMan RIB-Structure 1.1 Entity\n";
    text += commentLine("Hair of " + name +
                        ": ReadArchive this file where the mesh is. Metres, Y up. The renderer must find");
    text +=
        "# the library on its procedural path and the package under the name below; write its whole path if need be.\n";
    if (!frames.empty()) {
        text += "# This is frame " + std::to_string(frames.first) +
                ". For motion blur add shutter=0,0.5 as in Shutter, and " + "a box that holds both ends.\n";
    }
    text += "AttributeBegin\n";
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Bounds& box = frames.empty() ? parts[i].bounds : parts[i].frameBounds[0];
        if (box.empty()) continue;
        text +=
            "Procedural \"DynamicLoad\" [\"libwhorl_procedural.so\" \"" + ribWord(name) + " part=" + std::to_string(i);
        if (!frames.empty()) text += " frame=" + std::to_string(frames.first);
        text += "\"] [";
        for (int axis = 0; axis < 3; ++axis) {
            if (axis > 0) text += ' ';
            addNumber(text, box.min[axis]);
            text += ' ';
            addNumber(text, box.max[axis]);
        }
        text += "]\n";
    }
    return text + "AttributeEnd\n";
}

}  // namespace whorl
