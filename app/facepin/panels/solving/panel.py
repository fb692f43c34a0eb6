"""The solver panel: which solver, what it trades for what, and behind a fold figures for who studies it."""

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from imgui_bundle import imgui

from facepin.core.control import ShapeControl
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.core.shapes.measures import out_of_range, percent
from facepin.panels.requests import UseSolver
from facepin.panels.solving.trade import trade_slider
from facepin.panels.theme import Theme, dim_sentence
from facepin.panels.tiles import shortened
from facepin.panels.view import PaneView
from facepin.session.solving.solving import Solved, SolverChoice
from facepin.session.work import Pane
from facepin.solvers import SOLVERS

HUGE = 10.0
"""A weight beyond this is worth a warning: the face is off the screen."""


def solver_panel(
    rig: Rig, control: ShapeControl, pane: Pane, at: int, view: PaneView, theme: Theme
) -> UseSolver | None:
    """Draw the solver of pane number `at`; return what the user changes in this frame, or None.

    Settings that have words for their ends stand in front while they have an effect; all of them, by their
    own names, are among the details.  `view` is told whether the pane should show how far a radius reaches.
    """
    choice = pane.choice
    view.reach = False
    request = _kinds(at, choice, view)
    for field in _settings(choice, effective=True):
        if field.metadata["ends"] is None:
            continue
        change = trade_slider(field, getattr(choice.settings, field.name))
        if change is not None:
            request = _changed(at, choice, field.name, *change)
    if not choice.kind.obeys_limits:
        changed, keep = imgui.checkbox("Keep within limits", choice.keep_limits)
        imgui.set_item_tooltip("Clip every weight the solver returns to the limits of its shape.")
        if changed:
            request = UseSolver(at, dataclasses.replace(choice, keep_limits=keep))
    if pane.solved is None:
        dim_sentence(choice.kind.summary)
    else:
        _answer(rig, control, pane.pose, pane.solved, theme)
    if _fold():
        request = _details(at, choice, view) or request
        if pane.solved is not None:
            _notes(pane.solved)
    return request


def _kinds(at: int, choice: SolverChoice, view: PaneView) -> UseSolver | None:
    """Draw the list of solvers."""
    request = None
    imgui.set_next_item_width(-1)
    room = imgui.get_content_region_avail().x - imgui.get_frame_height() - imgui.get_style().frame_padding.x
    if imgui.begin_combo("##solver", shortened(choice.kind.title, room)):
        for key, kind in SOLVERS.items():
            if imgui.selectable(kind.title, kind is choice.kind)[0] and kind is not choice.kind:
                request = UseSolver(at, view.choice(key, choice))
            imgui.set_item_tooltip(kind.summary)
        imgui.end_combo()
    imgui.set_item_tooltip(f"{choice.kind.title}\n{choice.kind.summary}")
    return request


def _settings(choice: SolverChoice, *, effective: bool) -> Iterator["dataclasses.Field[Any]"]:
    """Yield the solver's settings: all of them, or those only that have an effect now."""
    for field in dataclasses.fields(choice.settings):
        if not effective or _has_effect(choice, field):
            yield field


def _has_effect(choice: SolverChoice, field: "dataclasses.Field[Any]") -> bool:
    when = field.metadata["when"]
    return when is None or getattr(choice.settings, when[0]) == when[1]


def _changed(at: int, choice: SolverChoice, name: str, value: Any, final: bool) -> UseSolver:
    settings = dataclasses.replace(choice.settings, **{name: value})
    return UseSolver(at, dataclasses.replace(choice, settings=settings), final=final)


def _fold() -> bool:
    """Draw the fold of the details; return whether it is open."""
    imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() - imgui.get_style().frame_padding.x)
    imgui.push_style_color(imgui.Col_.text, imgui.get_style_color_vec4(imgui.Col_.text_disabled))
    is_open = imgui.tree_node_ex("Details", imgui.TreeNodeFlags_.no_tree_push_on_open)
    imgui.pop_style_color()
    return bool(is_open)


def _details(at: int, choice: SolverChoice, view: PaneView) -> UseSolver | None:
    """Draw every setting by its own name and number."""
    request = None
    for field in _settings(choice, effective=False):
        value = getattr(choice.settings, field.name)
        imgui.begin_disabled(not _has_effect(choice, field))
        changed, value = _setting(field.name, field.metadata, value)
        sliding = imgui.is_item_active()
        if field.name == "radius" and (sliding or imgui.is_item_hovered()):
            view.reach = True
        finished = imgui.is_item_deactivated_after_edit()
        imgui.end_disabled()
        if changed or finished:
            request = _changed(at, choice, field.name, value, finished or not sliding)
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
    """Say in a line how near the pins came, and what went too far."""
    outside = out_of_range(pose.weights, control.limits_at(pose.weights))
    largest = float(np.abs(pose.weights).max(initial=0.0))
    imgui.text_disabled("pins off by")
    imgui.set_item_tooltip(
        f"Mean distance of the pins from their goals, in % of the face's height: {solved.pin_error:.4g}"
        " in the rig's unit."
    )
    imgui.same_line()
    imgui.text(f"{percent(solved.pin_error, rig.height):.2f} %")
    if outside:
        imgui.same_line()
        far = f"up to {largest:,.0f}" if largest > HUGE else "out of range"
        imgui.text_colored(imgui.ImVec4(*theme.warning), f"  {outside} {far}")
        imgui.set_item_tooltip("Weights beyond the limits of their shapes.")


def _notes(solved: Solved) -> None:
    """List what the last solve was like, two figures in a line."""
    figures = {"solve": f"{solved.seconds * 1e3:.2f} ms"}
    figures |= {name: f"{value:.4g}" for name, value in solved.notes.items()}
    if imgui.begin_table("figures", 4, imgui.TableFlags_.sizing_stretch_prop):
        for share in (26, 24, 24, 26):  # fixed: digits that change must not make columns dance
            imgui.table_setup_column("", imgui.TableColumnFlags_.width_stretch, share)
        for name, value in figures.items():
            imgui.table_next_column()
            imgui.text_disabled(name)
            imgui.table_next_column()
            imgui.text(value)
        imgui.end_table()
