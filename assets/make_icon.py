"""Draws the icon, a smile pulled up by a pin: `python assets/make_icon.py` writes assets/icon."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

FOLDER = Path(__file__).resolve().parent / "icon"
SIZES = (16, 24, 32, 48, 64, 128, 256)

GROUND_TOP, GROUND_BOTTOM = (0.200, 0.209, 0.232), (0.105, 0.110, 0.125)
LINE = (0.93, 0.93, 0.94)
ACCENT = (0.98, 0.62, 0.24)
EYES = ((-0.24, -0.16), (0.24, -0.16))
"""Middles of the eyes; the picture goes from -0.5 to 0.5, y down."""
MOUTH_LEFT, MOUTH_LOW, MOUTH_RIGHT = (-0.27, 0.13), (0.02, 0.37), (0.27, 0.10)
"""Ends and turning point of the smile, a quadratic curve; the pin holds its right end."""

Samples = NDArray[np.float64]


def draw(size: int) -> Image.Image:
    """Return the icon with a number of pixels per side; small ones have bolder lines."""
    bold = 1.0 + 7.0 / size
    samples = 8 if size <= 64 else 3  # per pixel and axis
    at = (np.arange(size * samples) + 0.5) / (size * samples) - 0.5
    x, y = np.meshgrid(at, at)
    share = (y + 0.5)[..., None]
    ground = np.array(GROUND_TOP) * (1 - share) + np.array(GROUND_BOTTOM) * share
    colour = np.broadcast_to(ground, (*x.shape, 3)).copy()
    inside = _rounded_square(x, y, half=0.48, radius=0.13) <= 0

    mouth = _curve(x, y, MOUTH_LEFT, MOUTH_LOW, MOUTH_RIGHT)
    colour[mouth <= 0.036 * bold] = LINE
    for eye in EYES:
        colour[np.hypot(x - eye[0], (y - eye[1]) / 1.35) <= 0.052 * bold] = LINE
    pin = np.hypot(x - MOUTH_RIGHT[0], y - MOUTH_RIGHT[1])
    colour = np.where(pin[..., None] <= 0.138 * bold, ground, colour)  # a gap sets the pin off from the smile
    colour[pin <= 0.102 * bold] = ACCENT

    pixels = np.concatenate([colour * inside[..., None], inside[..., None]], axis=-1)
    means = pixels.reshape(size, samples, size, samples, 4).mean(axis=(1, 3))
    alpha = means[..., 3:]
    means[..., :3] /= np.where(alpha > 0, alpha, 1)
    return Image.fromarray((255 * means + 0.5).astype(np.uint8), "RGBA")


def _rounded_square(x: Samples, y: Samples, half: float, radius: float) -> Samples:
    """Return the distance to a square with rounded corners, negative inside."""
    dx, dy = np.abs(x) - half + radius, np.abs(y) - half + radius
    return np.hypot(np.maximum(dx, 0), np.maximum(dy, 0)) + np.minimum(np.maximum(dx, dy), 0) - radius


def _curve(
    x: Samples,
    y: Samples,
    start: tuple[float, float],
    control: tuple[float, float],
    end: tuple[float, float],
) -> Samples:
    """Return the distance to a quadratic Bézier curve, as the least one to many of its points."""
    least = np.full(x.shape, np.inf)
    for t in np.linspace(0, 1, 96):
        a, b, c = (1 - t) ** 2, 2 * t * (1 - t), t**2
        px, py = (a * s + b * m + c * e for s, m, e in zip(start, control, end, strict=True))
        np.minimum(least, np.hypot(x - px, y - py), out=least)
    return least


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for size in SIZES:
        draw(size).save(FOLDER / f"facepin-{size}.png", optimize=True)
