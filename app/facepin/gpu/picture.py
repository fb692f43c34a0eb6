"""Pictures without a window."""

import io
import os
from collections.abc import Callable
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from facepin import platforms
from facepin.core.arrays import Points
from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera, Viewport
from facepin.core.look.shading import Shading
from facepin.core.rig import Rig
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import Framing, frame, tile
from facepin.gpu.markers import MarkerLayer, Markers
from facepin.gpu.pane import BARE, Overlays, draw_pane
from facepin.gpu.scene import PaneMesh, Scene

Image = NDArray[np.uint8]

Overlay = Callable[[Canvas, Framing, float], None]
"""Draws something over a picture, or over a tile of it, with so many pixels per point."""

TILE = 2048
"""Largest width and height drawn at once: under every limit, and it bounds the memory of many samples."""


def open_context() -> moderngl.Context:
    """Open an OpenGL 3.3 core context without a window: EGL, else what the system offers.

    Raises
    ------
    FacepinError
        When there is neither, with what the system said.
    """
    platforms.spare_a_full_disk(os.environ)
    complaints = []
    for backend in ("egl", "default"):
        choice: dict[str, Any] = {} if backend == "default" else {"backend": backend}
        try:
            return moderngl.create_context(require=330, standalone=True, **choice)
        except Exception as error:  # the very class that moderngl and glcontext raise
            complaints.append(f"{backend}: {' '.join(str(error).split())}")
    raise FacepinError(f"no OpenGL 3.3 on this machine ({'; '.join(complaints)}); pictures need it")


def render_picture(
    ctx: moderngl.Context,
    rig: Rig,
    positions: Points,
    normals: Points,
    camera: Camera,
    size: tuple[int, int],
    *,
    transparent: bool = False,
    samples: int = 4,
    supersampling: int = 1,
    heat: Points | None = None,
    wireframe: bool = False,
    ghost: tuple[Points, Points] | None = None,
    shading: Shading = "studio",
    scale: float = 1.0,
    markers: Markers | None = None,
) -> Image:
    """Draw one picture of a posed face.

    Parameters
    ----------
    positions, normals : (n, 3) float32
        The pose.
    size : (int, int)
        Width and height in pixels, any: large pictures are drawn in tiles.
    transparent : bool
        Leave out the background; straight (not premultiplied) alpha.
    samples : int
        Multisampling, as far as the machine goes.
    supersampling : int
        Draw this many times larger in both directions and average.
    heat : (n,) float32
        How far each vertex moved, in shares of the top of the heat scale, to be shown as colours.
    wireframe : bool
        Draw the edges of the faces.
    ghost : ((n, 3), (n, 3)) float32
        Positions and normals of another pose that shines through.
    shading : Shading
        What colours the face where `heat` does not.
    scale : float
        Pixels of the picture per point: 2 to look like a HiDPI screen.
    markers : Markers
        Pins to draw over the face.

    Returns
    -------
    (h, w, 4) uint8
        RGBA, first row on top.

    Raises
    ------
    FacepinError
        For a size or factor below 1.
    """
    width, height = size
    if min(width, height, supersampling) < 1:
        raise FacepinError(
            f"a picture of {width}x{height} times {supersampling} cannot be drawn (at least 1x1)"
        )
    scene, layer = Scene(ctx, rig), MarkerLayer(ctx) if markers is not None else None
    mesh, shell = PaneMesh(scene), PaneMesh(scene) if ghost is not None else None

    def pins(canvas: Canvas, framing: Framing, scale: float) -> None:
        if layer is not None and markers is not None:
            layer.draw_framed(canvas, framing, markers, scale=scale)

    try:
        mesh.upload(positions, normals)
        if shell is not None and ghost is not None:
            shell.upload(*ghost)
        while not scene.refined:
            scene.refine()
        return draw_picture(
            mesh,
            camera,
            size,
            transparent=transparent,
            samples=samples,
            supersampling=supersampling,
            overlays=Overlays(heat, wireframe, shell, shading),
            scale=scale,
            overlay=pins,
        )
    finally:
        for item in (mesh, shell, layer, scene):
            if item is not None:
                item.release()


def draw_picture(
    mesh: PaneMesh,
    camera: Camera,
    size: tuple[int, int],
    *,
    transparent: bool = False,
    samples: int = 4,
    supersampling: int = 1,
    overlays: Overlays = BARE,
    scale: float = 1.0,
    overlay: Overlay | None = None,
) -> Image:
    """Draw like `render_picture`, for a mesh that is on the graphics card already.

    Parameters
    ----------
    overlays : Overlays
        Heat map, wireframe, ghost.
    scale : float
        Pixels of the picture per point: 2 to look like a HiDPI screen.
    overlay : Overlay
        Draws more over all of that, such as pins.
    """
    factor = supersampling
    width, height = size
    whole = frame(camera, Viewport(0, 0, width * factor, height * factor))
    step = max(TILE // factor, 1)
    picture = np.zeros((height, width, 4), np.uint8)
    canvas = Canvas(mesh.scene.ctx, samples)
    try:
        for y in range(0, height, step):
            for x in range(0, width, step):
                w, h = min(step, width - x), min(step, height - y)
                canvas.resize(w * factor, h * factor)
                framing = tile(whole, x * factor, y * factor, w * factor, h * factor)
                if transparent:
                    canvas.clear()
                else:
                    mesh.scene.background.draw_framed(canvas, [framing])
                draw_pane(canvas, framing, mesh, overlays, fine=True, scale=scale * factor)
                if overlay is not None:
                    overlay(canvas, framing, scale * factor)
                picture[y : y + h, x : x + w] = _averaged(canvas.read(), factor)
    finally:
        canvas.release()
    return _straight_alpha(picture) if transparent else picture


def png_bytes(image: Image) -> bytes:
    """Return a (h, w, 4) or (h, w, 3) uint8 picture as a PNG file; an opaque one is stored as RGB."""
    from PIL import Image as Pillow

    if image.shape[2] == 4 and (image[..., 3] == 255).all():
        image = image[..., :3]
    file = io.BytesIO()
    Pillow.fromarray(np.ascontiguousarray(image)).save(file, "PNG")
    return file.getvalue()


def _averaged(image: Image, factor: int) -> Image:
    """Mean of blocks of factor x factor pixels, premultiplied as drawn."""
    if factor == 1:
        return image
    h, w = image.shape[0] // factor, image.shape[1] // factor
    blocks: NDArray[Any] = image.reshape(h, factor, w, factor, 4)
    mean: Image = np.rint(blocks.mean(axis=(1, 3), dtype=np.float32)).astype(np.uint8)
    return mean


def _straight_alpha(image: Image) -> Image:
    """Divide by alpha: over transparent black, the samples of a pixel average to colour times alpha."""
    alpha = image[..., 3:].astype(np.float32)
    colour = np.minimum(np.rint(image[..., :3] * (255 / np.maximum(alpha, 1))), 255)
    return np.concatenate([colour.astype(np.uint8), image[..., 3:]], axis=2)
