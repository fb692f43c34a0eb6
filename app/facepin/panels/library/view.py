"""How the library is shown, and what the hand is doing in it."""

from dataclasses import dataclass, field
from typing import Literal

from facepin.core.saved_pose import SavedPose

GAP = 8.0
"""Between pictures, at 1x scale."""


@dataclass
class LibraryView:
    """How the library is shown and what is being done with it; not part of the work."""

    search: str = ""
    selected: tuple[str, ...] = ()
    """Keys, in the order in which they were selected."""
    saving: bool = False
    """The line for a new pose is open."""
    labelled: str | None = None
    """Key of the pose that is being named."""
    title: str = ""
    tags: str = ""
    """What is typed."""
    focus: bool = False
    pressed: tuple[str, float, float] | None = None
    """The pose the mouse went down on, and where."""
    gesture: Literal["", "blend", "move"] = ""
    amount: float = 0.0
    cells: list[tuple[str, float, float, float, float]] = field(default_factory=list)
    """Pictures of this frame: key, left, top, right, bottom."""

    def begin_saving(self, title: str) -> None:
        """Open the line for a new pose."""
        self.saving, self.labelled, self.title, self.tags, self.focus = True, None, title, "", True

    def begin_labelling(self, pose: SavedPose) -> None:
        """Open the line for the name and tags of a pose."""
        self.saving, self.labelled, self.focus = False, pose.key, True
        self.title, self.tags = pose.title, ", ".join(pose.tags)

    def done(self) -> None:
        """Close the line."""
        self.saving, self.labelled = False, None
