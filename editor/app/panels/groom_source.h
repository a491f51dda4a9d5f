// SPDX-License-Identifier: Apache-2.0
// Parameters of the groom, of the brush and of the view, as forms see them.
#pragma once

#include "core/model/groom.h"
#include "editor/app/document.h"
#include "editor/app/editor_state.h"
#include "editor/app/widgets/param_source.h"

#include <QElapsedTimer>

namespace whorl {

/// One block of the active group ("frizz", or "modifiers/NAME" of a modifier that it has), or of the whole groom
/// ("counts", "field", "lic").
class GroomSource : public ParamSource {
    Q_OBJECT

public:
    GroomSource(Document& document, EditorState& state, std::string block, QObject* parent = nullptr);

    std::vector<ParamRef> values() override;
    std::vector<ParamRef> defaults() override;
    void set(const ParamRef& param, const ParamValue& value, bool dragging) override;
    void drop() override { m_document.revert(); }
    void setMap(const ParamRef& param, const std::string& map) override;
    QStringList maps(bool colour) const override;
    bool createMap(const ParamRef& param) override;
    bool takesMaps() const override { return true; }

Q_SIGNALS:
    /// An edit was refused.
    void said(const QString& sentence);

private:
    std::string path(const ParamRef& param) const;
    /// "Crown: tip amount of frizz".
    QString undoText(const ParamRef& param) const;
    /// The parameters of the block, when it is one of the whole groom.
    std::vector<ParamRef> ofGroom(Groom& groom) const;
    std::vector<ParamRef> ofGroup(HairParams& params) const;
    bool ofModifier() const { return m_block.starts_with("modifiers/"); }
    void documentChanged();

    Document& m_document;
    EditorState& m_state;
    std::string m_block;
    Modifier m_modifier;  // of a block "modifiers/NAME": as it was seen last, also when it is gone
    Modifier m_defaultModifier;
    HairParams m_params;  // copies that `values` points into
    Groom m_blocks;       // only its blocks of the whole groom
    Groom m_defaultBlocks;
    Groom m_seen;  // only the parts that forms show
    int m_seenGroup = -1;
    QElapsedTimer m_sinceEdit;
    int m_session = 0;  // steps of one session at one parameter merge
};

/// A block of EditorState: changes at once, without history.
template <class Options>
class StateSource : public ParamSource {
public:
    using Get = const Options& (EditorState::*)() const;
    using Set = void (EditorState::*)(const Options&);

    StateSource(EditorState& state, const Document& document, Get getter, Set setter, QObject* parent)
        : ParamSource(parent), m_state(state), m_document(document), m_get(getter), m_set(setter) {
        connect(&state, &EditorState::changed, this, &ParamSource::changed);
        connect(&document, &Document::changed, this, [this] {
            if (m_document.groom().maps.sameAs(m_seenMaps)) return;
            m_seenMaps = m_document.groom().maps;
            Q_EMIT changed();
        });
    }

    std::vector<ParamRef> values() override {
        m_copy = (m_state.*m_get)();
        return paramsOf(m_copy);
    }
    std::vector<ParamRef> defaults() override {
        m_default = Options{};
        return paramsOf(m_default);
    }
    void set(const ParamRef& param, const ParamValue& value, bool) override {
        const std::string_view id = param.info.id;
        Options options = (m_state.*m_get)();
        for (const ParamRef& own : paramsOf(options)) {
            if (own.info.id == id && !setParamValue(own, value)) return;
        }
        (m_state.*m_set)(options);
    }
    void drop() override {}
    void setMap(const ParamRef&, const std::string&) override {}
    QStringList maps(bool colour) const override;
    bool createMap(const ParamRef&) override { return false; }
    bool takesMaps() const override { return false; }

private:
    EditorState& m_state;
    const Document& m_document;
    Get m_get;
    Set m_set;
    Options m_copy;
    Options m_default;
    MapSet m_seenMaps;
};

/// Names of the groom's maps with one channel, or with three.
QStringList mapNames(const Groom& groom, bool colour);

template <class Options>
QStringList StateSource<Options>::maps(bool colour) const {
    return mapNames(m_document.groom(), colour);
}

}  // namespace whorl
