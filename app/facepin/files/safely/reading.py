"""Small files, whole."""

from pathlib import Path

from facepin.core.errors import FacepinError

LARGEST = 2**28
"""Far more than any pose, pins or preferences need."""


def read_bytes(path: Path) -> bytes:
    """Return the content of a small regular file.

    Raises
    ------
    FacepinError
        If there is no such file, it cannot be read, or it is larger than 256 MB.
    """
    try:
        if not path.is_file():
            raise FacepinError(f"{path}: no such file")
        if path.stat().st_size > LARGEST:
            raise FacepinError(f"{path}: {path.stat().st_size} bytes, allowed are {LARGEST}")
        return path.read_bytes()
    except OSError as error:
        raise FacepinError(f"{path}: cannot be read: {error.strerror or error}") from error
