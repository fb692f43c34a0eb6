"""What is clear or cut out is neither drawn nor pressed."""

from dataclasses import replace

import numpy as np
import pytest

from facepin.core.look.alpha import Presence, is_blended, is_clear
from facepin.core.look.camera import Camera, Viewport
from facepin.core.mesh.picking import Hit, pick
from facepin.core.rig import Part, Rig, Texture
from facepin.core.rig_builder import PartLook, build_rig

VIEWPORT = Viewport(0, 0, 100, 100)
HALF = np.full((2, 2, 4), 255, np.uint8)
HALF[:, 0, 3] = 0
"""Its left half is not there."""


def card_before_skin(**look: object) -> Rig:
    """A square card of two triangles, vertices 4 to 7, before one of skin, vertices 0 to 3."""
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    points = np.concatenate([square, square + np.array([0, 0, 0.5])])
    rig = build_rig(
        "card",
        points,
        np.arange(8),
        [4, 4],
        [("move", np.ones_like(points))],
        parts=[PartLook("skin"), PartLook("card")],
        face_parts=[0, 1],
        texture_places=np.tile([[0, 1], [1, 1], [1, 0], [0, 0]], (2, 1)),
    )
    skin, card = rig.parts
    return replace(rig, parts=(skin, replace(card, **look)))


def pressed(rig: Rig, x: float) -> Hit | None:
    present = Presence(rig, [part for part in rig.parts if not is_clear(part)])
    camera = Camera((0, 0, 0), 5.0)
    return pick(rig.neutral, present.triangles, camera, VIEWPORT, (x, 50.0), present=present)


@pytest.mark.parametrize(
    ("look", "left", "right"),
    [
        ({}, True, True),
        ({"texture": Texture(HALF)}, True, True),
        ({"texture": Texture(HALF), "cutout": 0.5}, False, True),
        ({"texture": Texture(HALF), "cutout": 0.5, "opacity": 0.4}, False, False),
        ({"texture": Texture(HALF), "blends": True}, False, True),
        ({"blends": True, "opacity": 0.0}, False, False),
        ({"blends": True, "opacity": 0.4}, False, False),
        ({"blends": True, "opacity": 0.8}, True, True),
        ({"opacity": 0.0}, False, False),
        ({"transmission": 1.0}, False, False),
        ({"transmission": 0.2}, True, True),
    ],
)
def test_a_press_takes_what_is_there(look: dict, left: bool, right: bool) -> None:
    rig = card_before_skin(**look)
    for x, on_card in ((40.0, left), (60.0, right)):
        hit = pressed(rig, x)
        assert hit is not None
        assert (hit.vertex >= 4) == on_card


def part(**look: object) -> Part:
    return Part("part", range(1), range(1), **look)


def test_what_is_said_to_blend_but_is_solid_is_drawn_as_solid() -> None:
    solid = Texture(np.full((2, 2, 4), 255, np.uint8))
    assert not is_blended(part(blends=True))
    assert not is_blended(part(blends=True, texture=solid))
    assert is_blended(part(blends=True, texture=Texture(HALF)))
    assert is_blended(part(blends=True, opacity=0.4))
    assert is_blended(part(transmission=0.5))
    assert not is_blended(part(cutout=0.5, texture=Texture(HALF)))


def test_what_nothing_is_seen_of_is_clear() -> None:
    assert is_clear(part(blends=True, opacity=0.0))
    assert is_clear(part(transmission=1.0))
    assert is_clear(part(cutout=0.5, opacity=0.4, texture=Texture(HALF)))
    assert not is_clear(part(blends=True, opacity=0.4, cutout=0.5))
    assert not is_clear(part())
