// SPDX-License-Identifier: Apache-2.0
// Writing for other programs: package, hair as curves, pictures.
#pragma once

#include "core/io/bake_files.h"

#include <QObject>
#include <filesystem>

class QWidget;

namespace whorl {

class Actions;
class Document;
class EditorState;
class MessageBar;
class Viewport;

class Exports : public QObject {
    Q_OBJECT

public:
    /// `viewport` may be null.
    Exports(Document& document, EditorState& state, Viewport* viewport, MessageBar& messages, Actions& actions,
            QWidget& window);

    /// Writes NAME.groom; problems are said. `parts` 0: as the groom says.
    bool exportPackage(const std::filesystem::path& folder, std::uint32_t parts = 0);
    /// Format by suffix.
    bool exportHair(const std::filesystem::path& file);
    /// Hair texture as images in the mesh's UVs.
    bool bakeLic(const BakeRequest& request);
    /// The view's camera, light and choice of hair or its texture, with all hairs, in any size.
    bool renderPicture(const std::filesystem::path& file, int width, int height);

private:
    void askPackage();
    void askHair();
    void askBake();
    void askPicture();
    QString startName(const QString& suffix) const;

    Document& m_document;
    EditorState& m_state;
    Viewport* m_viewport;
    MessageBar& m_messages;
    QWidget& m_window;
};

}  // namespace whorl
