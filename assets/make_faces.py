"""Makes the built-in faces: `python assets/make_faces.py [NAME...]` writes assets/faces/NAME.npz."""

import argparse
import sys
from pathlib import Path

from generator.archive import write_archive
from generator.assembly import arrays, build_model
from generator.character import build_character
from generator.characters import CHARACTERS, PRODUCTION
from generator.checks import moved_share

FACES = Path(__file__).resolve().parent / "faces"


def main() -> None:
    """Make the named faces, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "names", nargs="*", metavar="NAME", help=f"which ones: {', '.join(CHARACTERS)} (default: all)"
    )
    parser.add_argument("--out", type=Path, default=FACES, help="folder to write to (default: assets/faces)")
    parser.add_argument("--shares", action="store_true", help="print the share of vertices each shape moves")
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in CHARACTERS]
    if unknown:
        parser.error(f"no character {', '.join(unknown)} (there are: {', '.join(CHARACTERS)})")
    for name in options.names or CHARACTERS:
        model = build_model(build_character(CHARACTERS[name]), production=name in PRODUCTION)
        path = options.out / f"{name}.npz"
        write_archive(path, arrays(model))
        counts = f"{len(model.character.vertices)} vertices, {len(model.names)} shapes"
        sys.stdout.write(f"{path}: {counts}, {path.stat().st_size / 1e6:.1f} MB\n")
        if options.shares:
            for k, shape in enumerate(model.names):
                sys.stdout.write(f"{moved_share(model, k):8.1%} {shape}\n")


if __name__ == "__main__":
    main()
