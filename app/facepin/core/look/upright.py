"""Which way a face is up and where it looks: by what its file says, else by what its shapes do."""

import re

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.extent import busy_vertices
from facepin.core.rig import Rig
from facepin.core.turn import AS_IN_FILE, Turn, facing

DOWN = "jawopen|jawdrop|mouthopen|openmouth|mtha$|mouthlowerdown|eyeblink|blink|eyeclose|eyesclose|browdown"
UP = "browinnerup|browouterup|browup|browsup|browraise|mouthupperup|nosesneer"
"""Names (small letters only) of shapes that move their part of any face down, and up."""
CLEARLY = 0.1
"""How far what shapes move is from the middle of the head, in its own size, to be clearly in front of it."""
EXPRESSION = "jaw|mouth|mth|lip|smile|brow|brw|eye|blink|nose|cheek"
"""Of names of shapes that move the front of a head; others may be for another build of it."""


def upright(rig: Rig) -> Turn:
    """Return the turn after which y is up and the face looks along z; none where nothing tells.

    What shapes move is in front of a head, whatever its file says: not all exporters turn what they should.
    Where that is not clear the file is believed; where it does not say what is up, jaws fall and lids close
    downwards.
    Where nothing says where it looks, it is left as it is; where z is up, it looks as is usual then.
    """
    up = np.array(rig.up) if rig.up is not None else _up(rig)
    if up is None:
        return AS_IN_FILE
    front, clearly = _front(rig, up)
    if rig.front is not None and not clearly:
        front = np.array(rig.front)
    if front is None:
        return AS_IN_FILE if up[1] > abs(up[2]) else facing(up, (0, -1, 0)) or AS_IN_FILE
    return facing(up, front) or AS_IN_FILE


def _up(rig: Rig) -> Floats | None:
    """Return where up is as shapes tell by their names, (3,), None where none does or they disagree."""
    votes = []
    for at, name in enumerate(rig.shape_names):
        word = re.sub("[^a-z]", "", name.lower())
        for pattern, sign in ((DOWN, -1.0), (UP, 1.0)):
            if re.search(pattern, word):
                start, stop = rig.deltas.indptr[at : at + 2]
                axes, values = rig.deltas.indices[start:stop] % 3, rig.deltas.data[start:stop]
                total = np.bincount(axes, values, 3)
                length = float(np.linalg.norm(total))
                votes += [sign * total / length] if length else []
                break
    if not votes:
        return None
    up: Floats = np.mean(votes, axis=0)
    # No file has a face upside down: then the names mean something else.
    return up if float(np.linalg.norm(up)) > 0.5 and up[1] > -0.5 else None


def _front(rig: Rig, up: Floats) -> tuple[Floats | None, bool]:
    """Return where the skin that shapes move faces, (3,) at right angles to `up`, and whether that is clear.

    None where that is to the inside of the head: then its triangles may be inside out.
    """
    named = [at for at, name in enumerate(rig.shape_names) if re.search(EXPRESSION, name.lower())]
    busy = busy_vertices(rig.deltas[:, named] if named else rig.deltas)
    skin = rig.triangles[busy[rig.triangles].all(axis=1)]
    if not len(skin):
        return None, False
    a, b, c = (rig.neutral[corner].astype(np.float64) for corner in skin.T)
    front = np.cross(b - a, c - a).sum(axis=0)
    face = rig.neutral[busy].astype(np.float64)
    low, high = face.min(axis=0), face.max(axis=0)
    near = (np.abs(rig.neutral - (low + high) / 2) <= 1.5 * (high - low).max()).all(axis=1)
    away = face.mean(axis=0) - rig.neutral[near].mean(axis=0)
    tall = int(np.argmax(np.abs(up)))
    front[tall] = away[tall] = 0.0
    outwards = float(front @ away) / max(float(np.linalg.norm(front)), 1e-30)
    if outwards < 0.0 or not front.any():
        return None, False
    return front, outwards > CLEARLY * float((high - low).max())
