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


def ball(middle: tuple[float, float, float], radius: float, rows: int = 16) -> tuple[np.ndarray, np.ndarray]:
    """A ball of (rows + 1) x rows vertices, and its quadrilaterals."""
    polar, round_ = np.meshgrid(
        np.linspace(0, np.pi, rows + 1), 2 * np.pi * np.arange(rows) / rows, indexing="ij"
    )
    points = np.stack(
        [np.sin(polar) * np.sin(round_), np.cos(polar), np.sin(polar) * np.cos(round_)], axis=-1
    ).reshape(-1, 3)
    at = np.arange(rows * rows).reshape(rows, rows)
    beside = np.roll(at, -1, axis=1)
    faces = np.stack([at, at + rows, beside + rows, beside], axis=-1).reshape(-1, 4)
    return (points * radius + middle).astype(np.float32), faces


def rig_of(name: str, neutral: np.ndarray, faces: np.ndarray, shapes: np.ndarray) -> Rig:
    """A rig of quadrilaterals with shapes s0, s1 …"""
    return build_rig(
        name,
        neutral,
        faces.ravel(),
        np.full(len(faces), 4),
        [(f"s{at}", delta) for at, delta in enumerate(shapes)],
    )
