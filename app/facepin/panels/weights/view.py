"""How the weights panel is looked at and what the hand does in it; not part of the pose."""

from dataclasses import dataclass, field

from facepin.core.arrays import Floats
from facepin.core.rig import Rig
from facepin.panels.rest import Rest
from facepin.panels.weights.columns import Columns
from facepin.panels.weights.gesture import Gesture
from facepin.panels.weights.listing import Arrangement, Line, Listing
from facepin.panels.weights.text import Elider


@dataclass
class WeightsView:
    """Changed in place by the panel."""

    search: str = ""
    arrangement: Arrangement = "rig order"
    folded: frozenset[str] = frozenset()
    """Names of the groups that only show their header."""
    focus: int | None = None
    """Shape whose row the keyboard has."""
    explained: int | None = None
    """Shape that the mouse rests on, to be shown on the face."""
    marked: frozenset[int] = frozenset()
    """Shapes that move the vertex under the mouse."""
    gesture: Gesture | None = None
    """The slider in the user's hand."""
    late_press: bool = False
    """A press ended the typing of a number, and is still to be acted on."""
    gain: tuple[Floats, float] | None = None
    """While the gain is moved: the weights (k,) at the press, and the gain."""
    menu: Line | None = None
    """Shape or group whose menu is open."""
    menu_opens: bool = False
    """It was asked for just now."""
    twin_search: str = ""
    """What is typed to find a shape's twin."""
    columns: Columns | None = None
    """Where the list was drawn last."""
    rest: Rest = field(default_factory=Rest)
    elider: Elider = field(default_factory=Elider)
    _listing: Listing | None = None

    @property
    def rests(self) -> bool:
        """Whether a slider was moved in small steps, and more may follow."""
        return self.gesture is not None and self.gesture.hand in ("keys", "wheel")

    def listing(self, rig: Rig) -> Listing:
        """Return the lines of a rig; another rig begins with nothing in hand."""
        if self._listing is None or self._listing.rig is not rig:
            self._listing = Listing(rig)
            self.focus = self.explained = self.gesture = self.gain = self.menu = None
            self.marked = frozenset()
        return self._listing
