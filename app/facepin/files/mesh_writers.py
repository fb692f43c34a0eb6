"""The posed mesh alone, for programs that know no shapes: .obj, .ply, .stl."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.rig import Rig
from facepin.files.safely.atomic import atomic_write

if TYPE_CHECKING:
    from trimesh import Trimesh


def write_obj(rig: Rig, weights: Floats, path: Path) -> None:
    """Write the posed mesh with its polygons; parts are `usemtl` groups.  Numbers read back bit for bit.

    Raises
    ------
    FacepinError
        If the file cannot be written.
    """
    lines = [f"# {rig.name}, {rig.vertex_count} vertices, {len(rig.face_sizes)} faces, written by Facepin"]
    lines += [f"v {x} {y} {z}" for x, y, z in rig.evaluate(weights).astype(np.str_).tolist()]
    numbers = (rig.corners + 1).tolist()
    ends = np.cumsum(rig.face_sizes).tolist()
    starts = [0, *ends[:-1]]
    for part in rig.parts:
        lines.append("usemtl " + "_".join(part.name.split()))
        lines += ["f " + " ".join(map(str, numbers[starts[face] : ends[face]])) for face in part.faces]
    atomic_write(path, ("\n".join(lines) + "\n").encode())


def write_ply(rig: Rig, weights: Floats, path: Path) -> None:
    """Write the posed mesh as triangles, with vertex colours where the rig has them (binary PLY).

    Raises
    ------
    FacepinError
        If the file cannot be written.
    """
    from trimesh.exchange.ply import export_ply

    atomic_write(path, export_ply(_mesh(rig, weights)))


def write_stl(rig: Rig, weights: Floats, path: Path) -> None:
    """Write the posed mesh as separate triangles (binary STL).

    Raises
    ------
    FacepinError
        If the file cannot be written.
    """
    from trimesh.exchange.stl import export_stl

    atomic_write(path, export_stl(_mesh(rig, weights)))


def _mesh(rig: Rig, weights: Floats) -> "Trimesh":
    import trimesh

    colours = None if rig.colours is None else np.rint(rig.colours * 255).astype(np.uint8)
    return trimesh.Trimesh(rig.evaluate(weights), rig.triangles, vertex_colors=colours, process=False)
