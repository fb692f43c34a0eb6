"""What places of a face are called."""

from pathlib import Path

import numpy as np
import pytest

from facepin.core.look.camera import Camera, Viewport, frame_points
from facepin.core.mesh.picking import pick
from facepin.core.pose import Pin
from facepin.core.rig import Rig
from facepin.core.shapes.places import Places, find_places, titles
from facepin.files.formats import open_rig
from facepin.resources import builtin_faces
from support.small_rigs import sheet

SIZE = Viewport(0, 0, 800, 800)


@pytest.fixture(scope="module", params=["ada", "bruno", "mira", "ict"])
def face(request: pytest.FixtureRequest) -> tuple[Rig, Places]:
    """A face with names, and what its places are called."""
    if request.param == "ict":
        shared: Path = request.getfixturevalue("shared")
        rig = open_rig(shared / "models/ict-facekit/ict_expressions.glb")
    else:
        rig = open_rig(builtin_faces()[request.param])
    return rig, find_places(rig)


def strongest(rig: Rig, *names: str) -> int:
    """The vertex that a shape moves most."""
    bare = [name.replace("_", "").lower() for name in rig.shape_names]
    j = next(bare.index(name) for name in names if name in bare)
    moves = np.linalg.norm(rig.deltas[:, [j]].toarray().reshape(-1, 3), axis=1)
    return int(np.argmax(moves))


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (("eyeblinkleft", "eyeblinkl"), {"upper lid, left"}),
        (("eyeblinkright", "eyeblinkr"), {"upper lid, right"}),
        (("browouterupleft", "browouterupl"), {"brow, left"}),
        (("nosesneerleft", "nosesneerl"), {"nose, left", "cheek, left"}),
        (("mouthsmileleft", "mouthsmilel"), {"mouth corner, left"}),
        (("mouthlowerdownright", "mouthlowerdownr"), {"lower lip, right"}),
        (("mouthupperupleft", "mouthupperupl"), {"upper lip, left", "nose, left"}),
    ],
)
def test_where_a_shape_moves_most_is_called_after_what_it_moves(
    face: tuple[Rig, Places], names: tuple[str, ...], expected: set[str]
) -> None:
    rig, places = face
    assert places.title(strongest(rig, *names)) in expected


def test_the_middle_has_no_side_and_the_front_reads_down_from_the_forehead(face: tuple[Rig, Places]) -> None:
    rig, places = face
    camera = frame_points(rig.neutral, 1.0, Camera(radius=0.0))
    seen = []
    for row in range(0, 800, 4):
        hit = pick(rig.neutral, rig.triangles, camera, SIZE, (400.0, float(row)))
        if hit is not None:
            title = places.title(hit.vertex).split(",")[0]
            seen += [title] if title not in seen else []
    wanted = ["forehead", "nose", "upper lip", "lower lip", "chin", "neck"]
    assert [title for title in seen if title in wanted] == wanted
    x = rig.neutral[:, 0]
    assert "," not in places.title(int(np.argmin(np.abs(x) + np.where(places.sides == 0, 0, 9e9))))
    assert (places.sides[x > 0.05 * rig.height] == 1).all()


def test_parts_are_called_by_their_names() -> None:
    rig = open_rig(builtin_faces()["ada"])
    places = find_places(rig)

    def vertex(name: str) -> int:
        part = next(part for part in rig.parts if part.name == name)
        return int(rig.triangles[part.triangles.start, 0])

    assert places.title(vertex("eyeL")) == "eyeball, left"
    assert places.region(vertex("hair")) == "hair"
    assert places.title(vertex("earR")) == "ear, right"
    assert places.region(vertex("shirt")) == "shirt"


def test_names_that_say_nothing_are_not_guessed_at() -> None:
    rig = sheet()
    places = find_places(rig)
    assert places.title(0) == "skin, right"
    assert places.title(8) == "skin, left"
    assert places.title(4) == "skin"


def test_pins_in_one_place_are_numbered_and_names_of_the_user_win() -> None:
    places = find_places(sheet())
    pins = [Pin(0, (0, 0, 0)), Pin(8, (0, 0, 0)), Pin(9, (0, 0, 0)), Pin(17, (0, 0, 0), name="ear")]
    assert titles(places, pins) == {0: "skin, right 1", 8: "skin, left", 9: "skin, right 2", 17: "ear"}
    pins = [Pin(0, (0, 0, 0)), Pin(17, (0, 0, 0), name="skin, right")]
    assert titles(places, pins) == {0: "skin, right 1", 17: "skin, right"}
