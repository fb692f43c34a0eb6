"""A lock that the system itself takes off when its process ends, however it ends."""

import errno
import os
import socket
from contextlib import suppress
from pathlib import Path

from facepin import platforms

_NO_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP}
"""What file systems without locks answer: some network folders."""


class FileLock:
    """A lock file that is held; a window that finds it held leaves alone what it stands for."""

    def __init__(self, path: Path, file: int) -> None:
        self._path = path
        self._file = file

    def release(self) -> None:
        """Take the lock off, and its file away."""
        # While it is held nobody else can hold it, so what is taken away is no one else's.
        with suppress(OSError):  # Windows takes no open file away: then an empty one stays, which is no harm
            self._path.unlink(missing_ok=True)
        os.close(self._file)


def take_lock(path: Path) -> FileLock | None:
    """Take the lock at `path`, made where it is missing; None while another process (or window) holds it.

    Where the file system has no locks, the process that is written in the file says whether it is held.

    Raises
    ------
    OSError
        When the file can't be made.
    """
    file = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
    try:
        platforms.lock(file)
    except OSError as error:
        if error.errno not in _NO_LOCKS or _is_running(os.read(file, 200)):
            os.close(file)
            return None
    if not _is_at(path, file):  # who held it took it away in this moment
        os.close(file)
        return take_lock(path)
    with suppress(OSError):  # a full disk: the lock itself takes no room
        os.ftruncate(file, 0)
        os.write(file, f"{socket.gethostname()} {os.getpid()}\n".encode())
    return FileLock(path, file)


def _is_at(path: Path, file: int) -> bool:
    """Say whether an open file is the one that others find at a path."""
    try:
        return os.path.samestat(path.stat(), os.fstat(file))
    except FileNotFoundError:
        return False


def _is_running(note: bytes) -> bool:
    """Say whether the process of a note in a lock file may still be there."""
    host, _, number = note.decode(errors="replace").strip().rpartition(" ")
    if not host or not number.isdecimal():
        return False
    if host != socket.gethostname():
        return True
    try:
        os.kill(int(number), 0)  # asks only; systems without locks on files are never Windows
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True
