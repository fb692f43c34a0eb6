"""The curves of the eye opening and of the closed lips."""

from dataclasses import dataclass

import numpy as np

from generator.anatomy import Eye, Mouth
from generator.topology import EYE_LOOP, MOUTH_LOOP
from generator.vectors import Array, Mask, bump, mix, rotation, smoothstep, unit


def lid_margin(eye: Eye) -> Array:
    """Return the open lid margin as (EYE_LOOP, 3) directions from the centre of the left eye.

    The loop starts at the inner corner and runs over the upper lid.
    """
    radius = eye.radius * eye.lid_radius
    count = EYE_LOOP // 2 + 1
    s = -0.45 * np.cos(np.linspace(0, np.pi, count)) + 0.55 * np.linspace(-1, 1, count)  # -1 inner .. 1 outer
    base = mix(eye.inner_corner, eye.outer_corner, (s + 1) / 2)
    rise = eye.upper_opening * (1 - np.abs(s + 0.10 * (1 - s * s)) ** 2.3) ** 0.82
    drop = -eye.lower_opening * (1 - np.abs(s - 0.18 * (1 - s * s)) ** 2.2) ** 0.9
    x = s * np.where(s > 0, eye.half_width, mix(eye.half_width, eye.inner_half_width, smoothstep(0, -1, s)))
    upper, lower = np.stack([x, base + rise], 1), np.stack([x, base + drop], 1)
    for end in (0, -1):
        upper[end] = lower[end] = (x[end], base[end])
    flat = np.concatenate([upper, lower[::-1][1:-1]]) / radius
    depth = np.sqrt(np.maximum(1 - (flat**2).sum(1), 0.01))
    return unit(np.c_[flat, depth]) @ rotation((0, 1, 0), eye.yaw).T


@dataclass(frozen=True, eq=False)
class LipCurves:
    """Closed lips of the left half from the front: MOUTH_LOOP points over the upper lip and back below."""

    along: Array
    """0 in the middle, 1 at the corner."""
    across: Array
    """The same, spread evenly: the share of the half width."""
    upper: Mask
    contact_x: Array
    contact_y: Array
    border_x: Array
    """Where red meets skin."""
    border_y: Array
    taper: Array
    """Fullness of the lip, 1 in the middle and 0 at the corner."""


def lip_curves(mouth: Mouth) -> LipCurves:
    """Return the contact line and the vermilion border, with cupid's bow and lifted corners."""
    half = MOUTH_LOOP // 2
    i = np.arange(MOUTH_LOOP)
    s = 1 - np.abs(i - half) / half
    w = 0.5 * np.sin(np.pi / 2 * s) + 0.5 * s
    upper = i <= half
    contact_y = (
        mouth.height + mouth.corner_lift * w**2.2 - 0.05 * bump(w, 0, 0.22) + 0.05 * bump(w, 0.42, 0.25)
    )
    taper = (1 - w**2.8) ** 0.7
    bow = 1 + 0.10 * bump(w, 0.22, 0.15) - 0.16 * bump(w, 0, 0.11)
    rise = mouth.upper_lip * taper * bow
    drop = mouth.lower_lip * taper * (1 - 0.05 * bump(w, 0, 0.2))
    return LipCurves(
        along=s,
        across=w,
        upper=upper,
        contact_x=mouth.half_width * w,
        contact_y=contact_y,
        border_x=(mouth.half_width + 0.16) * w + 0.03 * w**6,
        border_y=np.where(upper, contact_y + rise, contact_y - drop),
        taper=taper,
    )
