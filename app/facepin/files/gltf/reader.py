"""Rigs from .glb, .gltf and .vrm files: morph targets become shapes, node transforms are baked in."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Points
from facepin.core.delta_columns import Delta
from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.files.gltf.accessors import read_delta
from facepin.files.gltf.document import GltfDocument, read_document
from facepin.files.gltf.expressions import expressions
from facepin.files.gltf.gathering import Assembly, Block, carried
from facepin.files.gltf.scene import avatar_front, placed_meshes
from facepin.files.gltf.shape_names import ShapeKey
from facepin.files.gltf.targets import shape_keys
from facepin.files.options import Progress, ReadOptions, no_progress


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
    keys_of, odd = shape_keys(document, placed)
    gathered.warnings += odd
    for at, place in enumerate(placed):
        options.progress(0.1 + 0.3 * at / len(placed), f"reading {place.name}")
        gathered.add_mesh(place, keys_of[place.mesh_index])
    if not gathered.triangles:
        raise FacepinError(f"{path.name}: its meshes have no triangles")
    if not gathered.shapes:
        raise FacepinError(f"{path.name}: none of its {len(placed)} meshes has morph targets (blendshapes)")
    if any(place.joints is not None for place in placed):
        gathered.warnings.append("bones are not moved here: the face stays as they stand in the file")

    triangles = np.concatenate(gathered.triangles)
    keys = [key for key in gathered.shapes if key not in gathered.combined]
    places = {key: j for j, key in enumerate(keys)}
    front = avatar_front(document)
    poses, faults = expressions(document, keys_of, places)
    gathered.warnings += faults
    rig = build_rig(
        path.stem,
        np.concatenate(gathered.positions),
        triangles.ravel(),
        np.full(len(triangles), 3, np.int32),
        ((key[0], delta) for key, delta in zip(keys, _deltas(gathered, keys, options.progress), strict=True)),
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
        colours=gathered.all_colours(),
        texture_places=gathered.all_places(),
        rest_weights=np.array([gathered.rest[key] for key in places]),
        up=None if front is None else (0.0, 1.0, 0.0),
        front=front,
        warnings=gathered.warnings,
        source=path,
    )
    return replace(rig, poses=poses)


def _deltas(gathered: Assembly, keys: Sequence[ShapeKey], progress: Progress) -> Iterator[Delta]:
    """Make the deltas of some shapes or combinations, one at a time."""
    stored = 0
    for j, key in enumerate(keys):
        progress(0.4 + 0.6 * j / len(keys), f"shape {j + 1} of {len(keys)}")
        deltas = [_piece(gathered.document, block, accessor) for block, accessor in gathered.shapes[key]]
        vertices = np.concatenate([np.zeros(0, np.int64), *(vertices for vertices, _ in deltas)])
        stored += len(vertices)
        gathered.document.check_growth(stored, "targets")
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
            linear = block.linear if block.linear.ndim == 2 else block.linear[vertices]
            moves = carried(moves, linear).astype(np.float32)
    return vertices + block.start, moves
