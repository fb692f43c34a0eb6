"""Rigs from numpy archives.  Headers are checked before anything is inflated; nothing is ever unpickled."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from facepin.core.delta_columns import Delta
from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.core.rig_builder import Pair, PartLook, build_rig
from facepin.files.npz.archive import Archive, Member, open_archive, texts
from facepin.files.options import ReadOptions


def read_npz(path: Path, options: ReadOptions) -> Rig:
    """Read a rig from `neutral` (n, 3), `faces` (m, 3 or 4; -1 fills up) and `deltas` (k, n, 3).

    Optional: `names` (k); `part` (n) with `part_names`, or `region` with `region_names`: the part of every
    vertex, a face belongs to that of its first corner; `part_colours` and `part_mats` (roughness first), a
    row per part; `colors` or `colours` (n, 3); `weights` (k).  Colours are sRGB, 0..1 or bytes.  What does
    not fit is left out with a warning.

    Optional too, but refused where they do not fit, since the face would look wrong without: `combo_pairs`
    (c, 2) numbers of two shapes each, with `combo_deltas` (c, n, 3) that the product of their weights adds.

    Raises
    ------
    FacepinError
        For a broken archive, headers that lie or do not fit together, or numbers that are not finite.
    """
    options.progress(0.0, f"reading {path.name}")
    with open_archive(path) as archive:
        return _read(archive, path, options)


def _read(archive: Archive, path: Path, options: ReadOptions) -> Rig:
    where = path.name
    members = {key: archive.member(key) for key in ("neutral", "faces", "deltas")}
    neutral, faces, deltas = members.values()
    if neutral.dtype.kind != "f" or len(neutral.shape) != 2 or neutral.shape[1] != 3:
        raise FacepinError(f"{where}: neutral is {neutral.dtype} {neutral.shape}, allowed: floats (n, 3)")
    if faces.dtype.kind not in "iu" or len(faces.shape) != 2 or faces.shape[1] < 3:
        raise FacepinError(
            f"{where}: faces are {faces.dtype} {faces.shape}, allowed: whole numbers (m, 3) or (m, 4)"
        )
    count, vertices = (deltas.shape or (0,))[0], neutral.shape[0]
    if deltas.dtype.kind != "f" or deltas.shape[1:] != (vertices, 3) or not count:
        raise FacepinError(
            f"{where}: deltas are {deltas.dtype} {deltas.shape}, allowed: floats (k, {vertices}, 3), k > 0"
        )
    pairs, products = _combinations(archive, where, vertices)
    table = archive.array(faces).astype(np.int64)
    used = table != -1
    if (used[:, 1:] & ~used[:, :-1]).any():
        raise FacepinError(f"{where}: faces may have -1 after their last corner only")
    corners, sizes = table[used], used.sum(axis=1)
    extras = Extras(archive, count, vertices)
    names = extras.names()
    looks, part_of_vertex = extras.parts()
    face_parts = None
    in_range = sizes.min(initial=1) > 0 and ((corners >= 0) & (corners < vertices)).all()
    if part_of_vertex is not None and in_range:  # build_rig says what is wrong with faces that are not
        face_parts = part_of_vertex[corners[np.cumsum(sizes) - sizes]]

    def shapes() -> Iterator[tuple[str, Delta]]:
        for j, delta in enumerate(archive.slices(deltas)):
            options.progress(0.1 + 0.9 * j / (count + len(pairs)), f"shape {j + 1} of {count}")
            yield names[j], delta

    def combinations() -> Iterator[tuple[Pair, Delta]]:
        if products is not None:
            yield from zip(pairs, archive.slices(products), strict=True)

    return build_rig(
        path.stem,
        archive.array(neutral),
        corners,
        sizes,
        shapes(),
        combinations=combinations(),
        parts=looks if face_parts is not None else (),
        face_parts=face_parts,
        colours=extras.colours(),
        rest_weights=extras.weights(),
        warnings=extras.warnings,
        source=path,
    )


def _combinations(archive: Archive, where: str, vertices: int) -> tuple[list[Pair], Member | None]:
    """Return which shapes are combined, and the array of what that adds."""
    found = [key for key in ("combo_pairs", "combo_deltas") if key in archive]
    if not found:
        return [], None
    if len(found) == 1:
        raise FacepinError(f"{where}: {found[0]} without the other of combo_pairs and combo_deltas")
    pairs, deltas = (archive.member(key) for key in found)
    if pairs.dtype.kind not in "iu" or pairs.shape[1:] != (2,):
        raise FacepinError(
            f"{where}: combo_pairs are {pairs.dtype} {pairs.shape}, allowed: whole numbers (c, 2)"
        )
    if deltas.dtype.kind != "f" or deltas.shape != (pairs.shape[0], vertices, 3):
        raise FacepinError(
            f"{where}: combo_deltas are {deltas.dtype} {deltas.shape}, "
            f"allowed: floats ({pairs.shape[0]}, {vertices}, 3)"
        )
    return [(int(a), int(b)) for a, b in archive.array(pairs).tolist()], deltas


class Extras:
    """The optional arrays, each taken only if it fits; otherwise a warning says why not."""

    def __init__(self, archive: Archive, shapes: int, vertices: int) -> None:
        self._archive = archive
        self._shapes = shapes
        self._vertices = vertices
        self.warnings: list[str] = []

    def names(self) -> list[str]:
        """Return a name for every shape, empty ones where there are none."""
        return self._texts("names", self._shapes) or [""] * self._shapes

    def parts(self) -> tuple[list[PartLook], NDArray[np.intp] | None]:
        """Return the looks of the parts and the part of every vertex, or nothing."""
        for key in ("part", "region"):
            numbers = self._fitting(key, "iu", (self._vertices,))
            if numbers is None or not len(numbers):
                continue
            names = self._texts(f"{key}_names", None)
            if names is None or numbers.min() < 0 or numbers.max() >= len(names):
                self.warnings.append(f"array {key!r} is ignored: its numbers need an array '{key}_names'")
                continue
            looks = [PartLook(name) for name in names]
            colours = self._fitting(f"{key}_colours", "fu", (len(names), 3))
            if colours is not None:
                tuples = [(float(r), float(g), float(b)) for r, g, b in _unit(colours)]
                looks = [replace(look, colour=colour) for look, colour in zip(looks, tuples, strict=True)]
            mats = self._fitting(f"{key}_mats", "f", (len(names), 3))
            if mats is not None:
                rough = np.clip(mats[:, 0], 0, 1).tolist()
                looks = [replace(look, roughness=value) for look, value in zip(looks, rough, strict=True)]
            return looks, numbers.astype(np.intp)
        return [], None

    def colours(self) -> NDArray[Any] | None:
        """Return (n, 3) sRGB 0..1, or None."""
        for key in ("colors", "colours"):
            found = self._fitting(key, "fu", (self._vertices, 3))
            if found is not None:
                return _unit(found)
        return None

    def weights(self) -> NDArray[Any] | None:
        """Return (k,) rest weights, or None."""
        return self._fitting("weights", "f", (self._shapes,))

    def _texts(self, key: str, count: int | None) -> list[str] | None:
        found = self._fitting(key, "US", None if count is None else (count,))
        return None if found is None or found.ndim != 1 else texts(found)

    def _fitting(self, key: str, kinds: str, shape: tuple[int, ...] | None) -> NDArray[Any] | None:
        """Return array `key` if it is there, of one of `kinds`, of `shape` and finite."""
        if key not in self._archive:
            return None
        try:
            member = self._archive.member(key)
            if member.dtype.kind not in kinds or (shape is not None and member.shape != shape):
                raise FacepinError(
                    f"it is {member.dtype} {member.shape}, expected {_KINDS[kinds]} {shape or ''}".rstrip()
                )
            array = self._archive.array(member)
            if member.dtype.kind == "f" and not np.isfinite(array).all():
                raise FacepinError("it has numbers that are not finite")
        except FacepinError as error:
            self.warnings.append(f"array {key!r} is ignored: {error}")
            return None
        return array


_KINDS = {"iu": "whole numbers", "fu": "floats or bytes", "f": "floats", "US": "texts"}


def _unit(colours: NDArray[Any]) -> NDArray[np.float32]:
    """Return colours 0..1; whole numbers are shares of the largest that their type has."""
    if colours.dtype.kind == "u":
        colours = colours / np.float64(np.iinfo(colours.dtype).max)
    unit: NDArray[np.float32] = np.clip(colours, 0.0, 1.0).astype(np.float32)
    return unit
