"""Sparse operators on functions of the vertices of a mesh."""

import numpy as np
import scipy.sparse as sp

from generator.vectors import Array, Ints


def bilaplacian(vertices: Array, triangles: Ints) -> sp.csr_matrix:
    """Return the (n, n) square of the cotangent Laplacian, with clamped cotangents and areas."""
    n, corners = len(vertices), vertices[triangles]
    weights = sp.csr_matrix((n, n))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        u, v = corners[:, i] - corners[:, k], corners[:, j] - corners[:, k]
        sine = np.maximum(np.linalg.norm(np.cross(u, v), axis=1), 1e-6)
        cotangent = np.clip((u * v).sum(1) / sine, 0.08, 4) / 2
        weights = (
            weights + sp.coo_matrix((cotangent, (triangles[:, i], triangles[:, j])), shape=(n, n)).tocsr()
        )
    weights = weights + weights.T
    laplacian = sp.diags(np.asarray(weights.sum(1)).ravel()) - weights
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(cross, axis=1) / 2
    mass = np.maximum(np.bincount(triangles.ravel(), np.repeat(area / 3, 3), n), 0.004)
    return (laplacian @ sp.diags(1 / mass) @ laplacian).tocsr()


def mean_of_neighbours(count: int, triangles: Ints) -> sp.csr_matrix:
    """Return the (n, n) matrix that averages over the other ends of a vertex's edges."""
    ends = np.concatenate([triangles[:, [i, j]] for i, j in ((0, 1), (1, 2), (2, 0))])
    ends = np.concatenate([ends, ends[:, ::-1]])
    joined = sp.coo_matrix((np.ones(len(ends)), ends.T), shape=(count, count)).tocsr()
    joined.data[:] = 1
    return (sp.diags(1 / np.asarray(joined.sum(1)).ravel()) @ joined).tocsr()
