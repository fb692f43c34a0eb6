"""The lines of a wireframe."""

from collections.abc import Sequence

import numpy as np
import pytest

from facepin.core.arrays import Floats
from facepin.core.mesh.outlines import outlines
from facepin.core.mesh.topology import edge_count
from facepin.core.rig import Rig
from facepin.core.rig_builder import PartLook, build_rig
from support.small_rigs import sheet

CUBE = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], np.float64)
SIDES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


def rig_of(points: Floats, faces: Sequence[Sequence[int]], parts: int = 1) -> Rig:
    corners = [vertex for face in faces for vertex in face]
    looks = [PartLook(f"part{part}") for part in range(parts)]
    numbers = np.arange(len(faces)) * parts // len(faces)
    return build_rig(
        "outlines",
        points,
        corners,
        [len(f) for f in faces],
        [("up", points + 1)],
        parts=looks,
        face_parts=numbers,
    )


@pytest.mark.parametrize("cut", [False, True], ids=["quads", "triangles"])
def test_a_cube_has_twelve_edges(cut: bool) -> None:
    faces = [piece for a, b, c, d in SIDES for piece in ([a, b, c], [a, c, d])] if cut else SIDES
    edges = outlines(rig_of(CUBE, faces), rig_of(CUBE, faces).parts)
    lengths = np.linalg.norm(CUBE[edges[:, 0]] - CUBE[edges[:, 1]], axis=1)
    np.testing.assert_allclose(lengths, np.ones(12))
    assert (edges[:, 0] < edges[:, 1]).all()


def test_each_edge_of_quads_and_of_larger_faces_is_there_once() -> None:
    quads = sheet()
    assert len(outlines(quads, quads.parts)) == edge_count(quads)
    turn = 2 * np.pi * np.arange(7) / 7
    seven = rig_of(np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1), [range(7)])
    assert outlines(seven, seven.parts).tolist() == [[0, 1], [0, 6], *([at, at + 1] for at in range(1, 6))]


def test_a_fold_keeps_its_edge() -> None:
    roof = np.array([[0, 0, 0], [1, 0, 0.5], [1, 1, 0], [0, 1, 0.5]], np.float64)
    edges = outlines(rig_of(roof, [[0, 1, 2], [0, 2, 3]]), rig_of(roof, [[0, 1, 2], [0, 2, 3]]).parts)
    assert [0, 2] in edges.tolist()


def test_a_seam_is_one_line() -> None:
    points = np.array(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0]]
    )
    rig = rig_of(points.astype(np.float64), [[0, 1, 2, 3], [4, 5, 6, 7]])
    assert len(outlines(rig, rig.parts)) == 7


def test_only_the_parts_asked_for_have_lines() -> None:
    rig = rig_of(CUBE, SIDES, parts=2)
    front, back = (outlines(rig, [part]).tolist() for part in rig.parts)
    assert len(front) < 12
    assert len(outlines(rig, rig.parts)) == 12
    assert {*map(tuple, front)} | {*map(tuple, back)} == {*map(tuple, outlines(rig, rig.parts).tolist())}
    assert outlines(rig, []).shape == (0, 2)
