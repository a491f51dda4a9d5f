// SPDX-License-Identifier: Apache-2.0
// The view of the groom: draws it, moves the camera, and hands strokes to the document.
#pragma once

#include "editor/app/document.h"
#include "editor/app/editor_state.h"
#include "editor/app/hair_job.h"
#include "editor/app/heat_job.h"
#include "editor/app/lic_job.h"
#include "editor/app/viewport/brush_adjust.h"
#include "editor/app/viewport/navigation.h"
#include "editor/app/viewport/stroke_input.h"
#include "render/renderer.h"

#include <QOpenGLWidget>
#include <QTimer>
#include <memory>

namespace whorl {

class Viewport : public QOpenGLWidget {
    Q_OBJECT

public:
    Viewport(Document& document, EditorState& state, QWidget* parent = nullptr);
    ~Viewport() override;

    const Camera& camera() const { return m_camera; }
    void setCamera(const Camera& camera);
    /// The whole model, from where the camera is.
    void frameAll();
    /// The guides, or the whole model when there are none.
    void frameHair();
    /// A name that Camera::named knows.
    void lookFrom(const char* name);

    /// What the next press would do, in words; changes with tool and held keys.
    QString hint() const;
    /// Hair is being generated.
    bool busy() const { return m_hair.busy(); }
    /// Nothing is being generated, and the picture is the final one.
    bool settled() const;
    std::shared_ptr<const Strands> strands() const { return m_strands; }
    std::shared_ptr<const LicTexture> licTexture() const {
        const auto image = m_lic.image();
        return image ? image->texture() : nullptr;
    }
    /// The line of text below the picture.
    QString statusText() const;
    /// Draws a hair and the guides that shape it over everything; empty for none.
    void setHighlight(std::vector<glm::vec3> hair, std::vector<std::vector<glm::vec3>> guides);
    /// The view's settings with the tool's overlay, as they are drawn.
    ViewSettings viewSettings() const;

Q_SIGNALS:
    void hintChanged(const QString& hint);
    /// A click without a brush met the hair of this number in the groom; nothing when it met none.
    void hairPicked(std::optional<std::uint32_t> id);
    /// A sentence for the artist (a brush that refuses, hair that can not be made).
    void said(const QString& sentence);
    /// Drawing is impossible on this machine.
    void failed(const QString& sentence);

protected:
    void initializeGL() override;
    void paintGL() override;
    bool event(QEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void tabletEvent(QTabletEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void enterEvent(QEnterEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    void documentChanged();
    void requestHair();
    void requestHeat();
    void requestLic();
    void interacted();
    bool interacting() const;
    void press(glm::vec2 pixel, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, float pressure);
    void move(glm::vec2 pixel, Qt::KeyboardModifiers modifiers, float pressure);
    void release();
    /// Escape: gives up whatever is going on. False when nothing was.
    bool dropAll();
    void setModifiers(Qt::KeyboardModifiers modifiers);
    void releaseRenderer();
    void pick(glm::vec2 pixel);
    OverlayState overlay() const;
    Bounds sceneBounds() const;
    glm::vec2 sizePixels() const;

    Document& m_document;
    EditorState& m_state;
    Camera m_camera;
    Navigation m_navigation;
    StrokeInput m_stroke;
    BrushAdjust m_adjust;
    HairJob m_hair;
    HeatJob m_heat;
    LicJob m_lic;
    Groom m_licSeen;  // what the last request for hair texture was made from
    int m_licSize = 0;
    std::shared_ptr<const Strands> m_heatStrands;  // that the newest request for colours was made from
    std::unique_ptr<Renderer> m_renderer;
    std::shared_ptr<const Strands> m_strands;
    Groom m_seen;  // what the last request for hair was made from
    GenerateOptions m_seenOptions;
    std::vector<glm::vec3> m_looked;
    std::vector<std::vector<glm::vec3>> m_lookedBy;
    bool m_lookedChanged = false;
    std::optional<glm::vec2> m_click;  // where the left button went down, while the pointer has hardly moved
    QTimer m_frame;                    // draws when hair that was about to arrive is late
    QTimer m_settle;                   // runs out when the artist has been still for a moment
    glm::vec2 m_pixel{0.0f};
    bool m_inside = false;
    Qt::KeyboardModifiers m_modifiers;
    double m_drawMilliseconds = 0.0;
};

}  // namespace whorl
