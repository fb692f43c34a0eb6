"""Eyes that a file does not name."""

from dataclasses import replace

import moderngl
import numpy as np
import pytest

from facepin.core.rig import Rig
from facepin.core.rig_builder import PartLook, build_rig
from facepin.gpu.eyeballs import EYEBALL_NAME, SHELL_NAME, eyes_apart
from facepin.gpu.materials import EYEBALL, by_name, material, vertex_albedo
from facepin.gpu.scene import Scene
from support.gpu_help import ball, bowl

EYES = ((-3, 0, 9), (3, 0, 9))
HEAD = (ball(24), 12.0, (0, 0, 0))


def together(*surfaces: tuple[Rig, float, tuple[float, float, float]], look: PartLook | None = None) -> Rig:
    """One part of several surfaces: (what, its size, where)."""
    points, corners, count = [], [], 0
    for rig, size, place in surfaces:
        points.append(rig.neutral * size + place)
        corners.append(rig.corners + count)
        count += rig.vertex_count
    joined = np.concatenate(points)
    sizes = np.full(sum(len(c) for c in corners) // 3, 3)
    move = ("move", np.ones_like(joined))
    return build_rig("face", joined, np.concatenate(corners), sizes, [move], parts=[look or PartLook("mesh")])


def eyes(size: float = 1.0) -> list[tuple[Rig, float, tuple[float, float, float]]]:
    return [(ball(16), size, place) for place in EYES]


def test_a_pair_of_balls_in_front_gets_an_iris_each() -> None:
    rig = together(HEAD, *eyes())
    found = eyes_apart(rig)
    assert [part.name for part in found.parts] == ["mesh", EYEBALL_NAME, EYEBALL_NAME]
    assert [part.triangles.stop for part in found.parts[:-1]] == [
        part.triangles.start for part in found.parts[1:]
    ]
    assert [part.faces for part in found.parts] == [part.triangles for part in found.parts]
    assert found.parts[-1].triangles.stop == len(rig.triangles)
    assert by_name(found.parts[1]) is EYEBALL
    albedo = vertex_albedo(found)[:, :3]
    head = HEAD[0].vertex_count
    assert (albedo[:head] == 1).all()
    for place, vertices in zip(EYES, np.split(np.arange(head, rig.vertex_count), 2), strict=True):
        dark = rig.neutral[vertices][albedo[vertices].max(axis=1) < 0.1]
        np.testing.assert_allclose(dark.mean(axis=0), np.add(place, (0, 0, 1)), atol=0.05)


def test_a_clear_shell_that_hides_the_pupil_is_left_out_and_a_ball_within_the_ball_is_an_eye() -> None:
    shells = [(bowl(16), 1.1, place) for place in EYES]
    found = eyes_apart(together(HEAD, *eyes(), *eyes(0.9), *shells))
    names = [part.name for part in found.parts]
    assert names == ["mesh", *4 * [EYEBALL_NAME], *2 * [SHELL_NAME]]
    assert material(found.parts[-1], coloured=False) is None


@pytest.mark.parametrize(
    "surfaces",
    [
        pytest.param(eyes()[:1], id="one ball"),
        pytest.param([(ball(16), 1.0, (x, 0, -9)) for x in (-3, 3)], id="behind"),
        pytest.param([(ball(16), 1.0, (x, 0, 5)) for x in (-11, 11)], id="far apart, as earrings"),
        pytest.param([(ball(16), 1.0, (0, y, 9)) for y in (-3, 3)], id="one above the other"),
        pytest.param([(bowl(16), 1.0, place) for place in EYES], id="half balls"),
        pytest.param([(ball(16), 1.0, EYES[0]), (ball(16), 0.6, EYES[1])], id="unlike"),
    ],
)
def test_other_balls_are_no_eyes(surfaces: list) -> None:
    rig = together(HEAD, *surfaces)
    assert eyes_apart(rig) is rig


def test_what_has_colours_or_names_is_left_as_it_is() -> None:
    rig = together(HEAD, *eyes())
    coloured = replace(rig, colours=np.full((rig.vertex_count, 3), 0.5, np.float32))
    assert eyes_apart(coloured) is coloured
    for look in (PartLook("mesh", (0.5, 0.4, 0.3)), PartLook("eyeball")):
        other = together(HEAD, *eyes(), look=look)
        assert eyes_apart(other) is other
    assert len(eyes_apart(together(HEAD, *eyes(), look=PartLook("mesh", (1.0, 1.0, 1.0)))).parts) == 3


def test_a_scene_shows_them(gl: moderngl.Context) -> None:
    rig = together(HEAD, *eyes())
    scene = Scene(gl, rig)
    wet = [run for run in scene.runs if run.wet]
    assert sum(run.count for run in wet) == 3 * 2 * len(ball(16).triangles)
    assert scene.rig is rig
    scene.release()
