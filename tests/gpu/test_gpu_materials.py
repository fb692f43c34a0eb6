"""What parts look like."""

import numpy as np
import pytest

from facepin.core.mesh.topology import draw_order
from facepin.core.rig import Part
from facepin.core.rig_builder import PartLook, build_rig
from facepin.gpu.materials import CLAY, SMOOTHEST, linear, material, material_runs
from support.gpu_help import ball


def part(name: str, **look: object) -> Part:
    return Part(name, range(1), range(1), **look)


def test_linear_light_is_what_the_standard_says() -> None:
    np.testing.assert_allclose(
        linear(np.array([0, 0.04, 0.5, 1, 2])), [0, 0.0030960, 0.2140411, 1, 1], rtol=1e-5
    )


@pytest.mark.parametrize("name", ["eyeL", "M_ScleraLeft", "left_eye", "Eyeball_R", "M_IrisRight"])
def test_eyes_are_wet(name: str) -> None:
    look = material(part(name), coloured=True)
    assert look is not None and look.wet


@pytest.mark.parametrize("name", ["tongue", "gums", "skin", "hair"])
def test_what_is_smooth_is_no_eye(name: str) -> None:
    look = material(part(name, roughness=0.0), coloured=True)
    assert look is not None and not look.wet
    assert look.roughness == SMOOTHEST


@pytest.mark.parametrize("name", ["skin", "M_Face", "eyelid_upper", "neck", "greyeyes_shirt"])
def test_the_rest_is_clay(name: str) -> None:
    assert material(part(name), coloured=False) == CLAY


def test_the_file_counts_first() -> None:
    look = material(part("teeth", colour=(0.1, 0.2, 0.3), roughness=0.9), coloured=False)
    assert look is not None
    assert look.colour == (0.1, 0.2, 0.3)
    assert look.roughness == 0.9


def test_white_is_no_colour() -> None:
    assert material(part("skin", colour=(1.0, 1.0, 1.0)), coloured=False) == CLAY


def test_clear_shells_are_left_out_unless_they_have_a_colour() -> None:
    assert material(part("M_EyeOcclusion"), coloured=False) is None
    assert material(part("lashL"), coloured=True) is not None
    assert material(part("lashL", colour=(0.1, 0.1, 0.1)), coloured=False) is not None


def test_equal_neighbours_are_drawn_together() -> None:
    one = ball(6)
    count, faces = one.vertex_count, len(one.triangles)
    points = np.concatenate([one.neutral + np.array([3 * i, 0, 0]) for i in range(4)])
    corners = np.concatenate([one.triangles.ravel() + i * count for i in range(4)])
    rig = build_rig(
        "four",
        points,
        corners,
        np.full(4 * faces, 3),
        [("move", np.ones_like(points))],
        parts=[PartLook("skin"), PartLook("neck"), PartLook("tears"), PartLook("ear")],
        face_parts=np.repeat(np.arange(4), faces),
    )
    runs = material_runs(rig, draw_order(rig).runs)
    assert [(run.first, run.count) for run in runs] == [(0, 6 * faces), (9 * faces, 3 * faces)]
