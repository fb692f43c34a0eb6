"""What the meshes of a glTF scene add up to: vertices, triangles and parts, and which targets move them."""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points
from facepin.core.errors import FacepinError
from facepin.core.rig_builder import PartLook
from facepin.files.gltf.accessors import accessor_count, read_floats
from facepin.files.gltf.document import GltfDocument
from facepin.files.gltf.materials import linear_to_srgb, material_factor, part_look, shine_of
from facepin.files.gltf.scene import Placed
from facepin.files.gltf.shape_names import ShapeKey
from facepin.files.gltf.skins import vertex_transforms
from facepin.files.gltf.targets import combined_targets, rest_weights
from facepin.files.gltf.textures import Textures, places_key, texture_places
from facepin.files.gltf.triangles import TRIANGLES, has_triangles, outward, read_triangles
from facepin.files.safely.checked_json import JsonObject

IDENTITY = np.eye(3, 4)
PIECE = 32
"""How many vertices a primitive or a target counts for: so much work it is, however small."""


@dataclass(frozen=True, eq=False)
class Block:
    """Vertices of one primitive at one node: rows `start` .. `start + count` of the rig."""

    start: int
    count: int
    linear: Floats | None
    """What carries its deltas from mesh to scene: (3, 3), or (count, 3, 3) where a skin bends it; None for
    nothing."""
    textured: bool = False
    """Whether it is known where its vertices are in the texture of the primitive."""


BlockKey = tuple[object, ...]


@dataclass
class Assembly:
    """What has been gathered so far while the scene is walked."""

    document: GltfDocument
    positions: list[Points] = field(default_factory=list)
    colours: list[Points | None] = field(default_factory=list)
    places: list[Points | None] = field(default_factory=list)
    """Where vertices are in their texture, if they have one."""
    triangles: list[NDArray[np.int64]] = field(default_factory=list)
    parts: list[PartLook] = field(default_factory=list)
    vertices: int = 0
    corners: int = 0
    pieces: int = 0
    shapes: dict[ShapeKey, list[tuple[Block, int]]] = field(default_factory=dict)
    """Blocks that a shape or combination moves, and their delta accessors."""
    combined: dict[ShapeKey, tuple[ShapeKey, ShapeKey]] = field(default_factory=dict)
    """Which of them are combinations, and of which shapes."""
    rest: dict[ShapeKey, float] = field(default_factory=dict)
    """Weights that the file asks for; those of combinations count for nothing."""
    warnings: list[str] = field(default_factory=list)
    textures: Textures = field(init=False)

    def __post_init__(self) -> None:
        self.textures = Textures(self.document, self.warnings)

    def grow(self, vertices: int, corners: int, pieces: int) -> None:
        """Count what is about to be added; a small file that repeats itself into a huge rig is refused."""
        self.vertices += vertices
        self.corners += corners
        self.pieces += pieces
        self.document.check_growth(max(self.vertices, self.corners, PIECE * self.pieces), "meshes")

    def add_mesh(self, place: Placed, keys: list[ShapeKey]) -> None:
        """Add the primitives of a mesh; those that share their vertices keep sharing them."""
        weights, problems = rest_weights(place, len(keys))
        self.warnings += problems
        self.combined |= combined_targets(place, keys)
        self.grow(0, 0, 1 + len(keys))
        for key, weight in zip(keys, weights, strict=True):
            self.shapes.setdefault(key, [])
            self.rest[key] = self.rest.get(key, 0.0) or weight
        primitives = place.mesh.children("primitives")
        drawn = []
        for at, primitive in enumerate(primitives):
            if has_triangles(primitive):
                drawn.append((at, primitive))
            else:
                self.warnings.append(f"{primitive.where}: points and lines are left out")
        identities = [self._identity(primitive) for _, primitive in drawn]
        blocks: dict[BlockKey, Block] = {}
        for (at, primitive), (vertices, in_texture) in zip(drawn, identities, strict=True):
            targets = [target.optional_integer("POSITION") for target in primitive.children("targets")]
            self.grow(0, 0, 1 + len(targets))
            if in_texture is None:  # where it is in others' textures does not matter to it
                in_texture = next((other for same, other in identities if same == vertices and other), None)
            block = blocks.get((vertices, in_texture))
            if block is None:
                source = next(
                    one
                    for (_, one), (same, other) in zip(drawn, identities, strict=True)
                    if same == vertices and other == in_texture
                )
                block = blocks[vertices, in_texture] = self._add_vertices(place, source)
                for key, target in zip(keys, targets, strict=False):
                    if target is not None:
                        self.shapes[key].append((block, target))
            self.triangles.append(self._triangles(primitive, block, place))
            self.parts.append(self._look(place, primitive, block, at, len(primitives)))

    def _identity(self, primitive: JsonObject) -> tuple[BlockKey, BlockKey | None]:
        """Return what primitives have in common whose vertices are the same, and are so in their textures."""
        attributes = primitive.child("attributes")
        if "POSITION" not in attributes:
            raise FacepinError(f"{primitive.where}: no POSITION attribute")
        bound = sorted(key for key in attributes.values if key.startswith(("JOINTS_", "WEIGHTS_")))
        colour = attributes.optional_integer("COLOR_0")
        vertices = (
            attributes.integer("POSITION"),
            None if colour is None else (colour, *material_factor(self.document, primitive).tolist()),
            tuple(attributes.integer(key) for key in bound),
            tuple(target.optional_integer("POSITION") for target in primitive.children("targets")),
        )
        shine = shine_of(self.document, primitive)
        if shine is None or self.textures.base_colour(shine) is None:
            return vertices, None
        return vertices, places_key(primitive, shine)

    def _add_vertices(self, place: Placed, primitive: JsonObject) -> Block:
        index = primitive.child("attributes").integer("POSITION")
        count = accessor_count(self.document, index)
        self.grow(count, 0, 0)
        points = read_floats(self.document, index, ("VEC3",))
        transform = None
        if place.joints is not None:
            transform = vertex_transforms(self.document, primitive, place.joints, points)
        if transform is None:
            transform = place.matrix[:3]
        if not np.array_equal(transform, IDENTITY):
            with np.errstate(all="ignore"):  # build_rig names what is not finite
                moved = carried(points, transform[..., :3]) + transform[..., 3]
                points = moved.astype(np.float32)
        self.positions.append(points)
        self.colours.append(_vertex_colours(self.document, primitive, count))
        places = self._vertex_places(primitive, count)
        self.places.append(places)
        linear = transform[..., :3]
        turned = None if np.array_equal(linear, IDENTITY[:, :3]) else linear
        return Block(self.vertices - count, count, turned, places is not None)

    def _vertex_places(self, primitive: JsonObject, count: int) -> Points | None:
        """Return (count, 2) places in the texture of a primitive, or None where there is none to use."""
        shine = shine_of(self.document, primitive)
        if shine is None or self.textures.base_colour(shine) is None:
            return None
        places = texture_places(self.document, primitive, shine, count)
        if places is None:
            self.warnings.append(f"{primitive.where}: a texture is left out: no coordinates in it")
        return places

    def _triangles(self, primitive: JsonObject, block: Block, place: Placed) -> NDArray[np.int64]:
        index = primitive.optional_integer("indices")
        count = block.count if index is None else accessor_count(self.document, index)
        self.grow(0, count if primitive.integer("mode", 4) == TRIANGLES else 3 * count, 0)
        triangles = read_triangles(self.document, primitive, block.count)
        return outward(triangles, block.linear) + block.start

    def _look(self, place: Placed, primitive: JsonObject, block: Block, at: int, count: int) -> PartLook:
        look = part_look(self.document, primitive, place.name, at, count)
        shine = shine_of(self.document, primitive)
        texture = None if shine is None or not block.textured else self.textures.base_colour(shine)
        return look if texture is None else replace(look, texture=texture)

    def all_colours(self) -> Points | None:
        """Return (n, 3) sRGB colours, or None where no primitive has any.

        Those without get a light grey, or white where a texture brings the colour.
        """
        if all(colours is None for colours in self.colours):
            return None
        filled = [
            np.full((len(points), 3), 0.6 if places is None else 1.0, np.float32)
            if colours is None
            else colours
            for points, colours, places in zip(self.positions, self.colours, self.places, strict=True)
        ]
        return linear_to_srgb(np.concatenate(filled))

    def all_places(self) -> Points | None:
        """Return (n, 2) places in textures, or None where there are none; those without get zeros."""
        if all(places is None for places in self.places):
            return None
        filled = [
            np.zeros((len(points), 2), np.float32) if places is None else places
            for points, places in zip(self.positions, self.places, strict=True)
        ]
        return np.concatenate(filled)


def carried(vectors: Points, linear: Floats) -> Floats:
    """Return vectors (s, 3) turned by (3, 3), or each by its own of (s, 3, 3), float64."""
    if linear.ndim == 2:
        turned: Floats = vectors.astype(np.float64) @ linear.T
        return turned
    return np.asarray(np.einsum("nab,nb->na", linear, vectors, dtype=np.float64))


def _vertex_colours(document: GltfDocument, primitive: JsonObject, count: int) -> Points | None:
    """Return (count, 3) linear vertex colours times the material's factor, or None."""
    index = primitive.child("attributes").optional_integer("COLOR_0")
    if index is None:
        return None
    colours = read_floats(document, index, ("VEC3", "VEC4"))[:, :3]
    if len(colours) != count:
        raise FacepinError(f"{primitive.where}: COLOR_0 has {len(colours)} elements, POSITION has {count}")
    return colours * material_factor(document, primitive)
