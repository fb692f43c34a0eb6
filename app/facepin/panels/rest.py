"""Whether the mouse rests on something."""

from imgui_bundle import imgui

RESTING = 0.15
"""Seconds until the mouse counts as resting: less than the main loop waits before it looks again."""


class Rest:
    """Remembers what the mouse is on, and since when."""

    def __init__(self) -> None:
        self._on: object = None
        self._since = 0.0

    def on(self, thing: object) -> bool:
        """Say what the mouse is on in this frame (None for nothing); return whether it rests there."""
        if thing != self._on:
            self._on, self._since = thing, imgui.get_time()
        return thing is not None and imgui.get_time() - self._since >= RESTING
