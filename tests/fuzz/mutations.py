"""Ways in which any file comes broken: torn, flipped, with numbers and words that nobody would write."""

import struct
from collections.abc import Callable

import numpy as np

Mutation = Callable[[bytes, np.random.Generator], bytes]

WORDS = (
    "0 -0 1 -1 2 3 7 127 128 255 256 -128 32767 32768 65535 65536 2147483647 2147483648 4294967295 "
    "9007199254740993 9223372036854775807 18446744073709551616 1e5 1e9 1e38 3.5e38 1e39 1e300 1e308 1e-300 "
    "1e-45 0.5 -0.5 1e400 NaN -Infinity Infinity nan inf 1,5 0x10 1_000 ١ 00012 +3"
)
NUMBERS = WORDS.split(" ")
"""As they stand in text."""
TEXTS = (
    "",
    " ",
    "\n",
    "\0",
    "a\u0000b",
    "../../../etc/passwd",
    "/dev/zero",
    "file:///etc/passwd",
    "data:application/octet-stream;base64,AAAA",
    "data:image/png;base64,!!!",
    "%00",
    "%zz",
    "\ud800",
    "\U0001f600" * 5,
    "x" * 5000,
    "口_あ",
    "$x$",
    "a##b",
    "{}",
    "con",
    "NaN",
    "SCALAR",
    "VEC2",
    "MAT4",
    "TRIANGLES",
)


def flipped(content: bytes, rng: np.random.Generator) -> bytes:
    """Turn over one to a few bits."""
    changed = bytearray(content)
    for _ in range(int(rng.integers(1, 9)) if changed else 0):
        changed[int(rng.integers(len(changed)))] ^= 1 << int(rng.integers(8))
    return bytes(changed)


def cut(content: bytes, rng: np.random.Generator) -> bytes:
    """Lose the end, the beginning, or something between."""
    start, end = sorted(rng.integers(0, len(content) + 1, 2).tolist())
    return [content[:end], content[start:], content[:start] + content[end:]][int(rng.integers(3))]


def patched(content: bytes, rng: np.random.Generator) -> bytes:
    """Write an extreme number over some bytes, in one of the binary forms."""
    form = ["<I", "<i", "<H", "<f", "<d", "<Q", ">I"][int(rng.integers(7))]
    number = [0, 1, 0xFF, 0xFFFF, 0x7FFF, 2**31 - 1, 0x80000000, 0xFFFFFFFF][int(rng.integers(8))]
    if form in ("<f", "<d"):
        value = struct.pack(form, [np.nan, np.inf, -np.inf, 3e38, 1e-45, -0.0][int(rng.integers(6))])
    else:
        value = struct.pack("<Q", number)[: struct.calcsize(form)]
    at = int(rng.integers(0, max(len(content), 1)))
    if rng.random() < 0.7:
        at -= at % 4
    return content[:at] + value + content[at + len(value) :]


def doubled(content: bytes, rng: np.random.Generator) -> bytes:
    """Repeat a piece, up to a thousand times."""
    start, end = sorted(rng.integers(0, len(content) + 1, 2).tolist())
    end = min(end, start + 200)
    return content[:start] + content[start:end] * int(rng.choice([2, 3, 1000])) + content[end:]


def garbled(content: bytes, rng: np.random.Generator) -> bytes:
    """Put noise in place of a piece, or of everything."""
    if rng.random() < 0.1:
        return rng.bytes(int(rng.integers(0, 600)))
    at, length = int(rng.integers(0, len(content) + 1)), int(rng.integers(1, 40))
    return content[:at] + rng.bytes(length) + content[at + length :]


def other_numbers(content: bytes, rng: np.random.Generator) -> bytes:
    """Replace a word or number of a text."""
    separators = b' \t\n,=[]{}:/"'
    edges = [at for at, byte in enumerate(content) if byte in separators]
    if len(edges) < 2:
        return content
    at = int(rng.integers(len(edges) - 1))
    word = (
        NUMBERS[int(rng.integers(len(NUMBERS)))]
        if rng.random() < 0.8
        else TEXTS[int(rng.integers(len(TEXTS)))]
    )
    return content[: edges[at] + 1] + word.encode("utf-8", "surrogatepass") + content[edges[at + 1] :]


def other_lines(content: bytes, rng: np.random.Generator) -> bytes:
    """Drop, repeat, swap or encode lines otherwise."""
    lines = content.split(b"\n")
    a, b = rng.integers(len(lines), size=2).tolist()
    kind = int(rng.integers(6))
    if kind == 0:
        del lines[a]
    elif kind == 1:
        lines[a:a] = [lines[b]] * int(rng.choice([1, 2, 2000]))
    elif kind == 2:
        lines[a], lines[b] = lines[b], lines[a]
    elif kind == 3:
        return content.decode("utf-8", "replace").encode(["utf-16", "utf-32", "utf-8-sig"][a % 3])
    elif kind == 4:
        return content.replace(b"\n", [b"\r", b"\r\n", b"\0", b"\\\n"][a % 4])
    else:
        lines[a] = lines[a] * 3
    return b"\n".join(lines)


BYTES: tuple[Mutation, ...] = (flipped, cut, patched, doubled, garbled)
TEXT: tuple[Mutation, ...] = (other_numbers, other_numbers, other_lines, flipped, cut, doubled, garbled)


def one_of(mutations: tuple[Mutation, ...]) -> Mutation:
    """Return a mutation that does what one of these does."""

    def mutate(content: bytes, rng: np.random.Generator) -> bytes:
        return mutations[int(rng.integers(len(mutations)))](content, rng)

    return mutate
