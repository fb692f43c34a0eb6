"""The characters that come with the program."""

from generator.anatomy import Anatomy

CHARACTERS: dict[str, Anatomy] = {
    "ada": Anatomy(),
}
"""File name -> anatomy; ada is the face that opens by default."""
