"""Many small pictures in few textures."""

import moderngl
import numpy as np
import pytest

from facepin.gpu import atlas
from facepin.gpu.atlas import Atlas, Tile


def picture(value: int, side: int = 4) -> np.ndarray:
    image = np.full((side, side, 4), value, np.uint8)
    image[0, :, 3] = 7  # the first row is told from the others
    return image


def shown(pages: Atlas, tile: Tile) -> np.ndarray:
    """Fetch the pixels that a tile stands for."""
    page = next(page for page in pages._pages if page.glo == tile.texture)
    whole = np.frombuffer(page.read(), np.uint8).reshape(page.height, page.width, 4)
    (left, top), (right, bottom) = tile.upper_left, tile.lower_right
    x, y = int(left * page.width), int(top * page.height)
    assert round((right - left) * page.width + 1) == pages.cell
    assert round((bottom - top) * page.height + 1) == pages.cell
    return whole[y : y + pages.cell, x : x + pages.cell]


def test_pictures_are_found_again_and_replaced(gl: moderngl.Context) -> None:
    pages = Atlas(gl, 4)
    assert pages.tile("none") is None
    for value in range(70):  # more than a page holds
        pages.put(value, picture(value))
    pages.put(3, picture(200))
    for value in range(70):
        tile = pages.tile(value)
        assert tile is not None
        np.testing.assert_array_equal(shown(pages, tile), picture(200 if value == 3 else value))
    assert len(pages._pages) == 2
    pages.release()


def test_the_longest_unused_makes_room(gl: moderngl.Context, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(atlas, "ROW", 2)
    monkeypatch.setattr(atlas, "MOST_PAGES", 1)
    pages = Atlas(gl, 4)
    for value in range(4):
        pages.put(value, picture(value))
    assert pages.tile(0) is not None  # used just now
    pages.put(4, picture(4))
    assert pages.tile(1) is None
    for value in (0, 2, 3, 4):
        tile = pages.tile(value)
        assert tile is not None
        np.testing.assert_array_equal(shown(pages, tile), picture(value))
    assert len(pages._pages) == 1
    pages.release()
