"""What differs from one operating system to another: all of it, and nothing else."""

import os
import shutil
import sys
from collections.abc import Mapping, MutableMapping
from contextlib import suppress
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

SYSTEM = sys.platform
"""The system that this runs on, as Python calls it."""
DIALOG_HELPERS = ("zenity", "kdialog", "matedialog", "qarma")
"""What shows file dialogs on Linux; one of them is enough."""
SHADER_CACHE_OFF = "MESA_SHADER_CACHE_DISABLE"
LEAST_FREE = 64 << 20
"""Bytes that a disk has free where Mesa may keep its shaders."""
FONTS: dict[str, tuple[str, ...]] = {
    "win32": (
        *("segoeui.ttf", "msyh.ttc", "YuGothR.ttc", "meiryo.ttc", "malgun.ttf", "msjh.ttc", "simsun.ttc"),
        *("leelawui.ttf", "tahoma.ttf", "Nirmala.ttc", "Nirmala.ttf", "ebrima.ttf", "gadugi.ttf"),
        *("seguisym.ttf", "seguiemj.ttf", "arialuni.ttf", "arial.ttf"),
    ),
    "darwin": (
        *("Hiragino Sans GB.ttc", "ヒラギノ角ゴシック W3.ttc", "PingFang.ttc", "STHeiti Light.ttc"),
        *("AppleSDGothicNeo.ttc", "Thonburi.ttc", "GeezaPro.ttc", "Kohinoor.ttc", "Apple Symbols.ttf"),
        *("Supplemental/Arial Unicode.ttf", "Supplemental/Arial.ttf"),
    ),
}
"""Files that come with a system, the best first.  Those with coloured letters alone can't be drawn."""


def lock(file: int) -> None:
    """Lock an open file for this process, at once or not at all.

    Raises
    ------
    OSError
        When another process has it, or there are no locks.
    """
    if sys.platform == "win32":
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
    else:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def push(file: int) -> None:
    """Wait until an open file is on the disk; macOS leaves it in the disk's own memory unless asked twice.

    Raises
    ------
    OSError
        When that is impossible.
    """
    if sys.platform != "win32" and SYSTEM == "darwin":
        full: int = getattr(fcntl, "F_FULLFSYNC", 51)
        with suppress(OSError):  # not every file system there knows it
            fcntl.fcntl(file, full)
            return
    os.fsync(file)


def push_folder(path: Path) -> None:
    """Wait until the names in a folder are on the disk: else a power cut can bring an old one back.

    Raises
    ------
    OSError
        When the folder can't be opened.
    """
    if SYSTEM == "win32":  # opens no folders
        return
    folder = os.open(path, os.O_RDONLY)
    try:
        with suppress(OSError):  # some network folders can't, and the file itself is safe
            os.fsync(folder)
    finally:
        os.close(folder)


def has_native_dialogs() -> bool:
    """Say whether the platform's own file dialogs can be shown."""
    return SYSTEM in ("win32", "darwin") or any(shutil.which(name) for name in DIALOG_HELPERS)


def windows_are_measured_in_points() -> bool:
    """Say whether the size of a window is independent of the scale of its screen."""
    return SYSTEM == "darwin"


def has_windowless_contexts() -> bool:
    """Say whether OpenGL works without any screen (EGL on glfw's null platform); else a window is hidden."""
    return SYSTEM not in ("win32", "darwin")


def spare_a_full_disk(environment: MutableMapping[str, str]) -> None:
    """Keep Mesa from storing shaders where there is no room; call it before there is an OpenGL context.

    It maps files into memory that a full disk can't hold, and the system ends a program that touches them.
    """
    if SYSTEM in ("win32", "darwin") or SHADER_CACHE_OFF in environment:
        return
    folder = _shader_cache(environment)
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    try:
        has_room = os.access(folder, os.W_OK) and shutil.disk_usage(folder).free >= LEAST_FREE
    except OSError:
        has_room = False
    if not has_room:
        environment[SHADER_CACHE_OFF] = "true"


def _shader_cache(environment: Mapping[str, str]) -> Path:
    """Return the folder that Mesa takes for its shaders."""
    if chosen := environment.get("MESA_SHADER_CACHE_DIR"):
        return Path(chosen)
    caches = environment.get("XDG_CACHE_HOME") or Path(environment.get("HOME", "/")) / ".cache"
    return Path(caches) / "mesa_shader_cache"


def known_fonts() -> list[Path] | None:
    """Return fonts that come with the system, the best first; None where fontconfig can be asked for all."""
    if SYSTEM not in FONTS:
        return None
    windows = Path(os.environ.get("SYSTEMROOT", "C:/Windows")) / "Fonts"
    mac = [Path("/System/Library/Fonts"), Path("/Library/Fonts")]
    paths = [folder / name for name in FONTS[SYSTEM] for folder in ([windows] if SYSTEM == "win32" else mac)]
    return [path for path in paths if path.is_file()]
