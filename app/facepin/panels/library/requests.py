"""What the library panel can ask for; poses are named by their keys."""

from dataclasses import dataclass


@dataclass(frozen=True)
class SavePose:
    """Store the pose of the active pane."""

    title: str
    tags: tuple[str, ...]


@dataclass(frozen=True)
class ApplyPose:
    """Put a pose on the face, or add it to what is there."""

    key: str
    add: bool = False


@dataclass(frozen=True)
class LabelPose:
    """Give a pose another title and other tags."""

    key: str
    title: str
    tags: tuple[str, ...]


@dataclass(frozen=True)
class MovePose:
    """Put a pose before another one, or last."""

    key: str
    before: str | None


@dataclass(frozen=True)
class ReplacePose:
    """Store the pose of the active pane in the place of a saved one."""

    key: str


@dataclass(frozen=True)
class RemovePoses:
    """Take poses out of the library."""

    keys: tuple[str, ...]


@dataclass(frozen=True)
class ComparePoses:
    """Show the second pose on the face, with the first as the reference and its ghost."""

    first: str
    second: str


@dataclass(frozen=True)
class StopBlending:
    """Give up a blend that is being dragged."""


LibraryRequest = (
    SavePose | ApplyPose | LabelPose | MovePose | ReplacePose | RemovePoses | ComparePoses | StopBlending
)
