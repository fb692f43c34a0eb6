"""Joins a character and its shapes into the arrays of a rig."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from generator.character import MATERIALS, Character, swapped
from generator.deformer import SkinDeformer
from generator.shape import Shape
from generator.shapes_eyes import LID_SHAPES, brow_shapes, lid_shapes
from generator.shapes_jaw import ROUNDED, jaw_shapes
from generator.shapes_mouth import mouth_shapes
from generator.shapes_production import production_shapes
from generator.vectors import MIRROR, Array, Ints

ARKIT = (
    "browDownLeft", "browDownRight", "browInnerUp", "browOuterUpLeft", "browOuterUpRight", "cheekPuff",
    "cheekSquintLeft", "cheekSquintRight", "eyeBlinkLeft", "eyeBlinkRight", "eyeLookDownLeft",
    "eyeLookDownRight", "eyeLookInLeft", "eyeLookInRight", "eyeLookOutLeft", "eyeLookOutRight",
    "eyeLookUpLeft", "eyeLookUpRight", "eyeSquintLeft", "eyeSquintRight", "eyeWideLeft", "eyeWideRight",
    "jawForward", "jawLeft", "jawOpen", "jawRight", "mouthClose", "mouthDimpleLeft", "mouthDimpleRight",
    "mouthFrownLeft", "mouthFrownRight", "mouthFunnel", "mouthLeft", "mouthLowerDownLeft",
    "mouthLowerDownRight", "mouthPressLeft", "mouthPressRight", "mouthPucker", "mouthRight",
    "mouthRollLower", "mouthRollUpper", "mouthShrugLower", "mouthShrugUpper", "mouthSmileLeft",
    "mouthSmileRight", "mouthStretchLeft", "mouthStretchRight", "mouthUpperUpLeft", "mouthUpperUpRight",
    "noseSneerLeft", "noseSneerRight", "tongueOut",
)  # fmt: skip
"""The 52 shapes by their exact names, alphabetical."""
SMALLEST = 1e-4
"""Shorter motions of a coordinate are dropped: they cost memory and show nothing."""
CLOSING_LIFT = 0.08
"""How far (in eyeball radii) wide-open lids rise while they close: their way is longer than a blink's."""
CROWDED = {("eyeSquintLeft", "cheekSquintLeft"): 0.8, ("cheekSquintLeft", "mouthSmileLeft"): 0.5}
"""Pairs that both lift the cheek, and the share of the first one's lift that is not added to the other's."""
OPENING = ("eyeWide", "eyeLookUp", "eyeUpperUp")


@dataclass(frozen=True, eq=False)
class FaceModel:
    """A finished rig."""

    character: Character
    names: tuple[str, ...]
    deltas: Array
    """(k, n, 3)"""
    combo_pairs: Ints
    """(c, 2) pairs of shapes whose weights are multiplied."""
    combo_deltas: Array
    """(c, n, 3) added by the product of both weights: a blink takes back what others do to the lids, and an
    open jaw makes pursed lips round."""

    def posed(self, weights: dict[str, float]) -> Array:
        """Return the (n, 3) vertices at the given weights; a name without side stands for both sides."""
        w = np.zeros(len(self.names))
        for name, value in weights.items():
            for full in (name,) if name in self.names else (name + "Left", name + "Right"):
                w[self.names.index(full)] += value
        products = w[self.combo_pairs[:, 0]] * w[self.combo_pairs[:, 1]]
        posed = self.character.vertices.copy()
        for k in np.flatnonzero(w):
            posed += w[k] * self.deltas[k]
        for k in np.flatnonzero(products):
            posed += products[k] * self.combo_deltas[k]
        return posed


def build_model(character: Character, production: bool = False) -> FaceModel:
    """Return the rig of a character with the ARKit shapes, and those of a production rig when asked for."""
    deformer = SkinDeformer(character.skin, character.anatomy)
    shapes = _left_shapes(character, deformer)
    if production:
        shapes |= production_shapes(character, deformer, shapes)
    for name in list(shapes):
        if "Left" in name:
            shapes[swapped(name)] = _mirrored(shapes[name], character, deformer)
    names = (*ARKIT, *sorted(shapes.keys() - set(ARKIT)))
    follow = _Followers(character)
    deltas = np.stack([follow.all_parts(shapes[name]) for name in names])
    products = _blink_products(shapes, character, deformer)
    for (one, other), share in CROWDED.items():
        for pair in ((one, other), (swapped(one), swapped(other))):
            products[pair] = follow.all_parts(Shape(-share * shapes[pair[0]].beside_lids))
    for name, motion in ROUNDED.items():
        products["jawOpen", name] = follow.all_parts(Shape(deformer.mouth(motion)))
    pairs = sorted(products, key=lambda pair: (names.index(pair[0]), names.index(pair[1])))
    return FaceModel(
        character,
        names,
        deltas,
        combo_pairs=np.array([[names.index(name) for name in pair] for pair in pairs]),
        combo_deltas=np.stack([products[pair] for pair in pairs]),
    )


def _left_shapes(character: Character, deformer: SkinDeformer) -> dict[str, Shape]:
    """Return the left and the symmetrical shapes; motions of one name from several regions are added."""
    shapes = jaw_shapes(character, deformer) | lid_shapes(character, deformer)
    for more in (brow_shapes(character, deformer), mouth_shapes(deformer)):
        for name, skin in more.items():
            old = shapes.get(name)
            skin = deformer.slide_on_eyes(skin + old.skin) if old else deformer.slide_on_eyes(skin)
            shapes[name] = Shape(skin, old.parts, old.lid) if old else Shape(skin)
    return shapes


def _mirrored(shape: Shape, character: Character, deformer: SkinDeformer) -> Shape:
    """Return a shape of the left side carried over to the right."""
    parts: dict[str, Array] = {}
    for name, moved in shape.parts.items():
        other = swapped(name)
        if other == name:
            place = character.place(name)
            _, opposite = cKDTree(place).query(place * MIRROR)
            moved = moved[opposite]
        parts[other] = moved * MIRROR
    lid = None if shape.lid is None else deformer.mirrored(shape.lid)
    return Shape(deformer.mirrored(shape.skin), parts, lid)


class _Followers:
    """Carries displacements of the skin over to the parts that lie on it."""

    def __init__(self, character: Character) -> None:
        self._character = character
        tree = cKDTree(character.skin.vertices)
        self._under: dict[str, tuple[Ints, Array]] = {}
        for name in ("browL", "browR"):
            distance, nearest = tree.query(character.place(name), k=10)
            weight = np.exp(-((distance / 0.55) ** 2)) + 1e-9
            self._under[name] = np.asarray(nearest), weight / weight.sum(1, keepdims=True)
        roots = character.lash_roots
        self._roots = {"lashL": roots, "lashR": character.skin.mirror[roots]}

    def all_parts(self, shape: Shape) -> Array:
        """Return the (n, 3) displacement of the whole character."""
        moved = np.zeros_like(self._character.vertices)
        moved[self._character.at("skin")] = shape.skin
        for name, (nearest, weight) in self._under.items():
            moved[self._character.at(name)] = (shape.skin[nearest] * weight[..., None]).sum(1)
        for name, roots in self._roots.items():
            moved[self._character.at(name)] = shape.skin[roots]
        for name, own in shape.parts.items():
            moved[self._character.at(name)] = own
        moved[np.abs(moved) < SMALLEST] = 0
        return moved


def _blink_products(
    shapes: dict[str, Shape], character: Character, deformer: SkinDeformer
) -> dict[tuple[str, str], Array]:
    """Return (blink, other shape) -> (n, 3) displacement that takes back the other's motion of the lids."""
    closed = LID_SHAPES["eyeBlinkLeft"][:2]
    lift = deformer.lids(*closed, lift=CLOSING_LIFT).skin - deformer.lids(*closed).skin
    products: dict[tuple[str, str], Array] = {}
    for name, shape in shapes.items():
        blink = "eyeBlink" + ("Left" if "Left" in name else "Right")
        if shape.lid is None or name == blink:
            continue
        lash = "lashL" if "Left" in name else "lashR"
        rise = lift if "Left" in name else deformer.mirrored(lift)
        roots = character.lash_roots if lash == "lashL" else deformer.mirror[character.lash_roots]
        opens = float(name.startswith(OPENING))
        moved = np.zeros_like(character.vertices)
        moved[character.at("skin")] = opens * rise - shape.lid
        moved[character.at(lash)] = opens * rise[roots] - shape.parts[lash]
        moved[np.abs(moved) < SMALLEST] = 0
        products[blink, name] = moved
    return products


def arrays(model: FaceModel) -> dict[str, np.ndarray]:
    """Return the arrays of the rig's file, by name."""
    character = model.character
    return {
        "neutral": character.vertices.astype(np.float32),
        "faces": character.triangles.astype(np.int32),
        "deltas": model.deltas.astype(np.float32),
        "names": np.array(model.names),
        "colors": character.colours.astype(np.float32),
        "part": character.part.astype(np.uint8),
        "part_names": np.array(list(MATERIALS)),
        "part_mats": np.array(list(MATERIALS.values()), np.float32),
        "gloss": character.gloss.astype(np.float32),
        "mirror": character.mirror().astype(np.int32),
        "combo_pairs": model.combo_pairs.astype(np.int32),
        "combo_deltas": model.combo_deltas.astype(np.float32),
    }
