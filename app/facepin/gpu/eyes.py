"""Irises for eyes without colours: where a face looks is half of its expression."""

import numpy as np

from facepin.core.arrays import Floats, Points

IRIS = np.radians(27.0)
"""Half opening angle seen from the middle of the eyeball, as in people."""
COLOURS = np.array([(0.02, 0.02, 0.03), (0.16, 0.27, 0.33), (0.28, 0.42, 0.48), (0.10, 0.16, 0.20)])
"""sRGB 0..1 of the pupil, the iris at the pupil, its middle, and its dark rim."""
ANGLES = np.radians([8.0, 11.0, 19.0, 26.0])
"""Where these colours are."""


def paint_iris(points: Points, white: tuple[float, float, float]) -> Points:
    """Colours of the vertices of one eye, or of both, that looks along +z as faces do in the neutral.

    Parameters
    ----------
    points : (m, 3) float32
        Vertices of an eyeball, or of two beside each other.
    white : (3,) float
        sRGB colour of what is not iris.

    Returns
    -------
    (m, 3) float32
        sRGB 0..1.
    """
    colours = np.tile(np.asarray(white, np.float32), (len(points), 1))
    if not len(points):
        return colours
    width, height, _ = np.ptp(points, axis=0)
    middle = points[:, 0].min() + width / 2
    left = points[:, 0] > middle if width > 1.8 * height else np.ones(len(points), bool)
    for eye in (left, ~left):
        if eye.sum() >= 8:
            angle = gaze_angle(points[eye].astype(np.float64))
            ring = np.stack([np.interp(angle, ANGLES, channel) for channel in COLOURS.T], axis=1)
            share = np.clip((IRIS - angle) / np.radians(2.0) + 0.5, 0, 1)[:, None]
            colours[eye] = share * ring + (1 - share) * colours[eye]
    return colours


def gaze_angle(points: Floats) -> Floats:
    """Angle (m,) from +z to each point of an eyeball, seen from the middle of a ball fitted to its front."""
    front = points[points[:, 2] >= np.median(points[:, 2])]
    # |p|² = 2 p·c + (r² − |c|²) is linear in the middle c.
    system = np.concatenate([2 * front, np.ones((len(front), 1))], axis=1)
    solution = np.linalg.lstsq(system, (front**2).sum(axis=1), rcond=None)[0]
    away = points - solution[:3]
    angles: Floats = np.arctan2(np.hypot(away[:, 0], away[:, 1]), away[:, 2])
    return angles
