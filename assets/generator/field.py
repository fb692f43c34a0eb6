"""The head as one signed distance field: blended ellipsoids and capsules (cubic smooth minimum)."""

from collections.abc import Sequence

import numpy as np

from generator.anatomy import Anatomy, Ball, Bone
from generator.vectors import Array, mix, repeated, rotation, smoothstep

TETRAHEDRON: Array = np.array([(1, -1, -1), (-1, -1, 1), (-1, 1, -1), (1, 1, 1)], float)
"""Directions of the four-point gradient."""


def join(a: Array, b: Array, blend: float | Array) -> Array:
    """Return the smooth union of two distances over `blend`."""
    h = np.maximum(blend - np.abs(a - b), 0) / blend
    result: Array = np.minimum(a, b) - h * h * h * blend / 6
    return result


def cut(a: Array, b: Array, blend: float) -> Array:
    """Return `a` with `b` smoothly taken away."""
    return -join(-a, b, blend)


def ball(points: Array, form: Ball, frame: Array | None = None) -> Array:
    """Return (n,) approximate distances to an ellipsoid, turned by the (3, 3) `frame`."""
    q = points - np.array(form.centre, float)
    if frame is not None:
        q = q @ frame
    radii = np.array(form.radii, float)
    k0 = np.linalg.norm(q / radii, axis=1)
    k1 = np.linalg.norm(q / radii**2, axis=1)
    result: Array = k0 * (k0 - 1) / np.maximum(k1, 1e-9)
    return result


def bone(points: Array, form: Bone) -> Array:
    """Return (n,) distances to a capsule whose radius changes linearly."""
    a, b = np.array(form.start, float), np.array(form.end, float)
    axis = b - a
    t = np.clip((points - a) @ axis / (axis @ axis), 0, 1)
    result: Array = np.linalg.norm(points - a - t[:, None] * axis, axis=1) - mix(*form.radii, t)
    return result


def folded(points: Array, softness: float) -> Array:
    """Return the points with the right side folded onto the left, without a crease in the middle."""
    return np.stack([np.sqrt(points[:, 0] ** 2 + softness), points[:, 1], points[:, 2]], 1)


class HeadField:
    """Signed distance to the skin of a character, and the questions asked of it."""

    def __init__(self, anatomy: Anatomy) -> None:
        self.anatomy = anatomy

    def distance(self, points: Array, lids: bool = True) -> Array:
        """Return (n,) distances at (n, 3) points, negative inside; without `lids` the sockets are empty."""
        skull, eye = self.anatomy.skull, self.anatomy.eye
        side, soft = folded(points, 0.03), folded(points, 0.8)
        d = ball(points, skull.cranium)
        d = join(d, ball(points, skull.forehead), skull.forehead.blend)
        d = join(d, ball(points, skull.face), skull.face.blend)
        d = join(d, bone(soft, skull.jaw), skull.jaw.blend)
        d = join(d, ball(points, skull.chin), skull.chin.blend)
        d = join(d, ball(side, skull.cheek), skull.cheek.blend)
        d = join(d, ball(soft, skull.buccal), skull.buccal.blend)
        d = join(d, ball(points, skull.muzzle), skull.muzzle.blend)
        d = join(d, bone(soft, skull.brow_ridge), skull.brow_ridge.blend)
        neck = join(bone(points, skull.neck), ball(points, skull.shoulders), skull.shoulders.blend)
        neck = join(neck, bone(side, skull.neck_muscle), skull.neck_muscle.blend)
        d = join(d, neck, skull.neck.blend)
        from_eye = np.linalg.norm(side - np.array(eye.centre), axis=1)
        socket = mix(1.06, eye.socket, smoothstep(-0.5, 1.2, points[:, 1] - eye.centre[1]))
        d = cut(d, from_eye - eye.radius * socket, 1.5)
        d = self._with_nose(d, points, side)
        d = join(d, ball(side, skull.brow_fill), skull.brow_fill.blend)
        d = cut(d, bone(side, skull.inner_canthus), skull.inner_canthus.blend)
        for pad in skull.pads:
            d = join(d, ball(side, pad), pad.blend)
        for furrow in skull.furrows:
            d = cut(d, bone(side, furrow), furrow.blend)
        if lids:
            x, y = side[:, 0] - eye.centre[0], points[:, 1] - eye.centre[1]
            upper = 0.62 + 0.58 * smoothstep(0.8, 2.0, x) + 0.28 * smoothstep(-0.2, -1.4, x)
            blend = mix(1.5, upper, smoothstep(-0.7, 0.5, y))
            d = join(d, from_eye - eye.radius * eye.lid_radius, blend)
        return d

    def _with_nose(self, d: Array, points: Array, side: Array) -> Array:
        nose = self.anatomy.nose
        n = bone(points, nose.bridge)
        n = join(n, ball(points, nose.tip), nose.tip.blend)
        n = join(n, ball(side, nose.wing, rotation((0, 1, 0), nose.wing_yaw)), nose.wing.blend)
        n = join(n, bone(points, nose.columella), nose.columella.blend)
        d = join(d, n, nose.bridge.blend)
        d = cut(d, ball(side, nose.nostril, rotation((0, 1, 0), nose.nostril_yaw)), nose.nostril.blend)
        return cut(d, bone(points, nose.philtrum), nose.philtrum.blend)

    def gradient(self, points: Array, step: float = 0.01) -> Array:
        """Return the (n, 3) gradient of the distance, the outward normal on the skin."""
        n = len(points)
        f = self.distance(np.concatenate([points + step * v for v in TETRAHEDRON])).reshape(4, n)
        result: Array = f.T @ TETRAHEDRON / (4 * step)
        return result

    def project(self, points: Array, rounds: int = 3) -> Array:
        """Return the points moved onto the skin by `rounds` Newton steps."""
        for _ in range(rounds):
            g = self.gradient(points)
            step = self.distance(points) / np.maximum((g * g).sum(1), 0.05)
            points = points - np.clip(step, -0.4, 0.4)[:, None] * g
        return points

    def raycast(
        self, origins: Array, directions: Array, reach: float, steps: int = 72, lids: bool = True
    ) -> Array:
        """Return the outermost (n, 3) skin points on rays, found by marching inwards from `reach`."""
        low, high = np.zeros(len(origins)), np.full(len(origins), float(reach))
        pending = np.ones(len(origins), bool)
        for t in np.linspace(reach, 0, steps):
            inside = self.distance(origins[pending] + t * directions[pending], lids) < 0
            hit = np.flatnonzero(pending)[inside]
            low[hit], high[hit] = t, t + reach / (steps - 1)
            pending[hit] = False
            if not pending.any():
                break
        for _ in range(18):
            middle = (low + high) / 2
            inside = self.distance(origins + middle[:, None] * directions, lids) < 0
            low, high = np.where(inside, middle, low), np.where(inside, high, middle)
        hit_points: Array = origins + ((low + high) / 2)[:, None] * directions
        return hit_points

    def front(self, x: Array, y: Array) -> Array:
        """Return the (n,) depth z of the face seen from the front at (x, y)."""
        origins = np.stack([x, y, np.full(len(x), 2.0)], 1)
        return self.raycast(origins, repeated((0, 0, 1), len(x)), 10)[:, 2]

    def occlusion(self, points: Array, normals: Array, probes: Sequence[tuple[float, float]]) -> Array:
        """Return (n,) openness 0..1: how little of the head lies at each (distance, share) outwards."""
        open_share = np.ones(len(points))
        for step, share in probes:
            open_share -= share * np.clip(1 - self.distance(points + normals * step) / step, 0, 1)
        return open_share
