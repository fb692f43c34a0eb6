"""The one door to a `Rig`: every reader and generator ends here, and what a rig promises is checked here."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from facepin.core.arrays import Floats, Indices, Points, frozen
from facepin.core.delta_columns import Delta, checked_points, delta_columns, side_by_side
from facepin.core.errors import FacepinError
from facepin.core.names import LONGEST_SHAPE, clean_name, clean_names, listed
from facepin.core.rig import Part, Rig, Texture
from facepin.core.soundness import motion_remarks

Pair = tuple[int, int]

TIED = (("mouthClose", "jawOpen"),)
"""ARKit's mouthClose is the way of the lips back from an open jaw: without it they cut through each other."""
LARGEST_WEIGHT = 1e6
MOST_WARNINGS = 40


@dataclass(frozen=True)
class PartLook:
    """Name and look of one part, before its faces are known."""

    name: str
    colour: tuple[float, float, float] | None = None
    """Base colour, sRGB 0..1."""
    roughness: float = Part.roughness
    texture: Texture | None = None
    cutout: float | None = None
    opacity: float = 1.0
    blends: bool = False
    transmission: float = 0.0
    double_sided: bool = True


def build_rig(
    name: str,
    neutral: ArrayLike,
    corners: ArrayLike,
    face_sizes: ArrayLike,
    shapes: Iterable[tuple[str, Delta]],
    *,
    combinations: Iterable[tuple[Pair, Delta]] = (),
    parts: Sequence[PartLook] = (),
    face_parts: ArrayLike | None = None,
    colours: ArrayLike | None = None,
    texture_places: ArrayLike | None = None,
    limits: ArrayLike | None = None,
    rest_weights: ArrayLike | None = None,
    up: tuple[float, float, float] | None = None,
    front: tuple[float, float, float] | None = None,
    warnings: Iterable[str] = (),
    source: Path | None = None,
) -> Rig:
    """Check the pieces of a rig, mend what can be mended (with a warning each) and put them together.

    Parameters
    ----------
    neutral : (n, 3) floats, the file's unit
        Rest positions.
    corners : (c,) whole numbers
        Vertex index of every face corner, face after face.
    face_sizes : (m,) whole numbers, 3 or more
        Corners of each face.
    shapes : k pairs of name and delta
        See `Delta`.  Taken one by one, so an iterator that makes each delta when asked keeps memory low.
    combinations : c pairs of (a, b) and delta
        Indices of two different shapes, and what is added by the product of their weights.  Taken after the
        shapes, one by one.
    parts, face_parts : names and looks of the parts, and (m,) the part of each face
        Faces are regrouped by part (in the order of `parts`, stable within one); vertices keep their order.
        `face_parts` may be left out for a single part.
    colours : (n, 3) floats, sRGB 0..1
    texture_places : (n, 2) floats
        Where the vertices are in the textures of their parts.
    limits : (k, 2)
        0..1 when left out; widened where a rest weight lies outside.
    rest_weights : (k,)
        Weights the file itself asks for.
    up, front : unit vectors
        Which way is up, and which way the face looks, where the file says.

    Raises
    ------
    FacepinError
        For wrong array shapes, numbers that are not finite or absurdly large, indices out of range, no faces,
        no shapes, combinations of shapes that are not there.
    """
    name = clean_name(name) or "face"
    where = source.name if source is not None and source.name else name
    positions = checked_points(neutral, f"{where}: neutral")
    if not len(positions):
        raise FacepinError(f"{where}: the neutral has no vertices")
    corner_array, sizes = _faces(where, corners, face_sizes, len(positions))
    looks = list(parts) or [PartLook(name)]
    part_of_face = np.zeros(len(sizes), np.intp) if face_parts is None else np.asarray(face_parts, np.intp)
    if part_of_face.shape != sizes.shape or part_of_face.min() < 0 or part_of_face.max() >= len(looks):
        raise FacepinError(
            f"{where}: face_parts must give one of {len(looks)} parts to each of {len(sizes)} faces"
        )
    corner_array, sizes, part_of_face = _grouped(corner_array, sizes, part_of_face)

    columns = delta_columns(where, shapes, len(positions))
    if not columns.names:
        raise FacepinError(f"{where}: no shapes, only a neutral; allowed are one or more")
    shape_names, remarks = clean_names(columns.names, longest=LONGEST_SHAPE)
    if columns.equal:
        pairs = [f"{shape_names[i]} and {shape_names[j]}" for i, j in columns.equal]
        remarks.append(f"equal shapes, which no solver can tell apart: {listed(pairs)}")
    if columns.still:
        remarks.append(f"shapes that move nothing: {listed([shape_names[j] for j in columns.still])}")
    remarks += motion_remarks(positions, corner_array, columns, shape_names)
    count = len(shape_names)
    combined: list[Pair] = []
    products = delta_columns(
        where, _named(where, combinations, shape_names, combined), len(positions), "combination"
    )
    if products.still:
        idle = listed([products.names[i] for i in products.still])
        remarks.append(f"combinations that move nothing: {idle}")
    rest = frozen(_numbers(rest_weights, (count,), 0.0, f"{where}: rest weights"), np.float64)
    allowed = _numbers(limits, (count, 2), (0.0, 1.0), f"{where}: limits")
    if (allowed[:, 0] > allowed[:, 1]).any():
        j = int(np.argmax(allowed[:, 0] > allowed[:, 1]))
        raise FacepinError(
            f"{where}: limits of {shape_names[j]} are {allowed[j].tolist()}, allowed: low, high"
        )
    allowed = np.stack([np.minimum(allowed[:, 0], rest), np.maximum(allowed[:, 1], rest)], axis=1)

    return Rig(
        name=name,
        neutral=positions,
        deltas=side_by_side(columns.matrix, products.matrix),
        shape_names=tuple(shape_names),
        corners=frozen(corner_array, np.int32),
        face_sizes=frozen(sizes, np.int32),
        triangles=frozen(fan_triangles(corner_array, sizes), np.int32),
        parts=_parts(looks, part_of_face, sizes),
        limits=frozen(allowed, np.float64),
        rest_weights=rest,
        file_names=tuple(columns.names),
        ties=_ties(shape_names),
        combinations=frozen(np.reshape(combined, (-1, 2)), np.int32),
        colours=None if colours is None else _colours(where, colours, len(positions)),
        texture_places=None
        if texture_places is None
        else _texture_places(where, texture_places, len(positions)),
        up=up,
        front=front,
        warnings=_few([*warnings, *remarks]),
        source=source,
    )


def _named(
    where: str, combinations: Iterable[tuple[Pair, Delta]], names: Sequence[str], pairs: list[Pair]
) -> Iterator[tuple[str, Delta]]:
    """Give each combination the name of its shapes; gather the pairs of these in `pairs`, checked."""
    for at, ((a, b), delta) in enumerate(combinations):
        if a == b or not (0 <= a < len(names) and 0 <= b < len(names)):
            raise FacepinError(
                f"{where}: combination {at} is of the shapes {a} and {b}, "
                f"allowed are two different ones of 0 to {len(names) - 1}"
            )
        pairs.append((min(a, b), max(a, b)))
        yield "*".join(names[j] for j in pairs[-1]), delta


def _ties(names: Sequence[str]) -> tuple[Pair, ...]:
    """Return the ties (see `Rig`) of shapes whose names tell what they are made for."""
    places = dict[str, int]()
    for j, name in enumerate(names):
        plain = name.rpartition(".")[2]
        places.setdefault(plain[:1].lower() + plain[1:], j)
    return tuple((places[a], places[b]) for a, b in TIED if a in places and b in places)


def fan_triangles(corners: Indices, face_sizes: Indices) -> Indices:
    """Cut every face into the fan around its first corner: (sum of sizes − 2 m, 3) int32, in face order."""
    starts = np.cumsum(face_sizes) - face_sizes
    per_face = face_sizes - 2
    first = np.repeat(starts, per_face)
    step = np.arange(len(first)) - np.repeat(np.cumsum(per_face) - per_face, per_face)
    triangles = np.stack([corners[first], corners[first + step + 1], corners[first + step + 2]], axis=1)
    return triangles.astype(np.int32)


def _few(lines: list[str]) -> tuple[str, ...]:
    hidden = len(lines) - MOST_WARNINGS
    return (*lines[:MOST_WARNINGS], *([f"and {hidden} more warnings"] if hidden > 0 else []))


def _faces(where: str, corners: ArrayLike, face_sizes: ArrayLike, vertices: int) -> tuple[Indices, Indices]:
    corner_array, sizes = np.asarray(corners), np.asarray(face_sizes)
    for array, word in ((corner_array, "corners"), (sizes, "face sizes")):
        if array.ndim != 1 or array.dtype.kind not in "iu":
            raise FacepinError(
                f"{where}: {word} must be a list of whole numbers, found {array.dtype} {array.shape}"
            )
    if not len(sizes):
        raise FacepinError(f"{where}: the neutral has no faces, so there is nothing to draw or to pin")
    if sizes.min() < 3:
        face = int(np.argmax(sizes < 3))
        raise FacepinError(f"{where}: face {face} has {sizes[face]} corners, allowed are 3 or more")
    if sizes.sum(dtype=np.int64) != len(corner_array):
        raise FacepinError(f"{where}: faces ask for {sizes.sum()} corners, found {len(corner_array)}")
    outside = (corner_array < 0) | (corner_array >= vertices)
    if outside.any():
        at = int(np.argmax(outside))
        face = int(np.searchsorted(np.cumsum(sizes), at, side="right"))
        raise FacepinError(
            f"{where}: face {face} refers to vertex {corner_array[at]}, allowed are 0 to {vertices - 1}"
        )
    return corner_array.astype(np.int32), sizes.astype(np.int32)


def _grouped(
    corners: Indices, sizes: Indices, part_of_face: NDArray[np.intp]
) -> tuple[Indices, Indices, NDArray[np.intp]]:
    """Reorder faces so that those of one part follow each other; nothing is copied where they already do."""
    if (np.diff(part_of_face) >= 0).all():
        return corners, sizes, part_of_face
    order = np.argsort(part_of_face, kind="stable")
    starts = (np.cumsum(sizes) - sizes)[order]
    sizes = sizes[order]
    within = np.arange(len(corners)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return corners[np.repeat(starts, sizes) + within], sizes, part_of_face[order]


def _parts(looks: Sequence[PartLook], part_of_face: NDArray[np.intp], sizes: Indices) -> tuple[Part, ...]:
    """Return the parts that have faces, as runs of the grouped faces."""
    names, _ = clean_names([look.name for look in looks], unnamed="part")
    triangle_ends = np.concatenate([[0], np.cumsum(sizes - 2)])
    edges = np.searchsorted(part_of_face, np.arange(len(looks) + 1))
    parts = []
    for look, name, start, stop in zip(looks, names, edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        if start < stop:
            triangles = range(int(triangle_ends[start]), int(triangle_ends[stop]))
            faces = range(start, stop)
            parts.append(
                Part(
                    name,
                    faces,
                    triangles,
                    look.colour,
                    look.roughness,
                    look.texture,
                    look.cutout,
                    look.opacity,
                    look.blends,
                    look.transmission,
                    look.double_sided,
                )
            )
    return tuple(parts)


def _numbers(values: ArrayLike | None, shape: tuple[int, ...], default: Any, where: str) -> Floats:
    """Return `values` as finite float64 of `shape`, or the default spread over it."""
    array = np.array(np.broadcast_to(default, shape) if values is None else values, np.float64)
    if array.shape != shape:
        raise FacepinError(f"{where} are {array.shape} numbers, allowed: {shape}")
    wrong = array[~(np.abs(array) <= LARGEST_WEIGHT)]
    if len(wrong):
        raise FacepinError(
            f"{where}: found {wrong[0]:g}, allowed are finite numbers up to {LARGEST_WEIGHT:.0e}"
        )
    return array


def _colours(where: str, colours: ArrayLike, vertices: int) -> Points:
    array = np.asarray(colours, np.float32)
    if array.shape != (vertices, 3) or not np.isfinite(array).all():
        raise FacepinError(f"{where}: colours must be ({vertices}, 3) finite numbers, found {array.shape}")
    clipped: Points = frozen(np.clip(array, 0.0, 1.0), np.float32)
    return clipped


def _texture_places(where: str, places: ArrayLike, vertices: int) -> Points:
    array: Points = frozen(np.asarray(places), np.float32)
    if array.shape != (vertices, 2) or not np.isfinite(array).all():
        raise FacepinError(
            f"{where}: texture places must be ({vertices}, 2) finite numbers, found {array.shape}"
        )
    return array
