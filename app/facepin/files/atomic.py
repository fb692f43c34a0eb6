"""Files appear whole or not at all: written under a temporary name in the same folder, then renamed."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from facepin.core.errors import FacepinError


def atomic_write(path: Path, content: bytes) -> None:
    """Write `content` to `path`, replacing what is there in one step.

    Raises
    ------
    FacepinError
        If it cannot be written (no such folder, read-only, full disk); what was there before stays as it was.
    """
    with atomic_file(path) as temporary:
        temporary.write_bytes(content)


@contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Give a temporary path beside `path` to write to; it replaces `path` when the block ends well.

    The temporary name ends in the suffix of `path`, for writers that choose their format by it.

    Raises
    ------
    FacepinError
        As `atomic_write`.
    """
    temporary: Path | None = None
    try:
        # A link is followed, so that it stays a link.
        target = path.resolve() if path.is_symlink() else path
        handle, name = tempfile.mkstemp(target.suffix, f".{target.stem[:40]}-", target.parent)
        temporary = Path(name)
        os.close(handle)
        yield temporary
        _settle(temporary, target)
    except OSError as error:
        raise FacepinError(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        if temporary is not None:
            with suppress(FileNotFoundError):
                temporary.unlink()


def _settle(temporary: Path, target: Path) -> None:
    """Push the content to the disk, give it the permissions a new or the old file has, and rename it."""
    with temporary.open("rb+") as file:
        os.fsync(file.fileno())
    if target.exists():
        mode = target.stat().st_mode & 0o777
    else:
        umask = os.umask(0)
        os.umask(umask)
        mode = 0o666 & ~umask
    temporary.chmod(mode)
    temporary.replace(target)
