"""The numbers of a character, each with its anatomical name; centimetres, and degrees where not said."""

from dataclasses import dataclass, field

from generator.vectors import Vector

Colour = tuple[float, float, float]
Curve = tuple[tuple[float, float], ...]
"""Knots (parameter, value) of a monotone cubic."""


@dataclass(frozen=True)
class Ball:
    """An ellipsoid of flesh or bone, blended into the head over the distance `blend`."""

    centre: Vector
    radii: Vector
    blend: float


@dataclass(frozen=True)
class Bone:
    """A capsule from `start` to `end` with a radius at either end."""

    start: Vector
    end: Vector
    radii: tuple[float, float]
    blend: float


@dataclass(frozen=True)
class Skull:
    """The large forms of head, face and neck; paired forms are given for the left side."""

    axis_z: float = -1.0
    cranium: Ball = Ball((0, 3.7, -1.15), (7.3, 7.3, 8.0), 0)
    forehead: Ball = Ball((0, 3.5, 1.9), (6.2, 4.8, 5.5), 2.5)
    face: Ball = Ball((0, -1.7, 0.65), (6.10, 6.6, 6.1), 3.0)
    jaw: Bone = Bone((1.55, -7.75, 4.3), (3.95, -4.9, 0.1), (1.4, 1.4), 2.8)
    chin: Ball = Ball((0, -8.25, 5.2), (1.65, 1.5, 1.9), 2.2)
    cheek: Ball = Ball((3.40, -2.45, 4.05), (2.35, 2.0, 2.45), 2.2)
    buccal: Ball = Ball((3.05, -4.95, 3.55), (2.05, 2.0, 2.05), 2.4)
    muzzle: Ball = Ball((0, -5.7, 4.95), (2.65, 2.1, 2.4), 1.8)
    brow_ridge: Bone = Bone((1.5, 2.45, 5.95), (4.7, 2.3, 4.4), (0.85, 0.95), 2.0)
    neck: Bone = Bone((0, -14.0, -2.6), (0, -5.0, -1.6), (2.95, 3.25), 2.2)
    neck_muscle: Bone = Bone((0.75, -13.4, -0.15), (3.3, -5.0, -2.2), (0.42, 0.62), 1.3)
    """From the collar bone to behind the ear."""
    shoulders: Ball = Ball((0, -19.6, -3.0), (8.5, 3.0, 4.2), 3.5)
    brow_fill: Ball = Ball((1.75, 0.5, 5.45), (1.15, 1.6, 1.2), 2.0)
    """Between brow and nose, where the socket would otherwise cut a pit."""
    inner_canthus: Bone = Bone((1.8, -0.5, 7.2), (1.9, 0.35, 7.25), (0.6, 0.5), 2.0)
    """Taken away: the soft trough beside the nose."""
    jaw_hinge: Vector = (0, -1.3, -0.6)
    pads: tuple[Ball, ...] = ()
    """Added: what sags with age, such as bags under the eyes and jowls."""
    furrows: tuple[Bone, ...] = ()
    """Taken away: the lines of age."""
    ear_size: float = 1.14


@dataclass(frozen=True)
class Nose:
    """Bridge, tip, wings and nostrils."""

    bridge: Bone = Bone((0, 1.3, 6.2), (0, -2.2, 7.85), (0.56, 0.68), 1.0)
    tip: Ball = Ball((0, -2.42, 8.1), (0.88, 0.80, 0.90), 0.9)
    wing: Ball = Ball((0.90, -2.82, 7.4), (0.58, 0.55, 0.80), 0.75)
    wing_yaw: float = -18
    columella: Bone = Bone((0, -2.80, 8.05), (0, -3.10, 6.9), (0.36, 0.40), 0.8)
    nostril: Ball = Ball((0.50, -3.42, 7.62), (0.24, 0.34, 0.38), 0.30)
    nostril_yaw: float = -22
    philtrum: Bone = Bone((0, -4.15, 7.72), (0, -4.95, 7.66), (0.20, 0.27), 0.8)
    """Taken away: the groove above the upper lip."""


@dataclass(frozen=True)
class Eye:
    """Left eyeball and lids."""

    centre: Vector = (3.60, 0.0, 4.55)
    radius: float = 2.05
    lid_radius: float = 1.055
    """Radius of the lids, in eyeball radii."""
    half_width: float = 1.93
    inner_half_width: float = 1.68
    upper_opening: float = 1.12
    lower_opening: float = 0.92
    yaw: float = 3.5
    """Turn of the opening outwards; more than about 5 looks wall-eyed."""
    inner_corner: float = -0.16
    outer_corner: float = 0.10
    iris: float = 0.545
    """Half angle of the iris, radians."""
    pupil: float = 0.26
    socket: float = 1.06
    """Radius of the hollow above the eye, in eyeball radii."""
    crease: float = 0.0
    """Depth of the fold above the upper lid."""


@dataclass(frozen=True)
class Mouth:
    """Closed lips."""

    height: float = -5.95
    half_width: float = 2.20
    corner_lift: float = 0.0
    upper_lip: float = 0.58
    lower_lip: float = 0.74
    upper_fullness: float = 0.36
    lower_fullness: float = 0.46
    upper_roll: float = 0.0
    """How far the skin above the upper lip comes forward with it, in lip fullnesses."""
    lower_roll: float = 0.0


@dataclass(frozen=True)
class Brow:
    """Knots of the brow over its length, inner end first."""

    x: Curve = ((0, 1.45), (0.3, 2.9), (0.65, 4.5), (1, 5.8))
    y: Curve = ((0, 2.92), (0.3, 3.36), (0.65, 3.42), (1, 2.72))
    thickness: float = 0.31


@dataclass(frozen=True)
class Hair:
    """Hairline: height over the angle from the front (0) to the nape (pi)."""

    line: Curve = (
        (0, 5.9), (0.42, 6.15), (0.80, 5.0), (1.02, 3.2), (1.16, 0.9), (1.27, -0.55), (1.36, -0.35),
        (1.50, 1.35), (1.64, 1.30), (1.80, -0.4), (2.05, -3.2), (2.5, -4.5), (3.141592653589793, -4.7),
    )  # fmt: skip
    centre: Vector = (0, 3.4, -1.2)
    locks: float = 0.0
    """How far the hairline runs out into locks, radians."""
    volume: float = 1.0
    """Thickness, 1 for straight short hair."""
    grooves: float = 1.0
    """Depth of the grooves between strands."""
    bun: Ball | None = None
    """A coiled knot on the head."""


@dataclass(frozen=True)
class Colours:
    """Base colours, sRGB 0..1."""

    skin: Colour = (0.905, 0.690, 0.585)
    lip: Colour = (0.800, 0.420, 0.400)
    cheek: Colour = (0.930, 0.560, 0.480)
    iris: Colour = (0.26, 0.50, 0.62)
    brow: Colour = (0.27, 0.165, 0.115)
    lash: Colour = (0.09, 0.06, 0.055)
    hair: Colour = (0.36, 0.20, 0.12)
    shirt: Colour = (0.16, 0.30, 0.36)
    teeth: Colour = (0.965, 0.95, 0.915)
    gum: Colour = (0.80, 0.42, 0.42)
    tongue: Colour = (0.82, 0.46, 0.46)


@dataclass(frozen=True)
class Anatomy:
    """A whole character."""

    skull: Skull = field(default_factory=Skull)
    nose: Nose = field(default_factory=Nose)
    eye: Eye = field(default_factory=Eye)
    mouth: Mouth = field(default_factory=Mouth)
    brow: Brow = field(default_factory=Brow)
    hair: Hair = field(default_factory=Hair)
    colours: Colours = field(default_factory=Colours)
