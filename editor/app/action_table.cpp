// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush.h"
#include "editor/app/actions.h"

#include <QCoreApplication>

namespace whorl {
namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("Actions", text);
}

QString text(std::string_view view) {
    return QString::fromUtf8(view.data(), static_cast<qsizetype>(view.size()));
}

constexpr bool line = true;

void addFile(std::vector<ActionInfo>& table) {
    const QString menu = tr("File");
    using A = ActionInfo;
    table.push_back({"file.new", tr("&New from a Mesh…"), "Ctrl+N",
                     tr("Starts a new groom on a head, an animal or any other mesh."), menu, A::Push, false, "new"});
    table.push_back({"file.open", tr("&Open…"), "Ctrl+O", tr("Opens a document, a groom package or a mesh."), menu,
                     A::Push, false, "open"});
    table.push_back(
        {"file.sample", tr("Open a Samp&le"), "", tr("Opens a groom that comes with Whorl."), menu, A::Push, line, ""});
    table.push_back({"file.save", tr("&Save"), "Ctrl+S", tr("Saves the document."), menu, A::Push, false, "save"});
    table.push_back({"file.save_as", tr("Save &As…"), "Ctrl+Shift+S", tr("Saves the document under another name."),
                     menu, A::Push, line, ""});
    table.push_back({"file.export_package", tr("&Export Package…"), "Ctrl+E",
                     tr("Writes everything that a renderer needs to make the hair at render time."), menu, A::Push,
                     false, "export"});
    table.push_back({"file.export_hair", tr("Export &Hair…"), "Ctrl+Shift+E",
                     tr("Writes the finished hairs as curves for other programs."), menu, A::Push, false, ""});
    table.push_back({"file.export_lic", tr("&Bake Hair Texture…"), "",
                     tr("Writes colour, opacity, flow and height of the hair as images in the mesh's UVs."), menu,
                     A::Push, false, ""});
    table.push_back({"file.render", tr("&Render Picture…"), "F12", tr("Renders this view with all hairs to a picture."),
                     menu, A::Push, line, "camera"});
    table.push_back({"file.quit", tr("&Quit"), "Ctrl+Q", tr("Closes Whorl."), menu, A::Push, false, ""});
}

void addEdit(std::vector<ActionInfo>& table) {
    const QString menu = tr("Edit");
    using A = ActionInfo;
    table.push_back(
        {"edit.undo", tr("&Undo"), "Ctrl+Z", tr("Takes back the last step."), menu, A::Push, false, "undo"});
    table.push_back({"edit.redo", tr("&Redo"), "Ctrl+Shift+Z; Ctrl+Y", tr("Does the step again that was taken back."),
                     menu, A::Push, line, "redo"});
    table.push_back({"edit.palette", tr("&Find an Action…"), "Ctrl+Shift+P",
                     tr("Finds and runs any action by its name."), menu, A::Push, line, ""});
    table.push_back({"edit.shortcuts", tr("&Keyboard Shortcuts…"), "", tr("Shows and changes the keys of all actions."),
                     menu, A::Push, false, ""});
    table.push_back({"edit.preferences", tr("&Preferences…"), "Ctrl+,", tr("Navigation, theme and undo memory."), menu,
                     A::Push, false, ""});
}

void addGroom(std::vector<ActionInfo>& table) {
    const QString menu = tr("Groom");
    using A = ActionInfo;
    table.push_back({"groom.place_guides", tr("&Place Guides"), "Ctrl+G",
                     tr("Spreads guides evenly where hair grows, in place of those that are there."), menu, A::Push,
                     false, "guides"});
    table.push_back({"groom.add_guides", tr("&Fill Up Guides"), "Ctrl+Shift+G",
                     tr("Spreads more guides between those that are there, up to the number of guides."), menu, A::Push,
                     false, ""});
    table.push_back({"groom.place_on_vertices", tr("Place Guides on &Vertices"), "",
                     tr("Puts a guide on every vertex of the mesh where hair grows, in place of those that are there."),
                     menu, A::Push, false, ""});
    table.push_back({"groom.regroup_guides", tr("Guides to Painted &Groups"), "",
                     tr("Gives every guide the group that is painted at its root."), menu, A::Push, false, ""});
    table.push_back(
        {"groom.clear_guides", tr("&Remove All Guides"), "", tr("Removes every guide."), menu, A::Push, false, ""});
    table.push_back({"groom.clear_partings", tr("Remove All P&artings"), "", tr("Removes every parting."), menu,
                     A::Push, line, ""});
    table.push_back(
        {"groom.grow_along", tr("Grow Guides along S&trokes"), "Ctrl+L",
         tr("Gives the guides of the active group new shapes along the direction that spreads from the strokes; "
            "places guides first when there are none."),
         menu, A::Push, false, "grow"});
    table.push_back({"groom.strokes_from_guides", tr("Strokes &from Guides"), "",
                     tr("Replaces the strokes by those that follow the guides as they lie. They lead from then on: "
                        "\"Combing leads\" is turned off."),
                     menu, A::Push, false, ""});
    table.push_back({"groom.remove_stroke", tr("Remove the Picked Stro&ke"), "Del",
                     tr("Removes the stroke that was drawn, moved or clicked last."), menu, A::Push, false, ""});
    table.push_back(
        {"groom.clear_strokes", tr("Remove All Strok&es"), "", tr("Removes every stroke."), menu, A::Push, line, ""});
    table.push_back({"groom.paint_density", tr("Paint &Density"), "Ctrl+D",
                     tr("Makes a density map for the active group if it has none, and picks the paint brush."), menu,
                     A::Push, false, "paint"});
    table.push_back(
        {"groom.new_seed", tr("New &Seed"), "", tr("Other random roots and noise."), menu, A::Push, false, ""});
}

void addTools(std::vector<ActionInfo>& table) {
    const QString menu = tr("Tools");
    using A = ActionInfo;
    table.push_back({"tool.look", tr("&Look Around"), "Q", tr("No brush: the pointer only moves the view."), menu,
                     A::ToolPick, line, "look"});
    for (const BrushInfo& brush : brushes()) {
        table.push_back({"tool." + text(brush.id), text(brush.label), text(brush.shortcut), text(brush.tip), menu,
                         A::ToolPick, false, text(brush.id)});
    }
    table.back().separatorAfter = true;
    table.push_back(
        {"brush.smaller", tr("&Smaller Brush"), "[", tr("Makes the brush smaller."), menu, A::Push, false, ""});
    table.push_back(
        {"brush.larger", tr("&Larger Brush"), "]", tr("Makes the brush larger."), menu, A::Push, false, ""});
    table.push_back({"brush.mirror", tr("&Mirror Left and Right"), "X",
                     tr("Brushes do the same on the other side of the model."), menu, A::Check, false, "mirror"});
}

void addView(std::vector<ActionInfo>& table) {
    const QString menu = tr("View");
    using A = ActionInfo;
    table.push_back({"view.all", tr("Show &All"), "A; Home", tr("Moves the view so that the whole model is seen."),
                     menu, A::Push, false, "frame"});
    table.push_back(
        {"view.frame", tr("Show &Hair"), ".", tr("Moves the view close to the guides."), menu, A::Push, line, ""});
    table.push_back(
        {"view.front", tr("&Front"), "Num+1; Alt+1", tr("Looks from the front."), menu, A::Push, false, ""});
    table.push_back(
        {"view.back", tr("&Back"), "Ctrl+Num+1; Alt+2", tr("Looks from the back."), menu, A::Push, false, ""});
    table.push_back({"view.right", tr("Ri&ght"), "Num+3; Alt+3", tr("Looks from the model's right side."), menu,
                     A::Push, false, ""});
    table.push_back({"view.left", tr("L&eft"), "Ctrl+Num+3; Alt+4", tr("Looks from the model's left side."), menu,
                     A::Push, false, ""});
    table.push_back({"view.top", tr("T&op"), "Num+7; Alt+5", tr("Looks from above."), menu, A::Push, line, ""});
    table.push_back({"view.hair", tr("&Hair"), "Shift+H", tr("Shows or hides the hair."), menu, A::Check, false, ""});
    table.push_back({"view.texture", tr("Hair as &Texture"), "Shift+T",
                     tr("Shows hair as a texture on the model, which follows strokes at once; or as hairs again."),
                     menu, A::Check, false, ""});
    table.push_back(
        {"view.guides", tr("&Guides"), "Shift+G", tr("Shows or hides the guides."), menu, A::Check, false, ""});
    table.push_back({"view.mesh", tr("&Model"), "Shift+M", tr("Shows or hides the model."), menu, A::Check, false, ""});
    table.push_back({"view.heat", tr("&Asked against Placed"), "Shift+A",
                     tr("Colours the model by how many hairs grow where the density asks for them: blue for fewer, "
                        "red for more."),
                     menu, A::Check, line, ""});
    table.push_back({"view.panels", tr("Hide &Panels"), "Tab", tr("Gives the whole window to the view."), menu,
                     A::Check, false, "", true});
    table.push_back({"view.fullscreen", tr("Full &Screen"), "F11", tr("Gives the whole screen to Whorl."), menu,
                     A::Check, false, ""});
}

void addHelp(std::vector<ActionInfo>& table) {
    const QString menu = tr("Help");
    using A = ActionInfo;
    table.push_back({"help.keys", tr("&Keys and Tools"), "F1", tr("One page with every tool, key and action."), menu,
                     A::Push, false, ""});
    table.push_back({"help.whats_this", tr("What's &This?"), "Shift+F1", tr("Click anything to read what it does."),
                     menu, A::Push, line, ""});
    table.push_back({"help.about", tr("&About Whorl"), "", tr("Version and licence."), menu, A::Push, false, ""});
}

void addHeld(std::vector<ActionInfo>& table) {
    const QString menu = tr("In the view");
    using A = ActionInfo;
    const auto held = [&](const char* id, const QString& what, const char* keys, const QString& tip) {
        table.push_back({id, what, keys, tip, menu, A::Held, false, "", true});
    };
    held("held.size", tr("Brush size"), "F or B, move",
         tr("Hold the key and move, or press it, move and click. Without a brush F shows the hair."));
    held("held.strength", tr("Brush strength"), "Shift+F, move",
         tr("Hold the keys and move, or press, move and click."));
    held("held.invert", tr("The opposite"), "Ctrl + drag",
         tr("The brush does its opposite: grow for cut, erase for paint."));
    held("held.smooth", tr("Smooth"), "Shift + drag", tr("Smooths, whatever the brush."));
    held("held.drop", tr("Drop the stroke"), "Escape", tr("Everything is as it was before the stroke."));
    held("held.maya", tr("Maya style: turn, move, zoom"), "Alt + left, middle, right",
         tr("Hold Alt and drag with a mouse button."));
    held("held.blender", tr("Blender style: turn, move, zoom"), "Middle, Shift+middle, Ctrl+middle",
         tr("Drag with the middle mouse button."));
    held("held.wheel", tr("Zoom"), "Wheel", tr("Towards the model or away from it."));
}

}  // namespace

std::vector<ActionInfo> actionTable() {
    std::vector<ActionInfo> table;
    addFile(table);
    addEdit(table);
    addGroom(table);
    addTools(table);
    addView(table);
    addHelp(table);
    addHeld(table);
    return table;
}

QStringList actionCategories() {
    return {tr("File"), tr("Edit"), tr("Groom"), tr("Tools"), tr("View"), tr("Help")};
}

}  // namespace whorl
