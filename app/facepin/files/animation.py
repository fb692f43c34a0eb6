"""Animated pictures as PNG (APNG).

Not GIF: its 256 colours show as bands on skin, and it knows no half transparency.  APNG holds the very pixels
of the frames, is played by every browser, and is read as its first frame by what does not know it.
"""

import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from facepin.files.safely.atomic import atomic_write


def write_animation(path: Path, frames: Sequence[NDArray[np.uint8]], seconds: float) -> None:
    """Write frames as an animated PNG that repeats for ever.

    Parameters
    ----------
    path : Path
        Ends in .png.
    frames : sequence of (h, w, 3) or (h, w, 4) uint8
        One or more, of one size.
    seconds : float
        How long each is shown.

    Raises
    ------
    FacepinError
        If it cannot be written.
    """
    from PIL import Image

    opaque = all(frame.shape[2] == 3 or (frame[..., 3] == 255).all() for frame in frames)
    pictures = [
        Image.fromarray(np.ascontiguousarray(frame[..., :3] if opaque else frame)) for frame in frames
    ]
    file = io.BytesIO()
    pictures[0].save(
        file,
        "PNG",
        save_all=True,
        append_images=pictures[1:],
        duration=round(1000 * seconds),
        loop=0,
    )
    atomic_write(path, file.getvalue())
