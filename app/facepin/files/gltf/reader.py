"""Rigs from .glb, .gltf and .vrm files: morph targets become shapes, node transforms are baked in."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points
from facepin.core.delta_columns import Delta
from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.core.rig_builder import PartLook, build_rig
from facepin.files.gltf.accessors import accessor_count, read_delta, read_floats, read_indices
from facepin.files.gltf.document import COMPRESSIONS, GltfDocument, read_document, refuse_compression
from facepin.files.gltf.images import Textures, texture_places
from facepin.files.gltf.materials import linear_to_srgb, material_factor, part_look, shine_of
from facepin.files.gltf.scene import Placed, avatar_front, placed_meshes
from facepin.files.gltf.targets import ShapeKey, combined_targets, rest_weights, shape_keys
from facepin.files.options import Progress, ReadOptions, no_progress
from facepin.files.safely.checked_json import JsonObject

TRIANGLES, STRIP, FAN = 4, 5, 6


@dataclass(frozen=True, eq=False)
class Block:
    """Vertices of one primitive at one node: rows `start` .. `start + count` of the rig."""

    start: int
    count: int
    linear: Floats | None
    """(3, 3) what the node's transform does to deltas, None for nothing."""
    textured: bool = False
    """Whether it is known where its vertices are in the texture of the primitive."""


@dataclass
class Assembly:
    """What has been gathered so far while the scene is walked."""

    document: GltfDocument
    positions: list[Points] = field(default_factory=list)
    colours: list[Points | None] = field(default_factory=list)
    places: list[Points | None] = field(default_factory=list)
    """Where vertices are in their texture, if they have one."""
    triangles: list[NDArray[np.int64]] = field(default_factory=list)
    parts: list[PartLook] = field(default_factory=list)
    vertices: int = 0
    corners: int = 0
    pieces: int = 0
    shapes: dict[ShapeKey, list[tuple[Block, int]]] = field(default_factory=dict)
    """Blocks that a shape or combination moves, and their delta accessors."""
    combined: dict[ShapeKey, tuple[ShapeKey, ShapeKey]] = field(default_factory=dict)
    """Which of them are combinations, and of which shapes."""
    rest: dict[ShapeKey, float] = field(default_factory=dict)
    """Weights that the file asks for; those of combinations count for nothing."""
    warnings: list[str] = field(default_factory=list)
    textures: Textures = field(init=False)

    def __post_init__(self) -> None:
        self.textures = Textures(self.document, self.warnings)

    def grow(self, vertices: int, corners: int, pieces: int) -> None:
        """Count what is about to be added; a small file that repeats itself into a huge rig is refused."""
        self.vertices += vertices
        self.corners += corners
        self.pieces += pieces
        most = 4 * self.document.size + 65536
        if max(self.vertices, self.corners, 32 * self.pieces) > most:
            raise FacepinError(
                f"{self.document.root.where} its meshes unfold to far more than the file holds"
            )


def read_gltf(path: Path, options: ReadOptions) -> Rig:
    """Read a rig from a glTF 2.0 file.

    Raises
    ------
    FacepinError
        For anything that is not a sound glTF with at least one mesh that has morph targets.
    """
    options.progress(0.0, f"reading {path.name}")
    document = read_document(path)
    placed = placed_meshes(document)
    if not placed:
        raise FacepinError(f"{path.name}: no mesh in the scene")
    gathered = Assembly(document)
    for at, place in enumerate(placed):
        options.progress(0.1 + 0.3 * at / len(placed), f"reading {_mesh_name(place)}")
        _add_mesh(gathered, place)
    if not gathered.triangles:
        raise FacepinError(f"{path.name}: its meshes have no triangles")
    if not gathered.shapes:
        raise FacepinError(f"{path.name}: none of its {len(placed)} meshes has morph targets (blendshapes)")
    if any("skin" in place.node for place in placed):
        gathered.warnings.append("skins are ignored: the face stays as it is at rest, bones do not move it")

    triangles = np.concatenate(gathered.triangles)
    keys = [key for key in gathered.shapes if key not in gathered.combined]
    places = {key: j for j, key in enumerate(keys)}
    front = avatar_front(document)
    return build_rig(
        path.stem,
        np.concatenate(gathered.positions),
        triangles.ravel(),
        np.full(len(triangles), 3, np.int32),
        (
            (key[0] if isinstance(key[0], str) else "", delta)
            for key, delta in zip(keys, _deltas(gathered, keys, options.progress), strict=True)
        ),
        combinations=(
            ((places[a], places[b]), delta)
            for (a, b), delta in zip(
                gathered.combined.values(),
                _deltas(gathered, list(gathered.combined), no_progress),
                strict=True,
            )
        ),
        parts=gathered.parts,
        face_parts=np.repeat(np.arange(len(gathered.parts)), [len(run) for run in gathered.triangles]),
        colours=_colours(gathered),
        texture_places=_places(gathered),
        rest_weights=np.array([gathered.rest[key] for key in places]),
        up=None if front is None else (0.0, 1.0, 0.0),
        front=front,
        warnings=gathered.warnings,
        source=path,
    )


def _mesh_name(place: Placed) -> str:
    return place.mesh.text("name", "") or place.node.text("name", "") or f"mesh {place.mesh_index}"


def _add_mesh(gathered: Assembly, place: Placed) -> None:
    """Add the primitives of one mesh; those that share their vertices keep sharing them."""
    primitives = place.mesh.children("primitives")
    blocks: dict[tuple[int, ...], Block] = {}
    keys, problems = shape_keys(place)
    weights, more_problems = rest_weights(place, len(keys))
    gathered.warnings += problems + more_problems
    gathered.combined |= combined_targets(place, keys)
    gathered.grow(0, 0, len(keys))
    for key, weight in zip(keys, weights, strict=True):
        gathered.shapes.setdefault(key, [])
        gathered.rest[key] = gathered.rest.get(key, 0.0) or weight
    for at, primitive in enumerate(primitives):
        mode = primitive.integer("mode", 4, high=6)
        if mode not in (TRIANGLES, STRIP, FAN):
            gathered.warnings.append(f"{primitive.where}: points and lines are left out")
            continue
        attributes = primitive.child("attributes")
        if "POSITION" not in attributes:
            raise FacepinError(f"{primitive.where}: no POSITION attribute")
        targets = [target.optional_integer("POSITION") for target in primitive.children("targets")]
        gathered.grow(0, 0, 1 + len(targets))
        position = attributes.integer("POSITION")
        shine = shine_of(gathered.document, primitive)
        textured = None if shine is None else gathered.textures.base_colour(shine)
        identity = (
            position,
            attributes.integer("COLOR_0", -1, low=-1),
            -1 if textured is None else primitive.integer("material"),
            *(-1 if t is None else t for t in targets),
        )
        block = blocks.get(identity)
        if block is None:
            block = blocks[identity] = _add_vertices(gathered, place, primitive, position)
            for key, target in zip(keys, targets, strict=False):
                if target is not None:
                    gathered.shapes[key].append((block, target))
        gathered.triangles.append(_triangles(gathered, primitive, mode, block, place.matrix))
        look = part_look(gathered.document, primitive, _mesh_name(place), at, len(primitives))
        if block.textured and shine is not None:
            look = replace(look, texture=gathered.textures.base_colour(shine))
        gathered.parts.append(look)


def _add_vertices(gathered: Assembly, place: Placed, primitive: JsonObject, position: int) -> Block:
    document = gathered.document
    for extension in COMPRESSIONS:
        if (
            extension in primitive.child("extensions")
            and "bufferView" not in (document.root.children("accessors")[position])
        ):
            refuse_compression(extension, primitive.where)
    count = accessor_count(document, position)
    gathered.grow(count, 0, 0)
    linear = place.matrix[:3, :3]
    points = read_floats(document, position, ("VEC3",))
    if not np.array_equal(place.matrix, np.eye(4)):
        with np.errstate(all="ignore"):  # build_rig names what is not finite
            points = (points.astype(np.float64) @ linear.T + place.matrix[:3, 3]).astype(np.float32)
    gathered.positions.append(points)
    gathered.colours.append(_vertex_colours(document, primitive, count))
    places = _vertex_places(gathered, primitive, count)
    gathered.places.append(places)
    turned = None if np.array_equal(linear, np.eye(3)) else linear
    return Block(gathered.vertices - count, count, turned, places is not None)


def _vertex_colours(document: GltfDocument, primitive: JsonObject, count: int) -> Points | None:
    """Return (count, 3) linear vertex colours times the material's factor, or None."""
    index = primitive.child("attributes").optional_integer("COLOR_0")
    if index is None:
        return None
    colours = read_floats(document, index, ("VEC3", "VEC4"))[:, :3]
    if len(colours) != count:
        raise FacepinError(f"{primitive.where}: COLOR_0 has {len(colours)} elements, POSITION has {count}")
    return colours * material_factor(document, primitive)


def _colours(gathered: Assembly) -> Points | None:
    """Return (n, 3) sRGB colours, or None where no primitive has any.

    Those without get a light grey, or white where a texture brings the colour.
    """
    if all(colours is None for colours in gathered.colours):
        return None
    filled = [
        np.full((len(points), 3), 0.6 if places is None else 1.0, np.float32) if colours is None else colours
        for points, colours, places in zip(gathered.positions, gathered.colours, gathered.places, strict=True)
    ]
    return linear_to_srgb(np.concatenate(filled))


def _vertex_places(gathered: Assembly, primitive: JsonObject, count: int) -> Points | None:
    """Return (count, 2) places in the texture of a primitive, or None where there is none to use."""
    shine = shine_of(gathered.document, primitive)
    if shine is None or gathered.textures.base_colour(shine) is None:
        return None
    places = texture_places(gathered.document, primitive, shine, count)
    if places is None:
        gathered.warnings.append(f"{primitive.where}: a texture is left out: no coordinates in it")
    return places


def _places(gathered: Assembly) -> Points | None:
    """Return (n, 2) places in textures, or None where there are no textures; those without get zeros."""
    if all(places is None for places in gathered.places):
        return None
    filled = [
        np.zeros((len(points), 2), np.float32) if places is None else places
        for points, places in zip(gathered.positions, gathered.places, strict=True)
    ]
    return np.concatenate(filled)


def _triangles(
    gathered: Assembly, primitive: JsonObject, mode: int, block: Block, matrix: Floats
) -> NDArray[np.int64]:
    """Return (t, 3) vertex indices into the rig, facing outwards also where the node mirrors."""
    index = primitive.optional_integer("indices")
    count = block.count if index is None else accessor_count(gathered.document, index)
    gathered.grow(0, count if mode == TRIANGLES else 3 * count, 0)
    if index is None:
        indices: NDArray[np.int64] = np.arange(count)
    else:
        indices = read_indices(gathered.document, index, block.count).astype(np.int64)
    if mode == TRIANGLES:
        triangles = indices[: count // 3 * 3].reshape(-1, 3)
    else:
        middle, last = indices[1:-1], indices[2:]
        first = indices[:-2] if mode == STRIP else np.repeat(indices[:1], len(last))
        triangles = np.stack([first, middle[: len(last)], last], axis=1)
        if mode == STRIP:
            triangles[1::2] = triangles[1::2, [1, 0, 2]]
    if np.linalg.det(matrix[:3, :3]) < 0:
        triangles = triangles[:, [0, 2, 1]]
    return triangles + block.start


def _deltas(gathered: Assembly, keys: Sequence[ShapeKey], progress: Progress) -> Iterator[Delta]:
    """Make the deltas of some shapes or combinations, one at a time."""
    stored = 0
    for j, key in enumerate(keys):
        progress(0.4 + 0.6 * j / len(keys), f"shape {j + 1} of {len(keys)}")
        deltas = [_piece(gathered.document, block, accessor) for block, accessor in gathered.shapes[key]]
        vertices = np.concatenate([np.zeros(0, np.int64), *(vertices for vertices, _ in deltas)])
        stored += len(vertices)
        if stored > 4 * gathered.document.size:
            raise FacepinError(
                f"{gathered.document.root.where} its targets unfold to far more than the file holds"
            )
        yield vertices, np.concatenate([np.zeros((0, 3), np.float32), *(moves for _, moves in deltas)])


def _piece(document: GltfDocument, block: Block, accessor: int) -> tuple[NDArray[np.int64], Points]:
    """Return the vertices of the rig that one target moves, and their moves."""
    delta = read_delta(document, accessor, block.count)
    if isinstance(delta, tuple):
        vertices, moves = np.asarray(delta[0], np.int64), np.asarray(delta[1], np.float32)
    else:
        moves = np.asarray(delta, np.float32)
        with np.errstate(invalid="ignore"):  # build_rig names what is not finite
            vertices = np.flatnonzero((moves != 0.0).any(axis=1))
        moves = moves[vertices]
    if block.linear is not None:
        with np.errstate(all="ignore"):
            moves = (moves.astype(np.float64) @ block.linear.T).astype(np.float32)
    return vertices + block.start, moves
