"""The face of a body is measured and looked at, not the body."""

import numpy as np
import pytest

from facepin.core.look.camera import Viewport
from facepin.core.look.face_view import expressive, face_camera
from facepin.core.rig import Rig
from facepin.files import open_rig
from facepin.resources import builtin_faces
from support.small_rigs import ball, rig_of


def body(build: bool = False) -> Rig:
    """A ball of 0.24 as a head, over 1.5 of body; `build` is a shape that moves the body too."""
    head, head_faces = ball((0, 1.62, 0), 0.12)
    rest, rest_faces = ball((0, 0, 0), 1.0)
    rest = rest * [0.25, 0.75, 0.15] + [0, 0.75, 0]
    neutral = np.concatenate([head, rest])
    shapes = []
    front = np.flatnonzero((neutral[:, 1] > 1.51) & (neutral[:, 2] > 0.04))
    for at in range(8):
        delta = np.zeros_like(neutral)
        delta[front[at % 3 :: 2]] = 0.01, -0.01, 0.001 * at
        shapes.append(delta)
    if build:
        shapes.append(0.1 * neutral)
    faces = np.concatenate([head_faces, rest_faces + len(head)])
    return rig_of("body", neutral, faces, np.stack(shapes))


@pytest.mark.parametrize("build", [False, True])
def test_a_body_is_as_high_as_its_head(build: bool) -> None:
    rig = body(build)
    assert 0.15 < rig.height < 0.4
    assert 250 < np.count_nonzero(rig.head) < 400


def test_pictures_show_the_face_of_a_body() -> None:
    rig = body(build=True)
    viewport = Viewport(0, 0, 200, 200)
    x, y, _ = face_camera(rig, (200, 200)).project(rig.neutral[expressive(rig)], viewport).T
    assert np.ptp(y) > 70 or np.ptp(x) > 70
    assert x.min() > 0
    assert y.max() < 200
    assert x.max() < 200
    assert y.min() > 0


def test_a_head_is_as_high_as_it_was() -> None:
    for path in builtin_faces().values():
        rig = open_rig(path)
        assert rig.height == pytest.approx(float(np.ptp(rig.neutral[:, 1])))
        assert rig.head.all()
