"""The first steps: a line at the bottom of the picture that leads to the first drag, and then goes.

Each step is over once the user did it, or did other things instead: nothing has to be clicked away.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi
from typing import Literal

from imgui_bundle import imgui

from facepin.core.look.camera import Viewport
from facepin.panels.commands import Command, key_of
from facepin.panels.help.key_caps import caps_width, draw_caps
from facepin.panels.theme import PICTURE, packed, tinted
from facepin.session.navigation import Habit

BEAT = 1.1
"""Seconds that one turn of a small picture takes."""
BEATS = 5
"""Turns before it comes to rest: nobody is nagged, and a resting window costs nothing."""
PATIENCE = 4
"""Changes of the pose after which a step that was not followed is over."""

Sign = Literal["press", "drag", "right button"]


@dataclass(frozen=True)
class Hand:
    """What the user has done so far."""

    pins: bool
    posed: bool
    """Some weight is not zero."""
    pin_menu: bool
    undone: bool
    searched: bool
    """The command palette or the keyboard map is open."""
    work: object
    """Another one after each change."""


@dataclass(frozen=True)
class Step:
    """One line of the guide."""

    sign: Sign | Command
    """The small picture before the line, or the command whose key stands there."""
    text: str
    done: Callable[[Hand], bool]


STEPS = (
    Step("press", "Click the face: a pin holds that point", lambda hand: hand.pins or hand.posed),
    Step("drag", "Now drag the pin, the face follows", lambda hand: hand.posed),
    Step("right button", "Right-click a pin for what it can do", lambda hand: hand.pin_menu),
    Step(Command.UNDO, "takes a step back", lambda hand: hand.undone),
    Step(Command.PALETTE, "finds everything else", lambda hand: hand.searched),
)


@dataclass
class Guide:
    """How far the user has come."""

    step: int = 0
    """Number of steps that are over; all of them once the guide has done its work."""
    lively: bool = False
    """Whether the small pictures move."""
    began: float = 0.0
    """When the step began, in seconds of a clock."""
    _changes: int = 0
    _work: object = None

    @property
    def over(self) -> bool:
        """Whether there is nothing left to say."""
        return self.step >= len(STEPS)

    def moving(self, now: float) -> bool:
        """Say whether the small picture moves at a time, so that frames are needed."""
        return self.lively and not self.over and now - self.began < BEATS * BEAT

    def watch(self, hand: Hand, now: float) -> None:
        """Go on where a step was done, or was not followed for a while."""
        if self.over:
            return
        if hand.work is not self._work:
            self._changes += self._work is not None
            self._work = hand.work
        before = self.step
        if self.began == 0.0:
            self.began = now
        while not self.over and (STEPS[self.step].done(hand) or self._tired):
            self.step += 1
            self.began, self._changes = now, 0
        if self.step != before and self.over:
            self._work = None  # a pose that is no longer needed is not kept alive

    @property
    def _tired(self) -> bool:
        return self.step >= 2 and self._changes >= PATIENCE

    def again(self) -> None:
        """Begin anew."""
        self.step, self.began, self._changes = 0, 0.0, 0


def draw_guide(
    guide: Guide, now: float, habit: Habit, viewport: Viewport, pixel_ratio: float, scale: float
) -> None:
    """Draw the line of the step that is due at the bottom of the picture.

    Parameters
    ----------
    guide : Guide
        Which step that is.
    now : float
        Seconds on the clock of `Guide.watch`.
    habit : str
        Whose keys are named.
    viewport : Viewport
        The picture, in framebuffer pixels.
    pixel_ratio, scale : float
        Framebuffer pixels per imgui unit, imgui units per pixel of a 1x screen.
    """
    if guide.over:
        return
    step = STEPS[guide.step]
    line = imgui.get_text_line_height()
    key = key_of(step.sign, habit) if isinstance(step.sign, Command) else ""
    sign = caps_width(key, scale) if key else 2.4 * line
    text = imgui.calc_text_size(step.text).x
    dots = len(STEPS) * 0.6 * line
    gap, pad = 0.7 * line, 0.9 * line
    room = viewport.width / pixel_ratio
    wide, tall = pad + sign + gap + text + pad, 2.2 * line
    count = len(STEPS) if wide + gap + dots < room else 0
    wide += gap + dots if count else 0.0
    if wide > room:
        return  # half a sentence teaches nothing
    left = (viewport.x + viewport.width / 2) / pixel_ratio - wide / 2
    top = (viewport.y + viewport.height) / pixel_ratio - tall - 0.8 * line
    draw = imgui.get_background_draw_list()
    corner, opposite = imgui.ImVec2(left, top), imgui.ImVec2(left + wide, top + tall)
    draw.add_rect_filled(corner, opposite, packed(PICTURE.bar, 0.8), tall / 2)
    draw.add_rect(corner, opposite, packed(tinted(PICTURE.ink, 0.12)), tall / 2, thickness=scale)
    middle = top + tall / 2
    if key:
        draw_caps(draw, left + pad, middle, key, PICTURE, scale)
    else:
        turn = ((now - guide.began) / BEAT) % 1.0 if guide.moving(now) else 0.5
        _sign(draw, str(step.sign), left + pad, middle, sign, line, turn, scale)
    x = left + pad + sign + gap
    draw.add_text(imgui.ImVec2(x, middle - line / 2), packed(PICTURE.text), step.text)
    x += text + gap
    for number in range(count):
        colour = PICTURE.accent if number == guide.step else tinted(PICTURE.text_dim, 0.7)
        at = imgui.ImVec2(x + (number + 0.5) * 0.6 * line, middle)
        draw.add_circle_filled(at, (0.19 if number == guide.step else 0.14) * line, packed(colour), 16)


def _sign(
    draw: imgui.ImDrawList, kind: str, x: float, y: float, wide: float, line: float, turn: float, scale: float
) -> None:
    """Draw a small picture of what the hand does, at a part 0..1 of its motion."""
    accent, pale = packed(PICTURE.accent), packed(tinted(PICTURE.text, 0.75))
    if kind == "press":
        middle = imgui.ImVec2(x + wide / 2, y)
        draw.add_circle_filled(middle, 0.26 * line, accent)
        radius, fading = (0.35 + 0.55 * turn) * line, 1.0 - turn
        draw.add_circle(middle, radius, packed(tinted(PICTURE.accent, fading)), 0, 1.5 * scale)
    elif kind == "drag":
        eased = 0.5 - 0.5 * cos(pi * min(1.5 * turn, 1.0))
        start, end = x + 0.4 * line, x + (0.4 + 1.6 * eased) * line
        draw.add_circle(imgui.ImVec2(start, y), 0.2 * line, pale, 0, 1.5 * scale)
        draw.add_line(imgui.ImVec2(start + 0.2 * line, y), imgui.ImVec2(end, y), accent, 1.5 * scale)
        draw.add_circle_filled(imgui.ImVec2(end, y), 0.26 * line, accent)
    else:
        # A mouse, its right button lit.
        width, height = 0.9 * line, 1.3 * line
        left, top = x + (wide - width) / 2, y - height / 2
        centre, low = left + width / 2, top + 0.55 * height
        lit = packed(tinted(PICTURE.accent, 0.45 + 0.55 * (0.5 - 0.5 * cos(2 * pi * turn))))
        draw.add_rect_filled(
            imgui.ImVec2(centre, top + scale), imgui.ImVec2(left + width - scale, low), lit, 2 * scale
        )
        corner, opposite = imgui.ImVec2(left, top), imgui.ImVec2(left + width, top + height)
        draw.add_rect(corner, opposite, pale, 0.45 * width, thickness=1.5 * scale)
        draw.add_line(imgui.ImVec2(centre, top), imgui.ImVec2(centre, low), pale, scale)
        draw.add_line(imgui.ImVec2(left, low), imgui.ImVec2(left + width, low), pale, scale)
