"""The camera that looks at a face, and the rectangle of pixels it fills."""

from dataclasses import dataclass, replace
from math import cos, isfinite, pi, radians, sin, tan
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from facepin.core.arrays import Floats

View = Literal["front", "left", "right", "back", "top", "three-quarter"]

VIEWS: dict[View, tuple[float, float]] = {
    "front": (0.0, 0.0),
    "left": (pi / 2, 0.0),
    "right": (-pi / 2, 0.0),
    "back": (pi, 0.0),
    "top": (0.0, pi / 2),
    "three-quarter": (radians(35), radians(8)),
}
"""Yaw and pitch of the named views.  "left" shows the side that is left to the character, +x."""


USUAL_LENS = radians(30)
"""Vertical opening angle of the perspective camera."""
PARALLEL = radians(0.1)
"""That of the orthographic one: a lens so long, from so far away, that lines which are parallel are so in a
picture to a fraction of a pixel.  Being a camera like any other, picking and all drawing agree with it."""


@dataclass(frozen=True)
class Viewport:
    """A rectangle of framebuffer pixels, origin top left."""

    x: float
    y: float
    width: float
    height: float

    @property
    def aspect(self) -> float:
        """Width over height; 1 for an empty rectangle (a window can be dragged to nothing)."""
        return self.width / self.height if self.width > 0 and self.height > 0 else 1.0

    def contains(self, px: float, py: float) -> bool:
        """Say whether a pixel lies inside; the right and bottom borders belong to the neighbours."""
        return self.x <= px < self.x + self.width and self.y <= py < self.y + self.height


@dataclass(frozen=True)
class Camera:
    """A perspective camera that circles a target.  With no yaw and pitch it sees the face from the front."""

    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    distance: float = 4.0
    """From the eye to the target, > 0."""
    yaw: float = 0.0
    """Angle about y; positive shows the character's left side."""
    pitch: float = 0.0
    """Angle above the horizon, −π/2..π/2."""
    fov_y: float = USUAL_LENS
    """Full vertical opening angle."""
    least_aspect: float = 0.0
    """Width over height that is seen at least: a narrower picture shows more above and below, instead of
    cutting the sides off."""
    radius: float = 1.0
    """Radius of what is being looked at: sets how far away drawing stops and how close the eye may come."""

    @property
    def axes(self) -> tuple[Floats, Floats, Floats]:
        """Right, up and back of the camera, unit vectors (3,) float64; it looks along −back."""
        sin_yaw, cos_yaw = sin(self.yaw), cos(self.yaw)
        sin_pitch, cos_pitch = sin(self.pitch), cos(self.pitch)
        right = np.array([cos_yaw, 0.0, -sin_yaw])
        up = np.array([-sin_yaw * sin_pitch, cos_pitch, -cos_yaw * sin_pitch])
        back = np.array([sin_yaw * cos_pitch, sin_pitch, cos_yaw * cos_pitch])
        return right, up, back

    @property
    def eye(self) -> Floats:
        """Position of the eye, (3,) float64."""
        return np.array(self.target) + self.distance * self.axes[2]

    @property
    def near(self) -> float:
        """Depth at which drawing and picking start.  A fiftieth of the distance keeps 24-bit depth fine.

        From far away through a long lens it is as far before the face as `far` is behind it.
        """
        return max(self.distance / 50, self.distance - 12 * self.radius)

    @property
    def far(self) -> float:
        """Depth at which drawing ends: room for a face that was panned well away from the target."""
        return self.distance + 12 * self.radius

    def view_matrix(self) -> Floats:
        """World to camera, (4, 4) float64, acting on columns."""
        matrix = np.eye(4)
        matrix[:3, :3] = self.axes
        matrix[:3, 3] = -matrix[:3, :3] @ self.eye
        return matrix

    def projection(self, aspect: float) -> Floats:
        """Camera to clip space of OpenGL (z −1..1), (4, 4) float64, acting on columns."""
        f = 1 / self._slope(aspect)
        near, far = self.near, self.far
        return np.array(
            [
                [f / aspect, 0, 0, 0],
                [0, f, 0, 0],
                [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)],
                [0, 0, -1, 0],
            ]
        )

    def pixel_size(self, viewport: Viewport) -> float:
        """Length in space that one pixel covers at the target's depth."""
        return 2 * self.distance * self._slope(viewport.aspect) / max(viewport.height, 1)

    def _slope(self, aspect: float) -> float:
        """Half the height of what is seen at depth 1."""
        return tan(self.fov_y / 2) * max(self.least_aspect / aspect, 1.0)

    def project(self, points: ArrayLike, viewport: Viewport) -> Floats:
        """Pixel x, pixel y and depth of points.

        Parameters
        ----------
        points : (m, 3) float
            Positions in space.
        viewport : Viewport
            Where the picture is.

        Returns
        -------
        (m, 3) float64
            Depth is the distance in front of the eye along the view.  A point at or behind the eye has no
            pixel, its x and y are NaN.
        """
        local = (np.asarray(points, np.float64).reshape(-1, 3) - self.eye) @ np.stack(self.axes, axis=1)
        depth = -local[:, 2]
        scale = viewport.height / (2 * self._slope(viewport.aspect)) / np.where(depth > 0, depth, np.nan)
        x = viewport.x + viewport.width / 2 + local[:, 0] * scale
        y = viewport.y + viewport.height / 2 - local[:, 1] * scale
        return np.stack([x, y, depth], axis=1)

    def ray(self, pixel: tuple[float, float], viewport: Viewport) -> tuple[Floats, Floats]:
        """Origin (the eye) and unit direction, each (3,) float64, of the ray through a pixel."""
        right, up, back = self.axes
        scale = self.pixel_size(viewport) / self.distance
        x = (pixel[0] - viewport.x - viewport.width / 2) * scale
        y = (viewport.y + viewport.height / 2 - pixel[1]) * scale
        direction = x * right + y * up - back
        return self.eye, direction / np.linalg.norm(direction)

    def plane_point(self, pixel: tuple[float, float], through: ArrayLike, viewport: Viewport) -> Floats:
        """Point (3,) under a pixel in the plane through `through` that faces the camera: where a drag leads.

        A plane at or behind the eye is taken at the near depth instead.
        """
        origin, direction = self.ray(pixel, viewport)
        back = self.axes[2]
        depth = max(float((origin - np.asarray(through, np.float64)) @ back), self.near)
        return origin + direction * (depth / -(direction @ back))

    def orbited(self, dyaw: float, dpitch: float) -> "Camera":
        """Return the camera turned about its target; it stops straight above and straight below."""
        yaw = (self.yaw + dyaw + pi) % (2 * pi) - pi
        return replace(self, yaw=yaw, pitch=min(max(self.pitch + dpitch, -pi / 2), pi / 2))

    def panned(self, dx: float, dy: float, viewport: Viewport) -> "Camera":
        """Return the camera moved so that what lies at the target's depth follows the mouse, in pixels."""
        right, up, _ = self.axes
        return self._aimed(np.array(self.target) + self.pixel_size(viewport) * (dy * up - dx * right))

    def zoomed(
        self, factor: float, at: tuple[float, float] | None = None, viewport: Viewport | None = None
    ) -> "Camera":
        """Return the camera moved closer, so that the target looks `factor` times as large.

        With `at` and its viewport, what lies under that pixel at the target's depth stays there.
        """
        lens = tan(USUAL_LENS / 2) / tan(self.fov_y / 2)  # a longer one sees as much from farther away
        distance = min(max(self.distance / factor, self.radius * lens / 200), self.radius * lens * 100)
        moved = replace(self, distance=distance)
        if at is None or viewport is None:
            return moved
        under = self.plane_point(at, self.target, viewport)
        target = np.array(self.target)
        return moved._aimed(target + (1 - distance / self.distance) * (under - target))

    def focused(self, point: ArrayLike) -> "Camera":
        """Return the camera with its target in the middle of the picture, as deep as a point (3,) is.

        The picture stays the same; coming closer then never leads past that point, and panning follows it.
        A point that is not between near and far changes nothing.
        """
        back = self.axes[2]
        depth = float((self.eye - np.asarray(point, np.float64)) @ back)
        if not self.near <= depth <= self.far:
            return self
        return replace(self, distance=depth)._aimed(self.eye - depth * back)

    @property
    def orthographic(self) -> bool:
        """Whether lines that are parallel in space are parallel in the picture."""
        return self.fov_y <= PARALLEL

    def through(self, *, orthographic: bool) -> "Camera":
        """Return the camera with parallel lines or in perspective; what is at the target keeps its size."""
        fov_y = PARALLEL if orthographic else USUAL_LENS
        distance = self.distance * tan(self.fov_y / 2) / tan(fov_y / 2)
        return replace(self, fov_y=fov_y, distance=distance)

    def looking(self, view: View) -> "Camera":
        """Return the camera turned to a named view, same target and distance."""
        yaw, pitch = VIEWS[view]
        return replace(self, yaw=yaw, pitch=pitch)

    def _aimed(self, target: Floats) -> "Camera":
        x, y, z = (float(c) for c in target)
        return replace(self, target=(x, y, z))


def frame_points(
    points: ArrayLike, aspect: float, camera: Camera | None = None, margin: float = 0.06
) -> Camera:
    """Return a camera that sees all points as large as they fit.

    Parameters
    ----------
    points : (m, 3) float
        What to look at; points that are not finite are left out.
    aspect : float
        Width over height of the picture.
    camera : Camera
        Gives direction and lens, and the least radius of the scene (points may be a part of it).
    margin : float
        Share of the picture left free on each side of the tighter direction.

    Returns
    -------
    Camera
        Looking at the middle of the points' depth.  No points, or a single one, are seen as a ball of the
        camera's radius.
    """
    camera = camera or Camera(radius=0.0)
    points = np.asarray(points, np.float64).reshape(-1, 3)
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        points = np.array([camera.target])
    radius = float(np.linalg.norm(np.ptp(points, axis=0))) / 2
    scene = max(radius, camera.radius) or 1.0
    axes = np.stack(camera.axes)
    if radius == 0:
        points = points[:1] + scene * np.concatenate([axes, -axes])
    x, y, z = axes @ points.T
    # The eye is the apex of the narrowest pyramid round the points: each side is one linear bound on it.
    aspect = aspect if isfinite(aspect) and aspect > 0 else 1.0
    slope_y = camera._slope(aspect) * (1 - 2 * margin)
    slope_x = slope_y * aspect
    right, left = np.max(x + slope_x * z), np.max(-x + slope_x * z)
    top, bottom = np.max(y + slope_y * z), np.max(-y + slope_y * z)
    depth = (z.min() + z.max()) / 2
    eye = max((right + left) / (2 * slope_x), (top + bottom) / (2 * slope_y), z.max() + scene / 100)
    target = np.array([(right - left) / 2, (top - bottom) / 2, depth]) @ axes
    return replace(camera, distance=float(eye - depth), radius=scene)._aimed(target)
