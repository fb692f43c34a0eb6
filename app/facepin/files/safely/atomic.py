"""Files appear whole or not at all: written under a temporary name in the same folder, then renamed."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from secrets import token_hex

from facepin import platforms
from facepin.core.errors import FacepinError

BROKEN = ".broken"
"""What the name of a file that can't be used ends in, once it is set aside."""


def atomic_write(path: Path, content: bytes) -> None:
    """Write `content` to `path`, replacing what is there in one step.

    Raises
    ------
    FacepinError
        If it cannot be written (no such folder, read-only, full disk); what was there before stays as it was.
    """
    with atomic_file(path) as temporary:
        temporary.write_bytes(content)


def make_folder(path: Path) -> None:
    """Make a folder for files to be written to, if it is not there.

    Raises
    ------
    FacepinError
        If it cannot be made.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FacepinError(f"{path}: the folder cannot be made: {error.strerror or error}") from error


@contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Give a temporary path beside `path` to write to; it replaces `path` when the block ends well.

    The temporary name ends in the suffix of `path`, for writers that choose their format by it.

    Raises
    ------
    FacepinError
        As `atomic_write`.
    """
    try:
        target = path.resolve() if path.is_symlink() else path  # a link stays a link
        temporary = target.with_name(f".{target.stem[:40]}-{token_hex(4)}{target.suffix}")
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
        try:
            yield temporary
            _settle(temporary, target)
        finally:
            with suppress(FileNotFoundError):
                temporary.unlink()
    except OSError as error:
        raise FacepinError(f"{path}: cannot be written: {error.strerror or error}") from error


def set_aside(path: Path) -> str:
    """Rename a file that can't be used, so that nothing overwrites it; say so in a few words."""
    aside = path.with_name(path.name + BROKEN)
    try:
        path.replace(aside)
    except OSError as error:
        return f"it could not be set aside either: {error.strerror or error}"
    return f"it is set aside as {aside.name}"


def _settle(temporary: Path, target: Path) -> None:
    """Push the content to the disk, give it the permissions of the file that it replaces, and rename it."""
    with temporary.open("rb+") as file:
        platforms.push(file.fileno())
    if target.exists():
        if not os.access(target, os.W_OK):
            raise PermissionError(0, "it is read-only")
        temporary.chmod(target.stat().st_mode & 0o777)
    temporary.replace(target)
    platforms.push_folder(target.parent)
