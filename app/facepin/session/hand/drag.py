"""The drag tool: turns what mouse and keys do over the face into edits of the pins."""

from collections.abc import Collection
from dataclasses import dataclass, field, replace

from facepin.core.events import (
    Event,
    KeyPressed,
    KeyReleased,
    PointerMoved,
    PointerPressed,
    PointerReleased,
    Scrolled,
)
from facepin.core.pose import Pin
from facepin.session.edit import Edit
from facepin.session.hand.aim import Aim, aim_at
from facepin.session.hand.box import span
from facepin.session.hand.course import SLACK, Axis, Course
from facepin.session.hand.gesture import Gesture
from facepin.session.hand.hold import Hold, take
from facepin.session.hand.mirroring import with_twins
from facepin.session.hand.moving import movable
from facepin.session.hand.nudge import Nudge, Step, step_of
from facepin.session.hand.sight import Pixel, Sight, pin_at
from facepin.session.hand.stroke import sketch


@dataclass
class DragTool:
    """Holds what lasts from press to release, and which pins are selected or under the mouse."""

    selected: frozenset[int] = frozenset()
    """Vertices of the selected pins."""
    hovered: int | None = None
    """Vertex of the pin under the mouse."""
    aim: Aim | None = None
    """What a press would take where no pin is under the mouse."""
    gesture: Gesture | None = None
    """What is going on from press to release."""
    radius: float = 0.0
    """How far along the skin a drag carries other pins along, as a share of the face height."""
    remark: str = ""
    """Something to say to the user; who says it empties it."""
    _before: frozenset[int] = frozenset()
    """What was selected when the gesture began."""
    _nudge: Nudge | None = field(default=None)
    _course: Course | None = None
    """The way of the mouse while pins are in the hand."""
    _preferred: str = ""
    """The region that was chosen where two are under the mouse."""
    _pointed: Pixel | None = None
    """Where the mouse was last without a button held."""
    _began: Sight | None = field(default=None)
    """What was seen when pins began to be moved: their twins start from there too."""

    @property
    def holding(self) -> bool:
        """Whether a gesture is going on: it then gets all pointer events until the release."""
        return self.gesture is not None

    @property
    def held(self) -> frozenset[int]:
        """Vertices of the pins in the hand."""
        if not isinstance(self.gesture, Hold):
            return frozenset()
        return self.gesture.vertices | self.gesture.along.keys()

    @property
    def nudging(self) -> bool:
        """Whether keys have moved pins and may go on to: `settle` ends that after a while."""
        return self._nudge is not None

    def handle(self, event: Event, sight: Sight) -> Edit | None:
        """Take one event; return what it changes, or None.  With a mirror, twins of pins do the same.

        A press on nothing takes no hold, so that the caller can give it to the camera.  Esc ends what is
        going on, the caller then cancels the session's gesture; else it takes the selection away.
        """
        if self.gesture is None and self._nudge is None:
            self._began = sight
        return self._with_twins(self._handled(event, sight))

    def _handled(self, event: Event, sight: Sight) -> Edit | None:
        match event:
            case PointerPressed(button="left") if self.gesture is None:
                return self._press(event, sight)
            case PointerMoved(x, y, modifiers) if self.gesture is not None:
                pixel = self._led((x, y), fine=modifiers.shift)
                return self._listened(self.gesture, self.gesture.move(pixel))
            case PointerReleased(x, y, "left") if self.gesture is not None:
                pixel = self._led((x, y))
                gesture, self.gesture, self._course = self.gesture, None, None
                return self._listened(gesture, gesture.release(pixel))
            case Scrolled(steps=steps) if isinstance(self.gesture, Hold) and self._course is not None:
                self.gesture.widen(steps)
                self.radius = self.gesture.radius
                return self._listened(self.gesture, self.gesture.move(self._course.pixel))
            case PointerMoved(x, y):
                self._pointed = (x, y)
                self.hovered, self.aim = self._under((x, y), sight)
            case KeyPressed(key="x" | "y" as axis) if self._course is not None and self.gesture is not None:
                self._course.axis = axis
                return self._listened(self.gesture, self.gesture.move(self._course.pixel))
            case KeyReleased(key="x" | "y" as axis) if self._course is not None and self.gesture is not None:
                if self._course.axis != axis:
                    return None
                self._course.axis = None
                return self._listened(self.gesture, self.gesture.move(self._course.pixel))
            case KeyPressed(key="tab") if self.gesture is None and self._pointed is not None:
                self._choose(sight)
            case KeyPressed(key="escape"):
                self._give_up()
            case KeyPressed(key) if self.gesture is None and (step := step_of(event)) is not None:
                return self._nudged(key, step, sight)
            case KeyReleased(key) if self._nudge is not None:
                self._nudge.release(key)
        return None

    @property
    def line(self) -> tuple[Axis, Pixel] | None:
        """The axis that the drag is kept on and where the press was, while a key asks for it."""
        course = self._course
        return None if course is None or course.axis is None else (course.axis, course.pressed)

    def look_away(self) -> None:
        """Forget what is under the mouse: it is elsewhere, or the face is seen from elsewhere."""
        self.hovered = self.aim = self._pointed = None

    def _led(self, pixel: Pixel, *, fine: bool | None = None) -> Pixel:
        return pixel if self._course is None else self._course.lead(pixel, fine=fine)

    def _under(self, pixel: Pixel, sight: Sight) -> tuple[int | None, Aim | None]:
        """Return the pin under a pixel, or what a press there would take."""
        pin, places = pin_at(sight, pixel), sight.places
        if pin is not None and self._preferred in ("", places.region(pin)):
            return pin, None
        aim = aim_at(sight, pixel, self._preferred)
        chosen = aim is not None and places.region(aim.vertices[0]) == self._preferred
        if not chosen:
            self._preferred = ""
        return (None, aim) if chosen or pin is None else (pin, None)

    def _choose(self, sight: Sight) -> None:
        """Go on to the next of what is under the mouse: from the upper lip to the lower one."""
        if self._pointed is None:
            return
        here = self.hovered
        if here is None and self.aim is not None:
            here = self.aim.vertices[0]
        aim = aim_at(sight, self._pointed, "" if here is None else sight.places.region(here))
        if aim is not None and len(aim.vertices) > 1:
            self._preferred = sight.places.region(aim.vertices[1])
            self.hovered, self.aim = self._under(self._pointed, sight)

    def begin(self, gesture: Gesture) -> None:
        """Go on with a gesture that began on something else than the face or a pin."""
        self._before, self.gesture = self.selected, gesture

    def settle(self, now: float) -> Edit | None:
        """Return what keys have moved as one undo step, once they rest; `now` is a clock in seconds."""
        return self.finish() if self._nudge is not None and self._nudge.rests(now) else None

    def finish(self) -> Edit | None:
        """Return what keys have moved as one undo step, at once."""
        nudge, self._nudge = self._nudge, None
        return self._with_twins(nudge.edit(final=True)) if nudge is not None else None

    def forget_gone(self, pins: Collection[Pin]) -> None:
        """Select no pins but those that are there."""
        there = {pin.vertex for pin in pins}
        if not self.selected <= there:
            self.selected &= there
        if self.hovered not in there:
            self.hovered = None

    def _with_twins(self, edit: Edit | None) -> Edit | None:
        """Let the twins of the pins that an edit places or moves do the same."""
        began = self._began
        if edit is None or edit.pins is None or began is None or began.mirror is None:
            return edit
        pins = with_twins(began.mirror, began.pose.pins, edit.pins, began.positions)
        return replace(edit, pins=pins)

    def _press(self, event: PointerPressed, sight: Sight) -> Edit | None:
        """Begin the gesture that fits what is under the mouse, if anything is."""
        pixel, adds = (event.x, event.y), event.modifiers.shift
        self._before = self.selected
        if event.modifiers.control:
            self.gesture = span(pixel, sight, self.selected, adds=adds)
            return None
        vertex, aim = self._under(pixel, sight)
        self.aim = None
        if vertex is None and (hit := sight.hit(pixel)) is not None:
            vertex = hit.vertex if aim is None else aim.vertices[0]
            if sight.stroke is not None:
                self.gesture = sketch(pixel, sight.stroke, sight, self.selected if adds else frozenset())
                return None
            if aim is None:
                self.remark = sight.places.unmoved(vertex)
                vertex = None  # to the hand it is as if nothing were there
        if vertex is None:
            if adds or sight.beside:
                self.gesture = span(pixel, sight, self.selected, adds=adds, keeps=adds)
            return None
        hold = take(vertex, pixel, sight, self.selected, adds=adds)
        hold.radius = self.radius
        self.gesture = hold
        self._course = Course(pixel, SLACK * sight.scale if sight.steady else 0.0, coarse=adds)
        return self._listened(hold, Edit("Place pin", False, hold.pins) if hold.placed else None)

    def _listened(self, gesture: Gesture, edit: Edit | None) -> Edit | None:
        """Take over what a gesture selects and remarks; pass its edit on."""
        self.selected = gesture.selected
        self.remark, gesture.remark = gesture.remark or self.remark, ""
        return edit

    def _give_up(self) -> None:
        if self.gesture is not None:
            self.gesture, self.selected, self._course = None, self._before, None
        elif self._nudge is not None:
            self._nudge = None
        else:
            self.selected = frozenset()

    def _nudged(self, key: str, step: Step, sight: Sight) -> Edit | None:
        """Move the selected pins by a press of a key."""
        if not self.selected:
            return None
        vertices = movable(sight.pose.pins, self.selected)
        if not vertices:
            self.remark = "The selected pins are locked or hidden, and stay where they are"
            return None
        nudge = self._nudge or Nudge(sight.pose.pins, vertices)
        if not nudge.move(step, sight):
            self.remark = "Pins on screen have no depth of their own: only pins in space move along the view"
            return None
        nudge.keys.add(key)
        self._nudge = nudge
        return nudge.edit(final=False)
