"""What the list of the weights panel tells about what the mouse rests on."""

from imgui_bundle import imgui

from facepin.core.shapes.measures import percent
from facepin.panels.weights.columns import Zone
from facepin.panels.weights.painter import Painter
from facepin.panels.weights.place import Place
from facepin.panels.weights.view import WeightsView

TOOLTIPS: dict[Zone, str] = {
    "solo": "Solo: only this and other solo shapes move the face",
    "mute": "Mute: keeps its weight, but doesn't move the face",
    "lock": "Lock: no solver and no slider changes it",
    "number": "Double click to type",
}


def explain(painter: Painter, place: Place, view: WeightsView) -> None:
    """Explain what the mouse rests on: a name shows on the face what its shape moves."""
    j = place.line
    rests = view.rest.on((j, place.zone) if isinstance(j, int) else None)
    if not rests or not isinstance(j, int):
        return
    text = TOOLTIPS.get(place.zone)
    if place.zone == "name":
        view.explained, text = j, _about(painter, j)
    if text:
        _tooltip(painter, text, painter.columns.y(place.number))


def _tooltip(painter: Painter, text: str, y: float) -> None:
    """Draw a tooltip left of the list where there is room, so that the rows below can be read."""
    left = painter.columns.left - 3 * imgui.get_style().window_padding.x
    if left - imgui.calc_text_size(text).x > imgui.get_main_viewport().pos.x:
        imgui.set_next_window_pos(imgui.ImVec2(left, y), imgui.Cond_.always, imgui.ImVec2(1.0, 0.0))
    imgui.set_tooltip(text)


def _about(painter: Painter, j: int) -> str:
    """Return what there is to know of a shape."""
    rig, control = painter.rig, painter.control
    low, high = control.limits[j].tolist()
    move = percent(float(rig.largest_moves[j]), rig.height)
    lines = [rig.shape_names[j], f"Moves up to {move:.2g} % of the face height; limits {low:g} to {high:g}"]
    most = painter.limits[j, 1]
    lines += [
        f"Goes as far as {rig.shape_names[b]} does, to {most:.2f} now" for a, b in control.ties if a == j
    ]
    return "\n".join([*lines, "Double click: back to 0", "Right click: lock, mute, solo, limits"])
