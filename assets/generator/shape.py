"""What a shape moves, before it is spread over all parts."""

from dataclasses import dataclass, field

from generator.vectors import Array


@dataclass(frozen=True, eq=False)
class Shape:
    """Displacements of one shape at weight 1.

    Brows and lashes follow the skin unless they are named in `parts`; other parts stay.
    """

    skin: Array
    """(n, 3) displacement of the skin."""
    parts: dict[str, Array] = field(default_factory=dict)
    """Part name -> (m, 3) displacement of that part."""
    lid: Array | None = None
    """(n, 3) share of `skin` that moves the left eyelids: what a blink has to take back."""

    @property
    def beside_lids(self) -> Array:
        """(n, 3) the rest of `skin`."""
        return self.skin if self.lid is None else self.skin - self.lid
