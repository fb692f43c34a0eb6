"""Files of a structure that are broken inside it: JSON, .glb, .npz and .png that are well-formed lies."""

import io
import json
import struct
import zipfile
import zlib
from collections.abc import Iterator
from typing import Any

import numpy as np

from fuzz.mutations import BYTES, TEXT, TEXTS, Mutation, flipped, one_of, other_numbers

VALUES: tuple[Any, ...] = (
    *(None, True, False, 0, 1, -1, 2, 3, 255, 65536, 2**31, 2**32, 2**53 + 1, 2**63, 2**64, 10**30),
    *(0.5, -0.0, 1e-300, 1e38, 1e39, 1e300, float("nan"), float("inf"), -float("inf")),
    *([], {}, [[]], [{}], [0] * 3, [1e300] * 4, ["a"], [None] * 16, {"a": {}}),
    *TEXTS,
)


def other_json(content: bytes, rng: np.random.Generator) -> bytes:
    """Change the structure of a JSON document; what Python writes as NaN stays so."""
    try:
        root = json.loads(content)
    except ValueError:
        return flipped(content, rng)
    for _ in range(int(rng.integers(1, 4))):
        root = _changed(root, rng)
    text = json.dumps(root, ensure_ascii=bool(rng.random() < 0.5))
    if rng.random() < 0.02:
        depth = int(rng.choice([100, 5000, 200_000]))
        nested = '{"a":' * depth + "1" + "}" * depth
        text = text.replace("[", "[" * depth, 1) if rng.random() < 0.5 else nested
    return text.encode("utf-8", "surrogatepass")


def _changed(root: Any, rng: np.random.Generator) -> Any:
    """Change one value somewhere in a document."""
    places = list(_places(root))
    if not places:
        return _value(rng)
    holder, key = places[int(rng.integers(len(places)))]
    kind = int(rng.integers(7))
    if kind == 0:
        del holder[key]
    elif kind == 1 and isinstance(holder, list):
        holder *= int(rng.choice([2, 3, 300]))
    elif kind == 2:
        other, name = places[int(rng.integers(len(places)))]
        holder[key] = json.loads(json.dumps(other[name]))
    elif kind == 3 and type(holder[key]) in (int, float):
        holder[key] += [1, -1, 2**31, -(2**31), 0.5][int(rng.integers(5))]
    elif kind == 4 and isinstance(holder, dict):
        holder[_text(rng)] = holder.pop(key)
    elif kind == 5:
        holder[key] = [holder[key]]
    else:
        holder[key] = _value(rng)
    return root


def _places(root: Any) -> Any:
    """Yield every holder of a value and its key, not deeper than a stack bears."""
    left = [root] if isinstance(root, dict | list) else []
    while left:
        holder = left.pop()
        keys = holder.keys() if isinstance(holder, dict) else range(len(holder) if len(holder) < 999 else 0)
        for key in list(keys):
            yield holder, key
            if isinstance(holder[key], dict | list):
                left.append(holder[key])


def _value(rng: np.random.Generator) -> Any:
    return json.loads(json.dumps(VALUES[int(rng.integers(len(VALUES)))]))


def _text(rng: np.random.Generator) -> str:
    return TEXTS[int(rng.integers(len(TEXTS)))]


JSON: tuple[Mutation, ...] = (*[other_json] * 6, *TEXT[2:])


def other_glb(content: bytes, rng: np.random.Generator) -> bytes:
    """Change the JSON or the binary part of a .glb and put it together again, as a careful liar would."""
    length = int.from_bytes(content[12:16], "little")
    text, rest = content[20 : 20 + length], content[20 + length :]
    if rng.random() < 0.75:
        text = other_json(text, rng)
    else:
        rest = rest[:8] + one_of(BYTES)(rest[8:], rng)
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + rest
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


GLB: tuple[Mutation, ...] = (*[other_glb] * 5, *BYTES)


METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA)


def other_npz(content: bytes, rng: np.random.Generator) -> bytes:
    """Change one array of an archive: its head, its numbers, its type, its presence."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        entries = {name: archive.read(name) for name in archive.namelist()}
    name = list(entries)[int(rng.integers(len(entries)))]
    kind = int(rng.integers(8))
    if kind == 0:
        del entries[name]
    elif kind == 1:
        other = list(entries)[int(rng.integers(len(entries)))]
        entries[name] = entries[other]
    elif kind == 2:
        head = entries[name][10:].split(b"\n")[0]
        other_head = other_numbers(head + b" ", rng)[: len(head)].ljust(len(head))
        entries[name] = entries[name].replace(head, other_head)
    elif kind == 3:
        entries[name] = _saved(_other_array(np.load(io.BytesIO(entries[name])), rng))
    elif kind == 4:
        entries[["extra", "../up.npy", "neutral", "x" * 300 + ".npy"][int(rng.integers(4))]] = b"not an array"
    else:
        entries[name] = one_of(BYTES)(entries[name], rng)
    file = io.BytesIO()
    method = METHODS[int(rng.integers(len(METHODS)))]
    with zipfile.ZipFile(file, "w", method) as archive:
        for entry, data in entries.items():
            archive.writestr(entry, data)
    return file.getvalue()


def _other_array(array: np.ndarray[Any, Any], rng: np.random.Generator) -> np.ndarray[Any, Any]:
    kind = int(rng.integers(6))
    if kind == 0:
        types = ["f2", "f8", "i1", "u8", "c8", "?", "S4", "U3", "M8[s]", "g", ">f4"]
        if array.dtype.kind == "U":
            return array.astype("U8")
        return array.astype(types[int(rng.integers(len(types)))])
    if kind == 1:
        return array[..., None] if rng.random() < 0.5 else array.reshape(-1)
    if kind == 2:
        return array[: int(rng.integers(0, len(array) + 1))] if array.ndim else array
    if kind == 3:
        return np.zeros((0, *array.shape[1:]), array.dtype)
    if kind == 4:
        return np.concatenate([array] * int(rng.choice([2, 5, 300]))) if array.ndim else array
    changed = array.copy()
    if changed.dtype.kind in "fiu" and changed.size:
        floats = changed.dtype.kind == "f"
        values = [np.nan, np.inf, 1e38, -1e38, 1e-45] if floats else [-1, 2**30, -(2**31), 7]
        changed.flat[int(rng.integers(changed.size))] = values[int(rng.integers(len(values)))]
    return changed


def _saved(array: np.ndarray[Any, Any]) -> bytes:
    file = io.BytesIO()
    np.save(file, array, allow_pickle=False)
    return file.getvalue()


NPZ: tuple[Mutation, ...] = (*[other_npz] * 5, *BYTES)


def other_png(content: bytes, rng: np.random.Generator) -> bytes:
    """Change a piece of a picture and put its checksum right: sizes, kinds, profiles, texts that swell."""
    pieces = list(_pieces(content))
    at, kind = int(rng.integers(len(pieces))), int(rng.integers(6))
    if kind == 0:
        sizes = rng.choice([0, 1, 32, 50_000, 2**31 - 1, 2**32 - 1], 2).tolist()
        pieces[0] = b"IHDR", struct.pack(">II", *sizes) + pieces[0][1][8:]
    elif kind == 1:
        pieces[0] = b"IHDR", pieces[0][1][:8] + bytes(rng.choice([0, 1, 2, 3, 4, 6, 8, 16, 255], 5).tolist())
    elif kind == 2:
        swelling = zlib.compress(bytes(int(rng.choice([10, 10_000, 50_000_000]))), 9)
        names = [b"iCCP", b"zTXt", b"iTXt", b"IDAT", b"eXIf"]
        name = names[int(rng.integers(len(names)))]
        pieces.insert(1, (name, b"name\0\0" * (name != b"IDAT") + swelling))
    elif kind == 3:
        del pieces[at]
    elif kind == 4:
        pieces.insert(at, pieces[int(rng.integers(len(pieces)))])
    else:
        pieces[at] = pieces[at][0], one_of(BYTES)(pieces[at][1], rng)
    made = content[:8]
    for name, data in pieces:
        made += struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    return made


def _pieces(content: bytes) -> Iterator[tuple[bytes, bytes]]:
    at = 8
    while at < len(content):
        length = int.from_bytes(content[at : at + 4], "big")
        yield content[at + 4 : at + 8], content[at + 8 : at + 8 + length]
        at += 12 + length


PNG: tuple[Mutation, ...] = (*[other_png] * 4, *BYTES)
