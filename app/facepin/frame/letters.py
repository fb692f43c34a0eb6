"""Which texts of users and files are shown: their letters need fonts."""

from collections.abc import Callable, Iterable, Iterator, Sequence

from facepin.desk.desk import Desk
from facepin.panels.letters import Letters


class ShownLetters:
    """Has fonts loaded for what is new among the texts that may be shown."""

    def __init__(self) -> None:
        self._letters = Letters()
        self._read: dict[str, object] = {}
        """What was read last, by what it is: the same object needs no second look."""

    def load(self, desk: Desk, recent: Sequence[str]) -> None:
        """Look at all texts, between two frames; what can't be shown is said."""
        texts = [text for text in _short_texts(desk) if not text.isascii()]
        for what, value, of in _long_texts(desk, recent):
            if self._read.get(what) is not value:
                self._read[what] = value
                texts += of()
        if texts and (remark := self._letters.load(texts)):
            desk.say(remark)


def _short_texts(desk: Desk) -> Iterator[str]:
    """Go through what may change with every frame."""
    view = desk.view
    yield desk.message
    yield from (view.weights.search, view.weights.twin_search)
    yield from (view.library.search, view.library.title, view.library.tags)
    yield view.pins.typed
    if view.palette is not None:
        yield view.palette.query
    if desk.dialog is not None:
        yield from desk.dialog.texts
    if desk.loading is not None:
        yield desk.loading.path.name


def _long_texts(
    desk: Desk, recent: Sequence[str]
) -> Iterator[tuple[str, object, Callable[[], Iterable[str]]]]:
    """Go through lists that stay the same objects as long as they have the same content."""
    yield "recent", recent, lambda: recent
    left = desk.keeper.left
    yield "left over", left, lambda: [leftover.scene.rig.name for leftover in left]
    if (session := desk.session) is not None:
        rig, pins = session.rig, session.pose.pins
        yield "rig", rig, lambda: (rig.name, *rig.shape_names, *rig.warnings)
        yield "pins", pins, lambda: [pin.name for pin in pins]
    if (library := desk.library) is not None:
        poses = library.poses
        yield "poses", poses, lambda: [f"{pose.title} {' '.join(pose.tags)}" for pose in poses]
