"""Small pictures with a name, as the library and the filmstrip show them."""

from typing import Protocol

from imgui_bundle import imgui

from facepin.panels.theme import packed


class Tile(Protocol):
    """Where a picture lies in a texture; see `facepin.gpu.atlas`."""

    @property
    def texture(self) -> int:
        """OpenGL's number of the texture."""

    @property
    def upper_left(self) -> tuple[float, float]:
        """Texture coordinates of that corner."""

    @property
    def lower_right(self) -> tuple[float, float]:
        """Texture coordinates of that corner."""


def draw_tile(
    draw: imgui.ImDrawList, tile: Tile | None, at: imgui.ImVec2, corner: imgui.ImVec2, rounding: float
) -> None:
    """Draw a picture between two corners; its place alone while there is none yet."""
    if tile is None:
        draw.add_rect_filled(at, corner, imgui.get_color_u32(imgui.Col_.frame_bg), rounding)
        return
    draw.add_image_rounded(
        imgui.ImTextureRef(tile.texture),
        at,
        corner,
        imgui.ImVec2(*tile.upper_left),
        imgui.ImVec2(*tile.lower_right),
        packed((1, 1, 1, 1)),
        rounding,
    )


def shortened(text: str, width: float) -> str:
    """Cut a text that is too long for its place."""
    if imgui.calc_text_size(text).x <= width:
        return text
    low, high = 0, len(text)
    while low < high:
        middle = (low + high + 1) // 2
        if imgui.calc_text_size(text[:middle].rstrip() + "…").x <= width:
            low = middle
        else:
            high = middle - 1
    return text[:low].rstrip() + "…"
