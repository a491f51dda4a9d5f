// SPDX-License-Identifier: Apache-2.0
// The map that the paint brush paints, when the artist has not said which.
#pragma once

#include <string>

namespace whorl {

struct BrushInfo;
class Document;
class EditorState;

/// The density map of the active group; made, as one step of the history, when it has none. Its name; the brush options
/// name it too. Needs an open groom.
std::string paintDensityMap(Document& document, EditorState& state);

/// The map of groups; made, as one step of the history, when there is none. Its name. Needs an open groom.
std::string paintGroupMap(Document& document);

/// For brushes that paint a map. A brush of groups: makes the group map (`make`). Others: leaves the choice of the
/// brush options when the groom has that map, takes the density map of the active group when it has one, and otherwise
/// makes one (`make`) or leaves the choice empty.
void choosePaintMap(Document& document, EditorState& state, const BrushInfo& brush, bool make);

}  // namespace whorl
