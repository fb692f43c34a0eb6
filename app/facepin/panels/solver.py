"""The solver panel: which solver, its own settings, and what its last answer was like."""

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np
from imgui_bundle import imgui

from facepin.core.control import ShapeControl
from facepin.core.measures import out_of_range
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.panels.requests import UseSolver
from facepin.panels.theme import Theme, dim_sentence
from facepin.panels.view import PaneView
from facepin.session.session import Pane
from facepin.session.solving import Solved
from facepin.solvers import SOLVERS

HUGE = 10.0
"""A weight beyond this is worth a warning: the face is off the screen."""


def solver_panel(
    rig: Rig, control: ShapeControl, pane: Pane, at: int, view: PaneView, theme: Theme
) -> UseSolver | None:
    """Draw the solver of pane number `at`; return what the user changes in this frame, or None.

    `view` is told whether the pane should show how far a radius reaches.
    """
    choice = pane.choice
    view.reach = False
    request = None
    imgui.set_next_item_width(-1)
    if imgui.begin_combo("##solver", choice.kind.title):
        for key, kind in SOLVERS.items():
            if imgui.selectable(kind.title, kind is choice.kind)[0] and kind is not choice.kind:
                request = UseSolver(at, view.choice(key, choice))
            imgui.set_item_tooltip(kind.summary)
        imgui.end_combo()
    imgui.set_item_tooltip(choice.kind.summary)
    for field in dataclasses.fields(choice.settings):
        value = getattr(choice.settings, field.name)
        when = field.metadata["when"]
        imgui.begin_disabled(when is not None and getattr(choice.settings, when[0]) != when[1])
        changed, value = _setting(field.name, field.metadata, value)
        sliding = imgui.is_item_active()
        if field.name == "radius" and (sliding or imgui.is_item_hovered()):
            view.reach = True
        finished = imgui.is_item_deactivated_after_edit()
        imgui.end_disabled()
        if changed or finished:
            settings = dataclasses.replace(choice.settings, **{field.name: value})
            changed_choice = dataclasses.replace(choice, settings=settings)
            request = UseSolver(at, changed_choice, final=finished or not sliding)
    if not choice.kind.obeys_limits:
        imgui.set_cursor_pos_x(_column())
        changed, keep = imgui.checkbox("keep within limits", choice.keep_limits)
        imgui.set_item_tooltip("Clip every weight the solver returns to the limits of its shape.")
        if changed:
            request = UseSolver(at, dataclasses.replace(choice, keep_limits=keep))
    imgui.separator()
    if pane.solved is None:
        dim_sentence(f"{choice.kind.summary} Its figures appear here with the first drag.")
    else:
        _answer(rig, control, pane.pose, pane.solved, theme)
    return request


def _column() -> float:
    """Return where the controls begin: names are left of them, as in the list of weights."""
    return 0.35 * imgui.get_window_width()


def _setting(name: str, about: Mapping[str, Any], value: Any) -> tuple[bool, Any]:
    """Draw one setting by its declared type and range; return (changed, value)."""
    title = name.replace("_", " ")
    changed: bool
    new: Any
    if isinstance(value, bool):
        imgui.set_cursor_pos_x(_column())
        changed, new = imgui.checkbox(title, value)
        imgui.set_item_tooltip(about["help"])
        return changed, new
    imgui.align_text_to_frame_padding()
    imgui.text(title)
    imgui.set_item_tooltip(about["help"])
    imgui.same_line(_column())
    imgui.set_next_item_width(-1)
    if about["choices"]:
        words = list(about["choices"])
        changed, at = imgui.combo(f"##{name}", words.index(value), words)
        new = words[at]
    elif isinstance(value, int):
        changed, new = imgui.slider_int(f"##{name}", value, int(about["low"]), int(about["high"]))
    else:
        flags = imgui.SliderFlags_.always_clamp
        if about["log"]:
            flags |= imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.no_round_to_format
        shown = "%.4g" if about["log"] else "%.3f"
        changed, new = imgui.slider_float(f"##{name}", value, about["low"], about["high"], shown, flags)
    imgui.set_item_tooltip(about["help"])
    return changed, new


def _answer(rig: Rig, control: ShapeControl, pose: Pose, solved: Solved, theme: Theme) -> None:
    """Draw what the last solve was like: two figures in a line, so that sliders have the room."""
    outside = out_of_range(pose.weights, control.limits_at(pose.weights))
    largest = float(np.abs(pose.weights).max(initial=0.0))
    figures = {
        "solve": (f"{solved.seconds * 1e3:.2f} ms", "Time of the last solve."),
        "pin error": (
            f"{100 * solved.pin_error / rig.height:.2f} %",
            f"Mean distance of the pins from their goals, in % of the face's height: {solved.pin_error:.4g}"
            " in the rig's unit.",
        ),
        "out of range": (f"{outside}", "How many weights are beyond the limits of their shapes."),
    }
    if largest > HUGE:
        figures["largest"] = f"{largest:,.0f}", "The largest weight: the face is far beyond its shapes."
    figures |= {name: (f"{value:.4g}", "") for name, value in solved.notes.items()}
    if imgui.begin_table("figures", 4, imgui.TableFlags_.sizing_stretch_prop):
        for share in (26, 24, 24, 26):  # fixed: digits that change must not make columns dance
            imgui.table_setup_column("", imgui.TableColumnFlags_.width_stretch, share)
        for name, (value, help) in figures.items():
            imgui.table_next_column()
            imgui.text_disabled(name)
            if help:
                imgui.set_item_tooltip(help)
            imgui.table_next_column()
            if (name == "out of range" and outside) or name == "largest":
                imgui.text_colored(imgui.ImVec4(*theme.warning), value)
            else:
                imgui.text(value)
        imgui.end_table()
