"""Rigs small enough to check by hand."""

from pathlib import Path

import numpy as np

from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig


def sheet(columns: int = 9, rows: int = 9, shapes: int = 4, seed: int = 1) -> Rig:
    """A flat sheet of quads, 2 units wide, facing +z; each of its smooth random shapes moves a part."""
    x, y = np.meshgrid(np.linspace(-1, 1, columns), np.linspace(1, -1, rows))
    neutral = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    at = np.arange(columns * rows).reshape(rows, columns)
    quads = np.stack([at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]], axis=-1).reshape(-1, 4)
    random = np.random.default_rng(seed)
    deltas = []
    for j in range(shapes):
        middle = random.uniform(-0.6, 0.6, 2)
        near = np.exp(-8 * ((neutral[:, :2] - middle) ** 2).sum(axis=1))
        near[near < 0.02] = 0
        deltas.append((f"shape{j}", near[:, None] * random.uniform(-0.5, 0.5, 3)))
    return build_rig("sheet", neutral, quads.ravel(), np.full(len(quads), 4), deltas)


def write_sheet(path: Path) -> Path:
    """Write the sheet as a file."""
    small = sheet()
    deltas = small.deltas.toarray().T.reshape(small.shape_count, -1, 3)
    np.savez(
        path, neutral=small.neutral, faces=small.triangles, deltas=deltas, names=np.array(small.shape_names)
    )
    return path
