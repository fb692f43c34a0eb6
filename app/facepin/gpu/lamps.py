"""Where the lamps of the studio stand: beside the camera, so that every view is well lit."""

from dataclasses import dataclass

import moderngl
import numpy as np

from facepin.gpu.framing import Framing, column_major

LAMPS = np.array(
    [
        (-0.60, 0.70, 0.80),  # key: large, warm, upper left
        (0.90, 0.10, 0.62),  # fill: weak, cool, from the right
        (0.80, 0.45, -0.75),  # rim: from behind, to the right
        (-0.95, 0.15, -0.55),  # back: from behind, to the left
    ]
)
"""Directions to them from the face: right, up and back of the camera.  Their colours are in studio.glsl."""
LAMPS /= np.linalg.norm(LAMPS, axis=1, keepdims=True)


@dataclass(frozen=True)
class Sight:
    """What shaders that light a face need to know of a framing, as numbers of uniforms."""

    to_picture: tuple[float, ...]
    """World to clip space."""
    eye: tuple[float, ...]
    """Where the camera stands."""
    camera: tuple[float, ...]
    """Its right, up and back, one after another."""
    lamps: tuple[float, ...]
    """Unit vectors to the lamps in the world, one after another."""
    ray_of_pixel: tuple[float, ...]

    def tell(self, program: moderngl.Program) -> None:
        """Set those of these uniforms that a program has."""
        for name in ("to_picture", "eye", "camera", "lamps", "ray_of_pixel"):
            if name in program:
                program[name] = getattr(self, name)


def sight(framing: Framing) -> Sight:
    """Return what a framing means for lit faces."""
    axes, offset = framing.to_view[:3, :3], framing.to_view[:3, 3]
    return Sight(
        column_major(framing.to_clip @ framing.to_view),
        tuple((-offset @ axes).tolist()),
        tuple(axes.ravel().tolist()),
        tuple((LAMPS @ axes).ravel().tolist()),
        framing.ray_of_pixel,
    )
