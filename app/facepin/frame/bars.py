"""What stands around the picture in every frame: menu bar, unsaved work, status line, dialogs."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from imgui_bundle import imgui

from facepin.core.names import readable
from facepin.core.pose import Pose
from facepin.core.shapes.measures import active
from facepin.core.shapes.places import titles
from facepin.desk.desk import Desk
from facepin.files.work.drafts import Leftover
from facepin.frame.part import part
from facepin.panels.help.about import about_window
from facepin.panels.help.keyboard import keyboard_map
from facepin.panels.help.palette import palette
from facepin.panels.menu import menu_bar
from facepin.panels.picture.pin_menu import pin_menu
from facepin.panels.pins import together
from facepin.panels.recovery import WorkRow, recovery_strip
from facepin.panels.requests import CancelJob, CancelLoading, Request
from facepin.panels.status import progress_card, status_line


def bars(desk: Desk, recent: Sequence[Path], seconds: float, scale: float) -> list[Request]:
    """Draw menu bar, unsaved work and status line, and what floats over everything.

    Parameters
    ----------
    desk : Desk
        What is shown.
    recent : sequence of Path
        Rigs opened lately.
    seconds : float
        Time of the last frame.
    scale : float
        imgui units per pixel of a 1x screen.
    """
    session, view = desk.session, desk.view
    left = desk.keeper.left
    spacing = imgui.get_style().item_spacing
    asked: list[Request | None] = []
    with part(desk, "The menus"):
        easier_to_hit = imgui.ImVec2(spacing.x, 2 * spacing.y)
        imgui.push_style_var(imgui.StyleVar_.item_spacing, easier_to_hit)
        asked.append(menu_bar(view, recent, session, has_leftovers=bool(left)))
        imgui.pop_style_var()
    with part(desk, "The list of unsaved work"):
        if left and view.recovery.shown:
            rows = [_work_row(leftover) for leftover in left]
            asked.append(recovery_strip(rows, view.recovery, view.theme))
    timing = f"frame {seconds * 1e3:.1f} ms"
    if session is not None and desk.stage is not None and session.pane.solved is not None:
        solve = sum(pane.solved.seconds for pane in session.panes if pane.solved is not None)
        timing = f"solve {solve * 1e3:.2f} ms   deform {desk.stage.seconds * 1e3:.2f} ms   {timing}"
    rig = session.rig if session else None
    with part(desk, "The status line"):
        status_line(
            rig,
            timing,
            desk.message,
            view.theme,
            is_error=desk.is_error,
            warnings=rig.warnings if rig else (),
            unkept=desk.keeper.complaint,
        )
    if desk.loading is not None and desk.loading.is_long:
        title = readable(f"Opening {desk.loading.path.name}")
        if progress_card(title, desk.loading.fraction, desk.loading.line):
            asked.append(CancelLoading())
    elif desk.job is not None and desk.job.is_long and progress_card(desk.job.title, desk.job.fraction, ""):
        asked.append(CancelJob())
    with part(desk, "The question for a file"):
        if desk.dialog is not None:
            desk.dialog.draw(recent)
    with part(desk, "The menu of a pin"):
        if session is not None:
            asked.append(_pin_popup(desk, session.pose))
    with part(desk, "The command palette"):
        poses = desk.library.poses if desk.library is not None else ()
        asked.append(palette(view, session, recent, poses, scale))
    with part(desk, "Help"):
        if view.keyboard:
            view.keyboard = keyboard_map(view.habit, view.theme, scale)
        if view.about:
            view.about = about_window(desk.graphics, scale)
    return [request for request in asked if request is not None]


def _work_row(leftover: Leftover) -> WorkRow:
    scene = leftover.scene
    name = scene.rig.name if scene.of is None else f"{scene.of.name} ({scene.rig.name})"
    pins, panes = len(scene.pins), len(scene.panes)
    shapes = active(np.array([*scene.panes[scene.active].weights.values()]))
    about = [f"{leftover.time:%d %b %H:%M}"]
    about += [f"{shapes} active"] * (shapes > 0) + [f"{pins} pin{'' if pins == 1 else 's'}"] * (pins > 0)
    about += [f"{panes} panes"] * (panes > 1)
    return WorkRow(leftover.draft.path, readable(name), "  ".join(about))


def _pin_popup(desk: Desk, pose: Pose) -> Request | None:
    """Draw the menu of the pin that was clicked with the right button, while it is open."""
    if desk.view.pin_menu is None:
        return None
    if desk.view.pin_menu_opens:
        imgui.open_popup("pin menu")
        desk.view.pin_menu_opens = False
    pin = next((pin for pin in pose.pins if pin.vertex == desk.view.pin_menu), None)
    if pin is None or not imgui.begin_popup("pin menu"):
        desk.view.pin_menu = None
        return None
    vertices = together(pin, desk.tool.selected)
    title = titles(desk.stage.places, pose.pins)[pin.vertex] if desk.stage is not None else pin.name
    chosen = [other for other in pose.pins if other.vertex in vertices]
    request = pin_menu(pin, chosen, title, desk.view.habit)
    imgui.end_popup()
    return request
