"""Finds shaders/ and assets/: beside this file in an installed wheel, at the top of a checkout otherwise."""

from functools import cache
from pathlib import Path

BUILTIN = "faces/ada.npz"
"""The face that is there when no other is named, among the assets."""

_PACKAGE = Path(__file__).resolve().parent
_CHECKOUT = _PACKAGE.parent.parent


@cache
def builtin_faces() -> dict[str, Path]:
    """Return the faces that come with the program, by name."""
    return {path.stem: path for path in sorted(resource("assets", BUILTIN).parent.glob("*.npz"))}


def resource(folder: str, name: str) -> Path:
    """Return the path of `name` in the resource folder `folder` ("shaders" or "assets").

    Raises
    ------
    FileNotFoundError
        Naming the folders looked in and what they hold, when there is no such file.
    """
    present: list[str] = []
    for root in (_PACKAGE, _CHECKOUT):
        path = root / folder / name
        if path.is_file():
            return path
        present += [found.name for found in sorted(path.parent.glob("*"))]
    there = ", ".join(present) or "none"
    raise FileNotFoundError(f"{folder}/{name} is missing from this installation (there are: {there})")
