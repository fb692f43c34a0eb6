"""How open to the light every vertex is: what gives lids, nostrils, lips and the throat their depth.

Ambient occlusion, baked once per rig from depth maps seen from all around.  It is computed a little at a
time, so that the first picture does not wait for it.
"""

from collections.abc import Generator

import moderngl
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from facepin.core.arrays import Floats, Indices, Points
from facepin.core.mesh.topology import DrawOrder
from facepin.core.rig import Rig
from facepin.gpu.canvas import release_framebuffer
from facepin.gpu.framing import column_major
from facepin.gpu.materials import EYEBALL, Run, by_name, cull_hidden
from facepin.gpu.programs import load_program

DIRECTIONS, MORE_DIRECTIONS = 60, 16
"""Views of the neutral, and of each pose that shows what it hides."""
RESOLUTION = 256
"""Width and height of a depth map."""
LIFT = 0.006
"""Height above the skin where light is measured, in radii of the face: more than a step of the depth map."""
CONTRAST = 1.5
"""By how much shadows of lamps are sharper than a plane through what is seen of the room would have them."""
OPENED_SHARE = 0.8
"""How much of the light in an open mouth counts: teeth are seen, and closed lips keep their line."""
OPENING = ("jawopen", "mouthupperup", "mouthlowerdown", "eyewide")
"""Parts of the names, without underscores, of the shapes that show what the neutral hides inside."""
NEAR = 0.006
"""How far light is spread in a round of smoothing, in heights of the face."""
LID = 0.01
"""How far lids move at least, in heights of the face."""
CLOSING = ("blink", "eyesclosed")
"""Of those that show the lids, of which the neutral hides most in a fold."""
EYES_OPEN = 0.6
"""Least openness of eyeballs: what the lids cover in the neutral comes out when the gaze turns."""


class Openness:
    """The baking of one rig."""

    def __init__(
        self,
        ctx: moderngl.Context,
        rig: Rig,
        order: DrawOrder,
        runs: tuple[Run, ...],
        indices: moderngl.Buffer,
    ) -> None:
        """Prepare for what is drawn: `runs` of the triangles of `order`, which are in `indices`."""
        self.values: Points = np.ones(rig.vertex_count, np.float32)
        """(n,) share of the light that arrives; 1 until all is done."""
        self.towards: Points = np.zeros((rig.vertex_count, 3), np.float32)
        """(n, 3) along the surface: with a unit vector from the skin, the dot product is how much more light
        than that arrives from there.  Chins, brows and noses so cast soft shadows wherever a lamp stands."""
        self._steps = self._bake(ctx, rig, order, runs, indices)

    def step(self, count: int) -> bool:
        """Look from `count` more directions; return True as long as there are more."""
        return all(next(self._steps, None) is not None for _ in range(count))

    def release(self) -> None:
        """Stop, done or not, and give the graphics memory back."""
        self._steps.close()

    def _bake(
        self,
        ctx: moderngl.Context,
        rig: Rig,
        order: DrawOrder,
        runs: tuple[Run, ...],
        indices: moderngl.Buffer,
    ) -> Generator[int]:
        sides = outer_sides(rig, order, runs)
        maps = _DepthMaps(ctx, rig.vertex_count, runs, indices)
        try:
            baked = []
            everywhere = np.ones(rig.vertex_count, np.float32)
            poses = [(rig.neutral, DIRECTIONS, everywhere), (opened(rig), MORE_DIRECTIONS, everywhere)]
            if (closed := posed(rig, CLOSING)) is not None:
                moved = np.linalg.norm(closed - rig.neutral, axis=1) > LID * rig.height
                poses.append((closed, MORE_DIRECTIONS, moved.astype(np.float32)))
            for positions, count, where in poses:
                # In front of the surface and behind it: shares, and their moments along the surface.
                arrived = np.zeros((2, rig.vertex_count, 4), np.float32)
                offered = np.zeros((2, rig.vertex_count, 4), np.float32)
                offered[..., 0] = 1e-6
                normals = vertex_normals(positions, rig.triangles)
                maps.take(positions)
                for step, direction in enumerate(directions(count)):
                    facing = normals @ direction.astype(np.float32)
                    lift = np.where(facing < 0, -LIFT, LIFT).astype(np.float32)
                    seen = maps.seen_from(direction, lift[:, None] * normals)
                    moments = np.ones((rig.vertex_count, 4), np.float32)
                    moments[:, 1:] = direction - facing[:, None] * normals
                    for side, weight in enumerate(np.maximum([facing, -facing], 0)):
                        offered[side] += weight[:, None] * moments
                        arrived[side] += (weight * seen)[:, None] * moments
                    yield step
                baked.append((*_chosen(sides, *_opening(arrived, offered)), where))
        finally:
            maps.release()
        (values, towards, _), *others = baked
        # The open mouth counts for what the closed one hides: teeth are seen, and necks keep their shadow.
        for share, from_where, where in others:
            revealed = OPENED_SHARE * np.sqrt(share)
            hidden = where * np.clip(1 - 2 * values, 0, 1) * (revealed > values)
            values = (values + hidden * (revealed - values)).astype(np.float32)
            towards = (towards + hidden[:, None] * (from_where - towards)).astype(np.float32)
        self.values = smoothed(values, rig, 4)
        for part in rig.parts:
            if by_name(part) is EYEBALL:
                eyes = np.unique(rig.triangles[part.triangles.start : part.triangles.stop])
                self.values[eyes] = np.maximum(self.values[eyes], EYES_OPEN)
        self.towards = smoothed(towards, rig, 10)


def _opening(arrived: Points, offered: Points) -> tuple[Points, Points]:
    """Return the share of light (2, n), and where along the surface it comes from, (2, n, 3)."""
    total = offered[..., :1]
    share: Points = arrived[..., :1] / total
    # Light from everywhere, weighted by the cosine, has a mean square of 1/4 along any line in the surface.
    towards: Points = np.float32(4 * CONTRAST) * (arrived[..., 1:] - share * offered[..., 1:]) / total
    return share[..., 0], towards


def _chosen(sides: NDArray[np.int8], share: Points, towards: Points) -> tuple[Points, Points]:
    """Return what counts of the front and the back: the side that is lit, else the one that is more open."""
    front = (sides > 0) | ((sides == 0) & (share[0] >= share[1]))
    return (
        np.where(front, share[0], share[1]),
        np.where(front[:, None], towards[0], towards[1]),
    )


class _DepthMaps:
    """Depth maps of a face from far away, one at a time."""

    def __init__(
        self, ctx: moderngl.Context, vertices: int, runs: tuple[Run, ...], indices: moderngl.Buffer
    ) -> None:
        self._ctx = ctx
        self._runs = runs
        self._program = load_program(ctx, "depth")
        self._depth = ctx.depth_texture((RESOLUTION, RESOLUTION))
        self._framebuffer = ctx.framebuffer(depth_attachment=self._depth)
        self._buffer = ctx.buffer(reserve=12 * vertices)
        self._mesh = ctx.vertex_array(self._program, [(self._buffer, "3f", "position")], indices)

    def take(self, positions: Points) -> None:
        """Look at another pose, scaled to a ball of radius 1."""
        middle = (positions.min(axis=0) + positions.max(axis=0)) / 2
        points = positions - middle
        radius = 1.01 * float(np.linalg.norm(points, axis=1).max())
        self._points = (points / np.float32(radius or 1.0)).astype(np.float32)
        self._buffer.write(np.ascontiguousarray(self._points))

    def seen_from(self, direction: Floats, lift: Points) -> NDArray[np.bool_]:
        """Say of every vertex, moved by `lift` (n, 3), whether nothing hides it from `direction`."""
        axes = _axes(direction)
        matrix = np.eye(4)
        matrix[:3, :3] = axes
        self._program["to_clip"] = column_major(matrix)
        self._framebuffer.use()
        self._framebuffer.clear(depth=1.0)
        self._ctx.depth_func = "<"
        for run in self._runs:
            cull_hidden(self._ctx, run)
            self._mesh.render(moderngl.TRIANGLES, vertices=run.count, first=run.first)
        nearest = np.frombuffer(self._depth.read(), np.float32).reshape(RESOLUTION, RESOLUTION)
        x, y, z = axes.astype(np.float32) @ (self._points + lift).T
        cells = [np.clip(((c + 1) * (RESOLUTION / 2)).astype(np.intp), 0, RESOLUTION - 1) for c in (y, x)]
        seen: NDArray[np.bool_] = nearest[tuple(cells)] * 2 - 1 > z - LIFT / 2
        return seen

    def release(self) -> None:
        """Give the graphics memory back."""
        release_framebuffer(self._framebuffer)
        for item in (self._mesh, self._buffer, self._program):
            item.release()


def outer_sides(rig: Rig, order: DrawOrder, runs: tuple[Run, ...]) -> NDArray[np.int8]:
    """Which side of the surface at each vertex is lit, (n,) int8: 1 the front, -1 the back, 0 both."""
    sides = np.zeros(rig.vertex_count, np.int8)
    corners = order.triangles.ravel()
    for run in sorted(runs, key=lambda run: run.hidden is None):  # both wins where runs meet
        sides[corners[run.first : run.first + run.count]] = {"back": 1, "front": -1, None: 0}[run.hidden]
    return sides


def opened(rig: Rig) -> Points:
    """Return positions with mouth and eyes open by the names of shapes, else with the one that moves most."""
    found = posed(rig, OPENING)
    if found is not None or not rig.shape_count:
        return rig.neutral if found is None else found
    weights = np.zeros(rig.shape_count)
    weights[int(np.argmax(rig.largest_moves))] = 1.0
    return rig.evaluate(weights)


def posed(rig: Rig, parts: tuple[str, ...]) -> Points | None:
    """Return positions (n, 3) with all shapes whose names have one of these parts; None when there is none.

    Numbers at the end are those of shapes on the way to another one.
    """
    names = [name.lower().replace("_", "") for name in rig.shape_names]
    weights = np.array(
        [float(any(part in name for part in parts) and not name[-1:].isdigit()) for name in names]
    )
    return rig.evaluate(weights) if weights.any() else None


def directions(count: int) -> Floats:
    """Directions spread evenly over the sphere, (count, 3) float64 unit vectors: Fibonacci's spiral."""
    at = np.arange(count) + 0.5
    height, turn = 1 - 2 * at / count, np.pi * (3 - 5**0.5) * at
    across = np.sqrt(1 - height**2)
    return np.stack([across * np.cos(turn), height, across * np.sin(turn)], axis=1)


def vertex_normals(positions: Points, triangles: Indices) -> Points:
    """Area-weighted unit normals (n, 3) float32; zero where a vertex has no area round it."""
    a, b, c = (positions[corner] for corner in triangles.T)
    areas = np.cross(b - a, c - a)
    sums = [np.bincount(triangles.ravel(), np.repeat(area, 3), len(positions)) for area in areas.T]
    normals = np.stack(sums, axis=1)
    lengths = np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(np.float32).tiny)
    units: Points = (normals / lengths).astype(np.float32)
    return units


def smoothed(values: Points, rig: Rig, rounds: int) -> Points:
    """Mix values (n,) or (n, m) with those of near neighbours: hides the steps of few directions.

    Near is what is within some thousandths of the face, or as far as neighbours are in the mean: where
    triangles are long and narrow, shadows would run along them if all neighbours counted the same.
    """
    a, b, c = rig.triangles.T
    start, end = np.concatenate([a, b, c, b, c, a]), np.concatenate([b, c, a, a, b, c])
    lengths, count = np.linalg.norm(rig.neutral[start] - rig.neutral[end], axis=1), rig.vertex_count
    mean = np.bincount(start, lengths, count) / np.maximum(np.bincount(start, minlength=count), 1)
    far = lengths / np.maximum(mean, NEAR * rig.height)[start]
    around = csr_array((np.exp(-0.5 * far * far).astype(np.float32), (start, end)), shape=(count, count))
    own = 1 + np.asarray(around.sum(axis=1), np.float32)
    own = own[:, None] if values.ndim > 1 else own
    for _ in range(rounds):
        values = (values + around @ values) / own
    return values.astype(np.float32)


def _axes(direction: Floats) -> Floats:
    """Right, down and away (3, 3) of a view against `direction`; depth grows away from it."""
    up = np.array([0.0, 1.0, 0.0]) if abs(direction[1]) < 0.9 else np.array([1.0, 0.0, 0.0])
    right = np.cross(up, direction)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(right, direction), -direction])
