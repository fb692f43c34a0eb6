"""Labels of items made of what users call things: any text, shown as it is."""

from facepin.core.names import readable

HASH = "#\N{ZERO WIDTH SPACE}"


def plain_label(text: str, number: int) -> str:
    """Return a label that shows `text` in full, for the item `number` of its list or menu.

    imgui takes what follows two hashes for the item's identity and leaves it out: behind each stands a blank
    of no width.  Items of one list need other numbers, as two of them may be called the same.
    """
    return f"{readable(text).replace('#', HASH)}###{number}"
