"""Parsed folders, remembered in the user's cache folder: one numpy archive each, always checked."""

import hashlib
import json
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from facepin.core.delta_columns import Delta
from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.core.rig_builder import PartLook, build_rig
from facepin.files.npz.archive import open_archive, texts
from facepin.files.options import Progress
from facepin.files.safely.atomic import atomic_file

VERSION = 2
MOST_ENTRIES = 16
KEYS = (
    *("signature", "neutral", "corners", "face_sizes", "face_parts", "part_names"),
    *("values", "rows", "starts", "names", "warnings", "colours", "part_looks"),
)


def recall(cache: Path, folder: Path, files: list[Path], neutral: Path, progress: Progress) -> Rig | None:
    """Return the rig that was remembered for these very files (names and content), or None.

    An entry that is about other files counts as none; one that is broken is thrown away.
    """
    try:
        with open_archive(_entry(cache, folder)) as archive:
            content = {key: archive.array(archive.member(key)) for key in KEYS}
        if texts(content["signature"]) != [_signature(files, neutral)]:
            return None
    except FileNotFoundError:
        return None
    except (FacepinError, OSError):
        _drop(_entry(cache, folder))
        return None
    progress(0.5, f"{folder.name} was read before")
    try:
        return _rig(content, folder)
    except (FacepinError, ValueError, IndexError, TypeError):
        _drop(_entry(cache, folder))
        return None


def remember(cache: Path, folder: Path, files: list[Path], neutral: Path, rig: Rig) -> None:
    """Store `rig`, unless the cache folder cannot be written; when there are too many, the oldest go."""
    face_parts = np.repeat(np.arange(len(rig.parts)), [len(part.faces) for part in rig.parts])
    with suppress(FacepinError, OSError):
        cache.mkdir(parents=True, exist_ok=True)
        with atomic_file(_entry(cache, folder)) as temporary:
            np.savez(
                temporary,
                signature=np.array([_signature(files, neutral)]),
                neutral=rig.neutral,
                corners=rig.corners,
                face_sizes=rig.face_sizes,
                face_parts=face_parts,
                part_names=np.array([part.name for part in rig.parts]),
                values=rig.deltas.data,
                rows=rig.deltas.indices,
                starts=rig.deltas.indptr,
                names=np.array(rig.file_names),
                warnings=np.array(rig.warnings, dtype=str),
                part_looks=np.array([[*(part.colour or [np.nan] * 3), part.opacity] for part in rig.parts]),
                colours=np.zeros((0, 3), np.float32) if rig.colours is None else rig.colours,
            )
        entries = sorted(cache.glob("*.npz"), key=lambda path: path.stat().st_mtime, reverse=True)
        for old in entries[MOST_ENTRIES:]:
            old.unlink()


def _entry(cache: Path, folder: Path) -> Path:
    return cache / f"{hashlib.sha256(bytes(folder.resolve())).hexdigest()[:24]}.npz"


def _drop(entry: Path) -> None:
    """Take an entry away that can't be used; it is in the way of nothing if it can't be taken away."""
    with suppress(OSError):
        entry.unlink()


def _signature(files: list[Path], neutral: Path) -> str:
    """Return what must be unchanged for an entry to hold.

    Size and time of a file don't say what is in it: programs copy them along, and some write within a tick.
    """
    libraries = sorted(path for path in neutral.parent.iterdir() if path.suffix.lower() == ".mtl")
    facts = [(file.name, _content(file)) for file in [*files, *libraries]]
    return hashlib.sha256(json.dumps([VERSION, neutral.name, facts]).encode()).hexdigest()


def _content(file: Path) -> str:
    with file.open("rb") as opened:
        return hashlib.file_digest(opened, "sha256").hexdigest()


def _looks(content: dict[str, NDArray[Any]]) -> list[PartLook]:
    rows = zip(texts(content["part_names"]), content["part_looks"].tolist(), strict=True)
    return [
        PartLook(
            name,
            None if np.isnan(red) else (red, green, blue),
            opacity=opacity,
            blends=opacity < 1,
        )
        for name, (red, green, blue, opacity) in rows
    ]


def _rig(content: dict[str, NDArray[Any]], folder: Path) -> Rig:
    values, rows, starts = content["values"], content["rows"], content["starts"]
    vertices = len(content["neutral"])

    def shapes() -> Iterator[tuple[str, Delta]]:
        for j, name in enumerate(texts(content["names"])):
            delta = np.zeros(3 * vertices, np.float32)
            delta[rows[starts[j] : starts[j + 1]]] = values[starts[j] : starts[j + 1]]
            yield name, delta.reshape(-1, 3)

    rig = build_rig(
        folder.resolve().name,
        content["neutral"],
        content["corners"],
        content["face_sizes"],
        shapes(),
        parts=_looks(content),
        face_parts=content["face_parts"],
        colours=content["colours"] if len(content["colours"]) else None,
        source=folder,
    )
    return replace(rig, warnings=tuple(texts(content["warnings"])))
