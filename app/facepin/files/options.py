"""What a caller may say about opening a file."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

Progress = Callable[[float, str], None]
"""Told how far a long work is: fraction 0..1 and a short line.  Raising from it abandons the work."""


def no_progress(fraction: float, line: str) -> None:
    """Say nothing."""


@dataclass(frozen=True)
class ReadOptions:
    """Handed to every reader."""

    neutral: str | None = None
    """File name of the neutral in a folder, with or without its suffix."""
    progress: Progress = no_progress
    cache_folder: Path | None = None
    """Where parsed folders are remembered, None for not at all."""
