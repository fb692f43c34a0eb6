"""The history window: every undo step by its label; a click goes there."""

from collections.abc import Sequence

import numpy as np
from imgui_bundle import imgui

from facepin.core.rig import Rig
from facepin.panels.plain_label import plain_label
from facepin.panels.requests import GoToStep
from facepin.panels.theme import Theme
from facepin.session.history import Step
from facepin.session.work import Work

TITLE = "History"
SIZE = (290.0, 330.0)
"""Width and height at first, in pixels at 1x scale."""
NOTEWORTHY = 0.005
"""A weight that changed by less is not spoken of."""


def history_window(
    rig: Rig, steps: Sequence[Step[Work]], at: int, scale: float, theme: Theme
) -> tuple[bool, GoToStep | None]:
    """Draw the history; return whether it stays open, and the step that the user clicked.

    Parameters
    ----------
    rig : Rig
        Names the shapes.
    steps : sequence of Step
        From the first; those after `at` are undone.
    at : int
        The current one.
    scale : float
        imgui units per pixel of a 1x screen.
    theme : Theme
        Colours.
    """
    imgui.set_next_window_size(imgui.ImVec2(SIZE[0] * scale, SIZE[1] * scale), imgui.Cond_.first_use_ever)
    shown, stays = imgui.begin(TITLE, True)
    asked: GoToStep | None = None
    if shown:
        storage, now = imgui.get_state_storage(), imgui.get_id("now")
        if storage.get_int(now, -1) != at:  # what is current now comes into sight
            storage.set_int(now, at)
            row = imgui.get_text_line_height_with_spacing()
            imgui.set_scroll_y(max((at + 0.5) * row - imgui.get_window_height() / 2, 0.0))
        clipper = imgui.ListClipper()
        clipper.begin(len(steps))
        while clipper.step():
            for number in range(clipper.display_start, clipper.display_end):
                if _row(rig, steps, number, at, theme):
                    asked = GoToStep(number)
    imgui.end()
    return bool(stays), asked


def _row(rig: Rig, steps: Sequence[Step[Work]], number: int, at: int, theme: Theme) -> bool:
    """Draw one step; return whether it was clicked."""
    colour = theme.accent if number == at else theme.text if number < at else theme.text_dim
    imgui.push_id(number)
    imgui.push_style_color(imgui.Col_.text, imgui.ImVec4(*colour))
    label = f"{number:>3}  {steps[number].label}"
    clicked = imgui.selectable(plain_label(label, number), number == at)[0]
    imgui.pop_style_color()
    if number > at and imgui.is_item_hovered():
        imgui.set_tooltip("Undone; a click brings it back")
    detail = _change(rig, steps[number - 1], steps[number]) if number else ""
    style, gap = imgui.get_style(), imgui.calc_text_size("  ").x
    right = imgui.get_window_width() - style.window_padding.x - style.scrollbar_size
    right -= imgui.calc_text_size(detail).x
    if detail and right > style.window_padding.x + imgui.calc_text_size(label).x + gap:
        imgui.same_line(right)
        imgui.text_disabled(detail)
    imgui.pop_id()
    return bool(clicked) and number != at


def _change(rig: Rig, before: Step[Work], step: Step[Work]) -> str:
    """Return which weight a step changed most, and by how much; empty where it changed none."""
    changes = [
        new.pose.weights - old.pose.weights
        for new, old in zip(step.value.panes, before.value.panes, strict=False)
        if new.pose.weights is not old.pose.weights
    ]
    if not changes or not rig.shape_count:
        return ""
    change = max(changes, key=lambda change: float(np.abs(change).max()))
    j = int(np.argmax(np.abs(change)))
    if abs(change[j]) < NOTEWORTHY:
        return ""
    name = rig.shape_names[j]
    return f"{change[j]:+.2f}" if name in step.label else f"{name} {change[j]:+.2f}"
