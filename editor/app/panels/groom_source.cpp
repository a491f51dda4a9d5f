// SPDX-License-Identifier: Apache-2.0
#include "editor/app/panels/groom_source.h"

#include "core/commands/group_edits.h"
#include "core/param/path.h"

#include <algorithm>

namespace whorl {
namespace {

constexpr int newMapSize = 1024;
constexpr int sessionMilliseconds = 1200;

}  // namespace

GroomSource::GroomSource(Document& document, EditorState& state, std::string block, QObject* parent)
    : ParamSource(parent), m_document(document), m_state(state), m_block(std::move(block)) {
    connect(&document, &Document::changed, this, &GroomSource::documentChanged);
    connect(&state, &EditorState::changed, this, &GroomSource::documentChanged);
    m_sinceEdit.start();
}

void GroomSource::documentChanged() {
    const Groom& groom = m_document.groom();
    const bool same = groom.groups.sameAs(m_seen.groups) && groom.maps.sameAs(m_seen.maps) &&
                      m_seenGroup == m_state.group() && groom.counts.sameAs(m_seen.counts) &&
                      groom.field.sameAs(m_seen.field) && groom.lic.sameAs(m_seen.lic);
    if (same) return;
    m_seen.groups = groom.groups;
    m_seen.maps = groom.maps;
    m_seen.counts = groom.counts;
    m_seen.field = groom.field;
    m_seen.lic = groom.lic;
    m_seenGroup = m_state.group();
    Q_EMIT changed();
}

std::vector<ParamRef> GroomSource::ofGroom(Groom& groom) const {
    std::vector<ParamRef> found;
    Groom::eachBlock(groom, [&](const BlockInfo& info, auto& block) {
        if (info.id == m_block) found = paramsOf(block.edit());
    });
    return found;
}

std::vector<ParamRef> GroomSource::ofGroup(HairParams& params) const {
    std::vector<ParamRef> found;
    HairParams::each(params, [&](const BlockInfo& info, auto& block) {
        if (info.id == m_block) found = paramsOf(block);
    });
    return found;
}

std::vector<ParamRef> GroomSource::values() {
    const Groom& groom = m_document.groom();
    const std::size_t group = static_cast<std::size_t>(std::max(m_state.group(), 0));
    m_params = (*groom.groups)[std::min(group, groom.groups->size() - 1)].params;
    m_blocks.counts = groom.counts;
    m_blocks.field = groom.field;
    m_blocks.lic = groom.lic;
    if (std::vector<ParamRef> found = ofGroom(m_blocks); !found.empty()) return found;
    if (ofModifier()) {
        const std::string name = m_block.substr(m_block.find('/') + 1);
        for (const Modifier& modifier : m_params.modifiers) {
            // One of another kind has other rows: its own form is on the way.
            const bool same = m_modifier.name.empty() || modifier.kind() == m_modifier.kind();
            if (modifier.name == name && same) m_modifier = modifier;
        }
        return paramsOf(m_modifier);
    }
    return ofGroup(m_params);
}

std::vector<ParamRef> GroomSource::defaults() {
    // Statics and members: the references must outlive the call.
    static HairParams params;
    m_defaultBlocks.mesh = m_document.groom().mesh;
    m_defaultBlocks.setDefaults();
    if (std::vector<ParamRef> found = ofGroom(m_defaultBlocks); !found.empty()) return found;
    if (ofModifier()) {
        m_defaultModifier.params = defaultModifierParams(m_modifier.kind());
        return paramsOf(m_defaultModifier);
    }
    return ofGroup(params);
}

std::string GroomSource::path(const ParamRef& param) const {
    Groom blocks;
    if (!ofGroom(blocks).empty()) return m_block + "/" + std::string(param.info.id);
    const Groom& groom = m_document.groom();
    const std::size_t group = static_cast<std::size_t>(std::max(m_state.group(), 0));
    return "groups/" + (*groom.groups)[std::min(group, groom.groups->size() - 1)].name + "/" + m_block + "/" +
           std::string(param.info.id);
}

QString GroomSource::undoText(const ParamRef& param) const {
    QString block = QString::fromStdString(m_block.substr(ofModifier() ? m_block.find('/') + 1 : 0));
    block[0] = block[0].toUpper();
    return tr("Change %1 (%2)").arg(qtext(param.info.label), block);
}

void GroomSource::set(const ParamRef& param, const ParamValue& value, bool dragging) {
    const bool dragged = m_document.previewing();
    Groom after = m_document.committed();
    const Result<void> done = setGroomValue(after, path(param), value);
    if (!done) {
        m_document.revert();
        Q_EMIT said(QString::fromStdString(done.error().message));
        Q_EMIT changed();
        return;
    }
    m_document.preview(std::move(after));
    if (dragging) return;
    // A drag is one step of its own; clicks and keys that follow each other closely are one step, too.
    if (dragged || m_sinceEdit.elapsed() > sessionMilliseconds) ++m_session;
    m_document.commit(undoText(param), QString("%1#%2").arg(QString::fromStdString(path(param))).arg(m_session));
    if (dragged) ++m_session;
    m_sinceEdit.restart();
}

void GroomSource::setMap(const ParamRef& param, const std::string& map) {
    Groom after = m_document.committed();
    const Result<void> done = setGroomValue(after, path(param) + "/map", map);
    if (!done) {
        Q_EMIT said(QString::fromStdString(done.error().message));
        return;
    }
    m_document.edit(std::move(after), map.empty() ? tr("Take map off %1").arg(qtext(param.info.label))
                                                  : tr("Map %1 with %2").arg(qtext(param.info.label), qtext(map)));
}

QStringList GroomSource::maps(bool colour) const {
    return mapNames(m_document.groom(), colour);
}

bool GroomSource::createMap(const ParamRef& param) {
    Groom after = m_document.committed();
    const bool colour = std::holds_alternative<DrivenColour*>(param.target);
    const std::string name = freeMapName(after, param.info.id);
    // White changes nothing: the artist paints from there.
    Map map(newMapSize, newMapSize, colour ? 3 : 1, TexelFormat::U8, 1.0f);
    map.srgb = colour;
    after.maps.set(name, std::move(map));
    const Result<void> done = setGroomValue(after, path(param) + "/map", name);
    if (!done) {
        Q_EMIT said(QString::fromStdString(done.error().message));
        return false;
    }
    m_document.edit(std::move(after), tr("New map for %1").arg(qtext(param.info.label)));
    if (!colour) {
        BrushOptions options = m_state.brushOptions();
        options.map.name = name;
        m_state.setBrushOptions(options);
    }
    return true;
}

QStringList mapNames(const Groom& groom, bool colour) {
    QStringList names;
    for (const MapSet::Entry& entry : groom.maps.entries()) {
        if ((entry.map->channels() == 3) == colour) names.push_back(QString::fromStdString(entry.name));
    }
    return names;
}

}  // namespace whorl
