"""The title of one of several panes: its solver, how it does, and what the pane shows."""

import dataclasses
from collections.abc import Iterator
from contextlib import contextmanager

from imgui_bundle import imgui

from facepin.core.look.camera import Viewport
from facepin.core.names import brief
from facepin.panels import layout
from facepin.panels.commands import Command
from facepin.panels.picture.overlays import close_on_escape, overlay_items
from facepin.panels.requests import ClosePane, KeepPane, Request, UseSolver
from facepin.panels.theme import PICTURE, VEIL, Colour, packed, pop_picture_colours, push_picture_colours
from facepin.panels.tiles import shortened
from facepin.panels.view import PaneView
from facepin.session.appraisal import Appraisal
from facepin.session.navigation import Habit
from facepin.session.solving.solving import SolverChoice
from facepin.session.work import Pane
from facepin.solvers import SOLVERS

LOW = 28.0
"""Height of a pane, in letters, below which its title is a single line: the face needs the room."""
HELP = (
    "Click: solver, overlays, keep or close this pane\n"
    "pins: mean distance of the pins from their goals, far: largest move of a vertex that should rest,\n"
    "both in per cent of the face height; then the time of the last solve."
)
PADDING = 12.0
"""Between a title and the right of its pane, at 1x scale."""
REFERENCE_HELP = "The pose that the others are measured against\nClick: overlays, close this pane"


def pane_title(
    at: int,
    pane: Pane,
    appraisal: Appraisal,
    view: PaneView,
    place: Viewport,
    pixel_ratio: float,
    scale: float,
    *,
    colour: Colour,
    habit: Habit,
    active: bool,
    has_reference: bool,
    reference_shown: bool,
) -> list[Request]:
    """Draw a pane's title and frame; return what the user asks for.

    Parameters
    ----------
    at : int
        Number of the pane.
    pane, appraisal
        What is shown, and how it was measured.
    view : PaneView
        Overlays, changed in place.
    place : Viewport
        Where the pane is, in framebuffer pixels.
    pixel_ratio, scale : float
        Framebuffer pixels per imgui unit, imgui units per pixel of a 1x screen.
    colour : Colour
        The pane's.
    habit : str
        Whose keys the menu shows.
    active : bool
        Whether its numbers are the ones that the panels show.
    has_reference : bool
        Whether there is a pose to compare with.
    reference_shown : bool
        Whether it has a pane of its own.
    """
    asked: list[Request] = []
    with _sign(f"{at}", view, place, pixel_ratio, scale, colour=colour, active=active) as (right, low):
        title, settings = pane.choice.kind.title, _short(pane.choice)
        room = right - imgui.get_cursor_screen_pos().x
        _button(title if _fits(title, room) and not low else brief(title), room, view, colour)
        imgui.set_item_tooltip("\n".join(filter(None, (title, settings, HELP))))
        if (
            settings
            and not low
            and _fits(settings, right - imgui.get_item_rect_max().x - 3 * PADDING * scale)
        ):
            imgui.same_line()
            imgui.text_disabled(settings)
        _figures(pane, appraisal, right if low else 0.0)
        pop_picture_colours()
        if imgui.begin_popup("pane"):
            asked += _menu(
                at, pane, view, habit, has_reference=has_reference, reference_shown=reference_shown
            )
            imgui.end_popup()
        push_picture_colours()
    return asked


def reference_title(
    shapes: int, view: PaneView, place: Viewport, pixel_ratio: float, scale: float, habit: Habit
) -> list[Request]:
    """Draw the title of the pane of the reference, which has so many active shapes; as `pane_title`."""
    asked: list[Request] = []
    ink = PICTURE.text
    with _sign("reference", view, place, pixel_ratio, scale, colour=ink, active=False) as (right, low):
        _button("Reference", right - imgui.get_cursor_screen_pos().x, view, ink)
        imgui.set_item_tooltip(REFERENCE_HELP)
        if low:
            imgui.same_line()
        imgui.text_colored(imgui.ImVec4(*PICTURE.text), f"{shapes} active")
        pop_picture_colours()
        if imgui.begin_popup("pane"):
            close_on_escape()
            overlay_items(view, habit, has_reference=False)
            imgui.separator()
            if imgui.menu_item_simple("Close"):
                asked.append(Command.SHOW_REFERENCE)
            imgui.end_popup()
        push_picture_colours()
    return asked


@contextmanager
def _sign(
    name: str,
    view: PaneView,
    place: Viewport,
    pixel_ratio: float,
    scale: float,
    *,
    colour: Colour,
    active: bool,
) -> Iterator[tuple[float, bool]]:
    """Frame a pane and begin its title; yield how far to the right it may go, and whether the pane is low."""
    left, top = place.x / pixel_ratio, place.y / pixel_ratio
    right, bottom = left + place.width / pixel_ratio, top + place.height / pixel_ratio
    draw = imgui.get_background_draw_list()
    draw.add_rect_filled(
        imgui.ImVec2(left, top), imgui.ImVec2(right, top + 3 * scale), packed(colour, 1.0 if active else 0.55)
    )
    if active:
        inset = 0.5 * scale
        draw.add_rect(
            imgui.ImVec2(left + inset, top + inset),
            imgui.ImVec2(right - inset, bottom - inset),
            packed(colour, 0.8),
            0.0,
            scale,
        )
    imgui.set_next_window_pos(imgui.ImVec2(left + 4 * scale, top + 5 * scale))
    imgui.set_next_window_size_constraints(
        imgui.ImVec2(0, 0), imgui.ImVec2(max(right - left - 8 * scale, 1), max(bottom - top, 1))
    )
    imgui.set_next_window_bg_alpha(VEIL)
    push_picture_colours()
    imgui.push_style_var(imgui.StyleVar_.window_border_size, 0)
    # Only its button is in the hand's way: the rest of it may lie over pins.
    flags = 0 if view.title_hovered else imgui.WindowFlags_.no_mouse_inputs
    imgui.begin(f"##pane {name}", None, layout.SIGN | flags)
    imgui.pop_style_var()
    yield right - PADDING * scale, bottom - top < LOW * imgui.get_font_size()
    pop_picture_colours()
    imgui.end()


def _button(title: str, room: float, view: PaneView, colour: Colour) -> None:
    """Draw the button that opens the menu; `view` is told whether the mouse is on it."""
    imgui.push_style_color(imgui.Col_.text, imgui.ImVec4(*colour))
    if imgui.small_button(f"{shortened(title, room)}##title"):
        imgui.open_popup("pane")
    imgui.pop_style_color()
    view.title_hovered = imgui.is_mouse_hovering_rect(imgui.get_item_rect_min(), imgui.get_item_rect_max())


def _fits(text: str, room: float) -> bool:
    return bool(imgui.calc_text_size(text).x + 2 * imgui.get_style().frame_padding.x <= room)


def _short(choice: SolverChoice) -> str:
    """Settings that are others than usual, in a few words; those that have no effect now are left out."""
    words = []
    for field in dataclasses.fields(choice.settings):
        when = field.metadata["when"]
        value = getattr(choice.settings, field.name)
        if value == field.default or (when is not None and getattr(choice.settings, when[0]) != when[1]):
            continue
        name = field.name.replace("_", " ")
        if isinstance(value, bool):
            words.append(name if value else f"not {name}")
        else:
            words.append(f"{name} {value:.3g}" if isinstance(value, float) else f"{name} {value}")
    return ", ".join(words + ["within limits"] * choice.keep_limits)


def _figures(pane: Pane, appraisal: Appraisal, right: float) -> None:
    """Say how far off, how calm, how many; what is out of range stands out.

    In two lines below the title, or beside it as far as `right`, where that is not 0.
    """
    errors = [f"pins {appraisal.pin_error:.2f} %", f"far {appraisal.far_motion:.2f} %"]
    if pane.solved is not None and right == 0:
        errors.append(f"{pane.solved.seconds * 1e3:.2f} ms")
    figures = [(text, PICTURE.text) for text in (*errors, f"{appraisal.active} active")]
    if appraisal.out_of_range:
        figures.append((f"{appraisal.out_of_range} out of range", PICTURE.warning))
    if appraisal.e_rms is not None:
        figures.append((f"E_RMS {appraisal.e_rms:.3f}", PICTURE.text))
    for at, (text, colour) in enumerate(figures):
        beside = imgui.get_item_rect_max().x + imgui.get_style().item_spacing.x
        if at not in (0, len(errors)) if right == 0 else beside + imgui.calc_text_size(text).x <= right:
            imgui.same_line()
        imgui.text_colored(imgui.ImVec4(*colour), text)


def _menu(
    at: int, pane: Pane, view: PaneView, habit: Habit, *, has_reference: bool, reference_shown: bool
) -> list[Request]:
    asked: list[Request] = []
    close_on_escape()
    for key, kind in SOLVERS.items():
        if imgui.menu_item_simple(kind.title, selected=kind is pane.choice.kind):
            asked.append(UseSolver(at, view.choice(key, pane.choice)))
    imgui.separator()
    overlay_items(view, habit, has_reference=has_reference)
    imgui.separator()
    if has_reference and imgui.menu_item_simple(Command.SHOW_REFERENCE.title, selected=reference_shown):
        asked.append(Command.SHOW_REFERENCE)
    if imgui.menu_item_simple("Keep this one"):
        asked.append(KeepPane(at))
    if imgui.menu_item_simple("Close"):
        asked.append(ClosePane(at))
    return asked
