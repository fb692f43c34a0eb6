"""How far vertices moved, as colours: the scale and the colours of the heat map."""

from dataclasses import dataclass
from math import floor, log10

import numpy as np

from facepin.core.arrays import Floats

FULL = 0.05
"""About the move, as a share of the face height, that the top of the scale stands for."""
STEPS = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
"""Round numbers that a scale counts in."""
COUNT = 3
"""Steps from 0 to the top."""

STOPS = ("#626367", "#576cb7", "#9371cb", "#d476b6", "#f8898a", "#ffab61", "#ffcf50", "#fcf271")
"""sRGB from nothing to the top: grey, then blue, red, yellow, ever lighter.  What changes most, lightness and
blue against yellow, is what people see who confuse red and green."""
BEYOND = "#ffffff"
"""More than the top."""


@dataclass(frozen=True)
class HeatScale:
    """From 0 to `top`, a length, in steps that are round numbers."""

    step: float

    @property
    def top(self) -> float:
        """The largest move that has a colour of its own."""
        return COUNT * self.step

    @property
    def ticks(self) -> tuple[float, ...]:
        """0, the steps, the top."""
        return tuple(step * self.step for step in range(COUNT + 1))


def heat_scale(height: float) -> HeatScale:
    """Return the scale for a face of this height (> 0): always the same, so that drags can be compared."""
    wanted = FULL * height / COUNT
    unit = 10.0 ** floor(log10(wanted))
    return HeatScale(min((step * unit for step in STEPS), key=lambda step: abs(step - wanted)))


def heat_colours(count: int = 256) -> Floats:
    """Return sRGB colours 0..1 (count, 3) of moves from 0 to the top, in steps that look equal."""
    stops = oklab(hex_colours(STOPS))
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(stops, axis=0), axis=1))])
    wanted = np.linspace(0, along[-1], count)
    return from_oklab(np.stack([np.interp(wanted, along, axis) for axis in stops.T], axis=1))


def hex_colours(codes: tuple[str, ...]) -> Floats:
    """Return #rrggbb codes as (m, 3) float64, 0..1."""
    return np.array([[int(code[at : at + 2], 16) / 255 for at in (1, 3, 5)] for code in codes])


# Ottosson's OKLab (2020): distances are close to what people see.
_TO_CONES = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_TO_LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)


def oklab(srgb: Floats) -> Floats:
    """Return lightness, green-red, blue-yellow (m, 3) of sRGB colours (m, 3)."""
    light = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    lab: Floats = np.cbrt(light @ _TO_CONES.T) @ _TO_LAB.T
    return lab


def from_oklab(lab: Floats) -> Floats:
    """Undo `oklab`; what no screen can show is clipped."""
    light = (lab @ np.linalg.inv(_TO_LAB).T) ** 3 @ np.linalg.inv(_TO_CONES).T
    light = np.clip(light, 0, 1)
    srgb: Floats = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return srgb
