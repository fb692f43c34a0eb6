"""Small meshes made of closed or open strips, and what is computed on any mesh."""

from dataclasses import dataclass

import numpy as np

from generator.vectors import Array, Ints, unit


@dataclass(frozen=True, eq=False)
class Mesh:
    """A part of the character."""

    vertices: Array
    """(n, 3)"""
    triangles: Ints
    """(m, 3) counter-clockwise seen from outside."""
    colours: Array
    """(n, 3) sRGB 0..1."""

    def mirrored(self) -> "Mesh":
        """Return the same part on the other side of the face."""
        return Mesh(self.vertices * np.array([-1.0, 1, 1]), self.triangles[:, [0, 2, 1]], self.colours)

    def welded(self, tolerance: float = 1e-9) -> "Mesh":
        """Return the mesh with coincident vertices merged, as at poles, and empty triangles dropped."""
        cells = np.round(self.vertices / tolerance).astype(np.int64)
        _, first, inverse = np.unique(cells, axis=0, return_index=True, return_inverse=True)
        kept = np.sort(first)
        renamed = np.searchsorted(kept, first)[inverse.ravel()]
        triangles = renamed[self.triangles]
        a, b, c = triangles.T
        whole = (a != b) & (b != c) & (c != a)
        return Mesh(self.vertices[kept], triangles[whole], self.colours[kept])


def joined(first: Mesh, second: Mesh) -> Mesh:
    """Return two meshes as one."""
    return Mesh(
        np.r_[first.vertices, second.vertices],
        np.r_[first.triangles, second.triangles + len(first.vertices)],
        np.r_[first.colours, second.colours],
    )


def face_normals(vertices: Array, triangles: Ints) -> Array:
    """Return (m, 3) normals of twice the area's length."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    result: Array = np.cross(b - a, c - a)
    return result


def vertex_normals(vertices: Array, triangles: Ints) -> Array:
    """Return (n, 3) unit normals, weighted by area."""
    f = face_normals(vertices, triangles)
    total = [np.bincount(triangles.ravel(), np.repeat(f[:, k], 3), len(vertices)) for k in range(3)]
    return unit(np.stack(total, 1))


def strip_triangles(grid: Ints, closed: bool = False) -> Ints:
    """Return the triangles of a grid of vertex indices (rows x columns), a tube when `closed`."""
    rows, count = grid.shape
    triangles: list[tuple[int, int, int]] = []
    for i in range(rows - 1):
        for j in range(count if closed else count - 1):
            k = (j + 1) % count
            a, b, c, d = grid[i, j], grid[i + 1, j], grid[i + 1, k], grid[i, k]
            triangles += [(a, b, c), (a, c, d)]
    found = np.array(triangles)
    a, b, c = found.T
    kept: Ints = found[(a != b) & (b != c) & (a != c)]
    return kept


def strips(rows: list[Array], closed: bool = False) -> tuple[Array, Ints]:
    """Return vertices and triangles of equally long rows of points."""
    vertices = np.concatenate(rows)
    return vertices, strip_triangles(np.arange(len(vertices)).reshape(len(rows), -1), closed)


def outwards(vertices: Array, triangles: Ints) -> Ints:
    """Return the triangles of a nearly closed mesh, turned so that they face outwards."""
    centres = vertices[triangles].mean(1) - vertices.mean(0)
    volume = (face_normals(vertices, triangles) * centres).sum()
    return triangles if volume > 0 else triangles[:, [0, 2, 1]]
