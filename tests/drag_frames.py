"""Measures whole drag frames of the program, windowless: `python tests/drag_frames.py [RIG] [--solver KEY]`.

Everything between a move of the mouse and the finished picture counts: routing, solving, deforming, drawing
and all panels.  Prints a line per gesture: median, 10th and 90th percentile in milliseconds.
"""

import argparse
import os
import platform
from pathlib import Path

import numpy as np

from facepin.panels.help.guide import STEPS, Guide
from support.driver import App, running

GESTURES = {
    "jaw": (("jawOpen",), (0.0, 30.0)),
    "smile": (("mouthSmileLeft", "mouthSmile_L"), (20.0, -20.0)),
    "brow": (("browInnerUp", "browInnerUp_L"), (0.0, -20.0)),
}
"""Names of the shape whose most moved visible vertex is dragged, and how far in pixels."""
FRAMES, WARM_UP = 240, 20


def grip(app: App, names: tuple[str, ...]) -> int:
    """The foremost of the vertices that a shape moves most, of those that are seen."""
    rig, stage = app.session.rig, app.desk.stage
    shape = next(rig.shape_names.index(name) for name in names if name in rig.shape_names)
    moves = np.linalg.norm(rig.rows_at(range(rig.vertex_count))[:, shape].reshape(-1, 3), axis=1)
    seen = np.zeros(rig.vertex_count, bool)
    seen[stage.triangles.ravel()] = True
    return int(np.argmax(np.where(seen & (moves > 0.6 * moves.max()), rig.neutral[:, 2], -np.inf)))


def frame_times(app: App, vertex: int, way: tuple[float, float]) -> np.ndarray:
    """Seconds of every frame while a point is dragged to and fro."""
    (x, y), times = app.pixel_of(vertex), []
    app.press(x, y)
    for share in 0.55 - 0.5 * np.cos(np.linspace(0, 8 * np.pi, FRAMES + WARM_UP)):
        app.move(x + share * way[0], y + share * way[1])
        times.append(app.frame.seconds)
    app.key("escape")
    app.release(x, y)
    return np.array(times[WARM_UP:])


def main() -> None:
    """Measure the gestures on one rig."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rig", nargs="?", type=Path, help="default: the built-in face")
    parser.add_argument("--solver", default="transpose")
    options = parser.parse_args()
    with running(options.rig, options.solver, size=(1280, 720)) as app:
        app.desk.view.guide = Guide(step=len(STEPS))
        app.step(frames=4)
        machine = f"{platform.machine()}, {os.cpu_count()} cores, {app.window.ctx.info['GL_RENDERER']}"
        print(f"{app.session.rig.name}; {machine}")
        for name, (shapes, way) in GESTURES.items():
            low, median, high = np.percentile(1e3 * frame_times(app, grip(app, shapes), way), (10, 50, 90))
            print(f"{name:6} {median:6.2f} ms  ({low:.2f} to {high:.2f})")


if __name__ == "__main__":
    main()
