"""The names of morph targets, wherever exporters put them, and which of several meshes mean one shape."""

import re
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from unicodedata import normalize

from facepin.core.names import listed
from facepin.files.gltf.document import GltfDocument
from facepin.files.safely.checked_json import JsonObject

ShapeKey = tuple[str, int | tuple[int, int]]
"""(name, how many-eth of that name in its mesh); a target without a name has its mesh and place beside what
it is called instead, which may be nothing.

So shapes of several meshes (face, teeth, eyes) that bear the same name are one shape, and those without a
name are independent of each other.
"""

Spot = tuple[int, str]
"""A name in a mesh: its place among the meshes that are compared, and the name."""


@dataclass(frozen=True)
class NamedMesh:
    """A mesh, and the names of its targets."""

    label: str
    names: tuple[str, ...]
    """Of each target, as in the file; empty where there is none."""


def target_names(document: GltfDocument, mesh: JsonObject) -> tuple[list[str], int]:
    """Return the name of each target of a mesh, empty where it has none, and how many a list in it gives.

    They stand in the extras of the mesh or of a primitive; else in the extras of the target; else its data
    bear them.
    """
    primitives = list(mesh.children("primitives"))
    targets = [list(primitive.children("targets")) for primitive in primitives]
    names = [""] * max(map(len, targets), default=0)
    given = next((found for holder in (mesh, *primitives) if (found := _listed_names(holder))), [])
    sources = [given, *map(_own_names, targets), *(_data_names(document, found) for found in targets)]
    for source in sources:
        for j, name in enumerate(source[: len(names)]):
            names[j] = names[j] or name
    return names, len(given)


def _listed_names(holder: JsonObject) -> list[str]:
    extras = holder.values.get("extras")
    names = extras.get("targetNames") if isinstance(extras, dict) else None
    return [name if isinstance(name, str) else "" for name in names] if isinstance(names, list) else []


def _own_names(targets: Sequence[JsonObject]) -> list[str]:
    extras = [target.values.get("extras") for target in targets]
    names = [extra.get("name") if isinstance(extra, dict) else None for extra in extras]
    return [name if isinstance(name, str) else "" for name in names]


def _data_names(document: GltfDocument, targets: Sequence[JsonObject]) -> list[str]:
    """Return what the accessors of targets are called, nothing where that only numbers them."""
    accessors = document.root.children("accessors").values
    names = []
    for target in targets:
        index = target.values.get("POSITION", target.values.get("NORMAL"))
        entry = accessors[index] if isinstance(index, int) and 0 <= index < len(accessors) else None
        name = entry.get("name") if isinstance(entry, dict) else None
        names.append(name if isinstance(name, str) else "")
    plain = {re.sub(r"\d+", "", name) for name in names}
    return names if len(set(names)) == len(names) and (len(plain) > 1 or len(names) == 1) else []


def same_shapes(meshes: Mapping[int, NamedMesh]) -> tuple[dict[int, list[ShapeKey]], list[str]]:
    """Return the shape of each target of each mesh, and one line for each kind of thing worth telling.

    One name is one shape over all meshes.  So are names of different meshes that differ only in what
    exporters add or change: a prefix that all names of a mesh have ("Teeth_blendShape.jawOpen"), capitals,
    and how accents are encoded.  They are taken for one only if no mesh has two of them.
    """
    order = list(meshes)
    spots = [
        (at, name) for at, mesh in enumerate(order) for name in dict.fromkeys(meshes[mesh].names) if name
    ]
    spoken = {at: _without_prefix(meshes[mesh]) for at, mesh in enumerate(order)}
    names, told = _shared_names(spots, spoken)
    keys: dict[int, list[ShapeKey]] = {}
    unnamed = []
    several = sum(bool(mesh.names) for mesh in meshes.values()) > 1
    for at, mesh in enumerate(order):
        repeated = Counter[str]()
        keys[mesh] = []
        for j, name in enumerate(meshes[mesh].names):
            if name:
                shape = names[at, name]
                keys[mesh].append((shape, repeated[shape]))
                repeated[shape] += 1
            else:
                called = f"{meshes[mesh].label} target {j}" if several else ""
                keys[mesh].append((called, (mesh, j)))
                unnamed += [called] if called else []
    remarks = [f"one shape under several names: {listed(told)}"] if told else []
    if unnamed:
        remarks.append(f"shapes without a name, now called {listed(unnamed)}")
    return keys, remarks


def _without_prefix(mesh: NamedMesh) -> dict[str, str]:
    """Return each name of a mesh without the prefix that all of them have, if it tells of the mesh alone.

    It does where it holds for several names, or where it names the mesh; what is left has to be a word.
    """
    names = sorted({name for name in mesh.names if name})
    heads = {name.partition(".")[0] for name in names}
    tails = [name.partition(".")[2] for name in names]
    words = all(re.search(r"[^\W\d_]", tail) for tail in tails)
    if len(heads) != 1 or not words or len(set(tails)) < len(tails):
        return {name: name for name in names}
    (head,) = heads
    named = bool(mesh.label) and mesh.label.casefold() in head.casefold()
    return dict(zip(names, tails if named or len(names) > 1 else names, strict=True))


def _shared_names(
    spots: Sequence[Spot], spoken: Mapping[int, Mapping[str, str]]
) -> tuple[dict[Spot, str], list[str]]:
    """Return one name for all spots of a shape, and how those were spelled that differ."""
    exact = defaultdict[str, list[Spot]](list)
    loose = defaultdict[str, list[Spot]](list)
    for spot in spots:
        exact[normalize("NFC", spot[1])].append(spot)
        loose[_folded(spoken[spot[0]][spot[1]])].append(spot)
    group = {spot: number for number, found in enumerate(exact.values()) for spot in found}
    members = dict(enumerate(exact.values()))
    for found in loose.values():
        joined = sorted({group[spot] for spot in found})
        together = [spot for number in joined for spot in members[number]]
        if len(joined) > 1 and len({mesh for mesh, _ in together}) == len(together):
            members[joined[0]] = together
            for number in joined[1:]:
                del members[number]
            group |= dict.fromkeys(together, joined[0])
    names: dict[Spot, str] = {}
    taken = set[str]()
    told = []
    for found in sorted(members.values(), key=lambda found: len({name for _, name in found}) > 1):
        spellings = list(dict.fromkeys(name for _, name in found))
        plain = [name for mesh, name in found if spoken[mesh][name] == name]
        shared = plain[0] if plain else spoken[found[0][0]][found[0][1]]
        if len({normalize("NFC", name) for name in spellings}) == 1:
            shared = spellings[0]
        else:
            shared = spellings[0] if shared in taken else shared
            told.append(f"{shared} is {' and '.join(spellings)}")
        taken.add(shared)
        names |= dict.fromkeys(found, shared)
    return names, told


def _folded(name: str) -> str:
    return normalize("NFC", normalize("NFC", name).casefold())
