"""The menus of a shape and of a group in the weights panel."""

from collections.abc import Callable

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.rig import Rig
from facepin.core.shapes.mirror import Mirror
from facepin.panels.number_field import number_field
from facepin.panels.picture.overlays import close_on_escape
from facepin.panels.plain_label import plain_label
from facepin.panels.requests import CopyShapes, PairShapes, PasteShapes, Refused, SetControl
from facepin.panels.weights.listing import Group
from facepin.panels.weights.restraints import FLAGS, flags_of, limited, toggled
from facepin.panels.weights.view import WeightsView
from facepin.session.edit import Edit
from facepin.session.hand.sliding import reset, slid

LIMIT_DIGITS = 3
MOST_TWINS = 14
"""Shapes seen at once among those that may be a twin; the others are scrolled to."""
Twins = Callable[[], Mirror]
"""Tells left from right; asked only when that is to be shown, since it may have to be found out."""


def row_menu(
    rig: Rig, control: ShapeControl, weights: Floats, j: int, twins: Twins, view: WeightsView
) -> Edit | SetControl | PairShapes | Refused | None:
    """Draw the inside of the menu of a shape; return what the user changes, or None."""
    name = rig.shape_names[j]
    asked: Edit | SetControl | PairShapes | Refused | None = None
    close_on_escape()
    imgui.text_disabled(name)
    imgui.separator()
    if imgui.menu_item_simple("Reset", "Double click", enabled=bool(weights[j]) and not control.locked[j]):
        asked = Edit(f"Reset {name}", True, weights=slid(weights, {j: 0.0}))
    for flag in FLAGS:
        if imgui.menu_item_simple(flag.capitalize(), selected=bool(flags_of(control, flag)[j])):
            asked = toggled(control, flag, [j], name)
    imgui.separator()
    for at, title in enumerate(("lowest", "highest")):
        imgui.set_next_item_width(5 * imgui.get_font_size())
        limit = number_field(title, float(control.limits[j, at]), LIMIT_DIGITS)
        if isinstance(limit, Refused):
            asked = limit
        elif limit is not None:
            limits = control.limits[j].tolist()
            limits[at] = limit
            asked = limited(control, j, limits, name)
    own = rig.limits[j].tolist()
    differ = own != control.limits[j].tolist()
    if imgui.menu_item_simple(f"Limits of the rig: {own[0]:g} to {own[1]:g}", enabled=differ):
        asked = limited(control, j, own, name)
    imgui.separator()
    if imgui.begin_menu("Twin on the other side"):
        asked = _twin_menu(rig, int(twins().shapes[j]), j, view) or asked
        imgui.end_menu()
    return asked


def _twin_menu(rig: Rig, twin: int, j: int, view: WeightsView) -> PairShapes | None:
    """Draw which shape does the same on the other side of the face; return the user's choice, or None.

    What is typed leaves those in the list whose names have all of its words; Enter takes the first of them.
    """
    asked: PairShapes | None = None
    if imgui.is_window_appearing():
        view.twin_search = ""
        imgui.set_keyboard_focus_here()
    imgui.set_next_item_width(14 * imgui.get_font_size())
    flags = imgui.InputTextFlags_.enter_returns_true
    entered, view.twin_search = imgui.input_text_with_hint("##twin", "Search shapes", view.twin_search, flags)
    found = found_twins(rig, j, view.twin_search)
    if entered and view.twin_search.strip() and found:
        imgui.close_current_popup()
        return PairShapes(j, found[0]) if found[0] != twin else None
    if imgui.menu_item_simple("None", selected=twin < 0) and twin >= 0:
        asked = PairShapes(j, None)
    if imgui.menu_item_simple("Itself: it moves both sides", selected=twin == j) and twin != j:
        asked = PairShapes(j, j)
    imgui.separator()
    rows = min(len(found), MOST_TWINS) + 0.5 * (len(found) > MOST_TWINS)
    height = rows * imgui.get_text_line_height_with_spacing() + imgui.get_style().item_spacing.y
    if imgui.begin_child("twins", imgui.ImVec2(14 * imgui.get_font_size(), max(height, 1.0))):
        for other in found:
            label = plain_label(rig.shape_names[other], other)
            if imgui.menu_item_simple(label, selected=other == twin) and other != twin:
                asked = PairShapes(j, other)
    imgui.end_child()
    if not found:
        imgui.text_disabled("No shape has that name.")
    return asked


def found_twins(rig: Rig, j: int, search: str) -> list[int]:
    """Return the shapes other than j whose names have all words of a search."""
    words = search.lower().split()
    names = enumerate(rig.shape_names)
    return [other for other, name in names if other != j and all(word in name.lower() for word in words)]


def group_menu(
    control: ShapeControl, weights: Floats, group: Group
) -> Edit | SetControl | CopyShapes | PasteShapes | None:
    """Draw the inside of the menu of a group; return what the user changes, or None."""
    asked: Edit | SetControl | CopyShapes | PasteShapes | None = None
    shapes = group.shapes.tolist()
    close_on_escape()
    imgui.text_disabled(f"{group.name.capitalize()}: {len(shapes)} shape{'s' if len(shapes) > 1 else ''}")
    imgui.separator()
    if imgui.menu_item_simple("Reset", enabled=bool(weights[group.shapes].any())):
        asked = group_reset(control, weights, group)
    for flag in FLAGS:
        if imgui.menu_item_simple(
            flag.capitalize(), selected=bool(flags_of(control, flag)[group.shapes].all())
        ):
            asked = toggled(control, flag, shapes, group.name)
    imgui.separator()
    if imgui.menu_item_simple("Copy"):
        asked = CopyShapes(group.name, tuple(shapes))
    if imgui.menu_item_simple("Paste"):
        asked = PasteShapes(group.name, tuple(shapes))
    return asked


def group_reset(control: ShapeControl, weights: Floats, group: Group) -> Edit:
    """Return the edit that puts the shapes of a group to zero, except locked ones."""
    return Edit(f"Reset {group.name}", True, weights=reset(control, weights, group.shapes))
