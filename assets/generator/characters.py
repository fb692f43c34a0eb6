"""The characters that come with the program."""

from dataclasses import replace

from generator.anatomy import Anatomy, Ball, Bone, Brow, Colours, Eye, Hair, Mouth, Nose, Skull

ADA = Anatomy(
    skull=Skull(
        face=Ball((0, -1.6, 0.65), (6.05, 6.35, 6.1), 3.0),
        jaw=Bone((1.45, -6.75, 4.5), (4.0, -4.7, 0.1), (1.4, 1.5), 3.2),
        chin=Ball((0, -7.30, 5.45), (1.45, 1.30, 1.80), 2.2),
        cheek=Ball((3.40, -2.55, 4.15), (2.35, 1.95, 2.45), 2.2),
        buccal=Ball((3.0, -4.7, 3.65), (2.05, 1.95, 2.05), 2.4),
        muzzle=Ball((0, -4.85, 5.2), (2.6, 2.25, 2.45), 2.0),
        neck=Bone((0, -14.0, -2.6), (0, -5.0, -1.6), (2.75, 2.6), 2.2),
    ),
    nose=Nose(
        bridge=Bone((0, 1.3, 6.15), (0, -2.0, 7.75), (0.50, 0.56), 1.25),
        tip=Ball((0, -2.22, 8.12), (0.78, 0.70, 0.82), 0.9),
        wing=Ball((0.84, -2.60, 7.35), (0.50, 0.48, 0.74), 0.75),
        columella=Bone((0, -2.55, 8.02), (0, -2.90, 6.9), (0.33, 0.38), 0.8),
        nostril=Ball((0.46, -3.08, 7.66), (0.27, 0.42, 0.40), 0.24),
        philtrum=Bone((0, -3.6, 7.98), (0, -4.35, 7.98), (0.14, 0.20), 0.6),
    ),
    eye=Eye(
        centre=(3.48, 0.0, 4.6),
        upper_opening=1.04,
        lower_opening=0.88,
        outer_corner=0.24,
        crease=0.10,
        socket=1.13,
        pupil=0.25,
    ),
    mouth=Mouth(
        height=-5.2,
        upper_lip=0.60,
        lower_lip=0.76,
        upper_fullness=0.32,
        lower_fullness=0.42,
        upper_roll=0.55,
        lower_roll=0.30,
    ),
    brow=Brow(
        x=((0, 1.42), (0.3, 2.8), (0.65, 4.4), (1, 5.75)),
        y=((0, 2.62), (0.3, 3.02), (0.65, 3.16), (1, 2.50)),
        thickness=0.26,
    ),
    hair=Hair(locks=0.05, bun=Ball((0, 10.2, -8.3), (2.6, 2.1, 2.6), 0)),
    colours=Colours(),
)
BRUNO = Anatomy(
    skull=Skull(
        cranium=Ball((0, 3.5, -1.15), (7.4, 7.0, 8.0), 0),
        forehead=Ball((0, 3.3, 1.9), (6.3, 4.7, 5.5), 2.5),
        face=Ball((0, -2.0, 0.65), (6.7, 6.8, 6.1), 3.0),
        jaw=Bone((2.3, -8.3, 4.2), (5.1, -5.6, 0.3), (1.9, 1.8), 2.8),
        chin=Ball((0, -8.75, 5.35), (2.25, 1.7, 2.0), 2.2),
        cheek=Ball((3.9, -2.9, 4.1), (2.5, 2.1, 2.5), 2.2),
        buccal=Ball((3.9, -5.6, 3.6), (2.3, 2.3, 2.2), 2.4),
        muzzle=Ball((0, -5.8, 5.05), (3.0, 2.5, 2.5), 1.9),
        brow_ridge=Bone((1.5, 2.35, 6.15), (4.8, 2.2, 4.5), (0.95, 1.0), 2.0),
        neck=Bone((0, -14.0, -2.4), (0, -5.0, -1.4), (3.8, 4.0), 2.4),
        shoulders=Ball((0, -20.4, -3.0), (8.5, 3.0, 4.2), 3.0),
        pads=(
            Ball((3.45, -2.05, 6.20), (1.35, 0.50, 0.60), 0.6),
            Ball((4.35, -7.0, 3.2), (1.5, 1.7, 2.0), 1.6),
        ),
        furrows=(
            Bone((2.15, -3.5, 6.85), (3.35, -5.7, 6.40), (0.26, 0.24), 0.6),
            Bone((3.15, -6.9, 6.25), (3.05, -8.1, 6.05), (0.20, 0.12), 0.6),
            Bone((0, 4.1, 7.6), (2.4, 4.35, 7.25), (0.13, 0.10), 0.5),
            Bone((0, 5.05, 7.3), (2.2, 5.25, 6.98), (0.13, 0.10), 0.5),
        ),
        ear_size=1.42,
    ),
    nose=Nose(
        bridge=Bone((0, 1.3, 6.3), (0, -2.5, 8.2), (0.66, 0.85), 1.0),
        tip=Ball((0, -2.95, 8.65), (1.40, 1.15, 1.25), 1.0),
        wing=Ball((1.35, -3.25, 7.6), (0.82, 0.72, 0.95), 0.8),
        columella=Bone((0, -3.40, 8.3), (0, -3.65, 7.0), (0.45, 0.5), 0.8),
        nostril=Ball((0.68, -3.98, 7.85), (0.30, 0.36, 0.42), 0.28),
        philtrum=Bone((0, -4.6, 7.9), (0, -5.2, 7.85), (0.18, 0.25), 0.8),
    ),
    eye=Eye(
        centre=(3.55, 0.1, 4.75),
        radius=1.85,
        half_width=1.74,
        inner_half_width=1.52,
        upper_opening=0.86,
        lower_opening=0.72,
        outer_corner=-0.06,
        yaw=3.0,
        crease=0.05,
        socket=1.10,
        pupil=0.22,
    ),
    mouth=Mouth(
        height=-6.2,
        half_width=2.55,
        upper_lip=0.40,
        lower_lip=0.56,
        upper_fullness=0.24,
        lower_fullness=0.32,
        upper_roll=0.5,
        lower_roll=0.3,
    ),
    brow=Brow(
        x=((0, 1.25), (0.3, 2.7), (0.65, 4.4), (1, 5.7)),
        y=((0, 2.35), (0.3, 2.75), (0.65, 2.80), (1, 2.05)),
        thickness=0.54,
    ),
    hair=Hair(
        line=(
            (0, 8.1), (0.42, 8.6), (0.80, 7.6), (1.02, 5.0), (1.16, 1.6), (1.27, -0.75), (1.36, -0.45),
            (1.50, 1.35), (1.64, 1.30), (1.80, -0.4), (2.05, -3.2), (2.5, -4.6), (3.141592653589793, -5.0),
        ),
        locks=0.03,
    ),
    colours=Colours(
        skin=(0.80, 0.565, 0.445),
        lip=(0.66, 0.36, 0.32),
        cheek=(0.80, 0.42, 0.34),
        iris=(0.42, 0.27, 0.14),
        brow=(0.36, 0.34, 0.33),
        lash=(0.10, 0.085, 0.08),
        hair=(0.52, 0.50, 0.49),
        shirt=(0.42, 0.16, 0.13),
        teeth=(0.93, 0.89, 0.82),
    ),
)  # fmt: skip
MIRA = replace(
    ADA,
    skull=replace(
        ADA.skull,
        face=Ball((0, -1.6, 0.65), (5.95, 6.35, 6.1), 3.0),
        jaw=Bone((1.30, -6.85, 4.5), (4.05, -4.9, 0.1), (1.35, 1.45), 2.8),
        cheek=Ball((3.55, -2.35, 4.15), (2.3, 1.85, 2.4), 2.2),
    ),
    nose=replace(
        ADA.nose,
        bridge=Bone((0, 1.3, 6.15), (0, -2.0, 7.6), (0.55, 0.66), 1.25),
        tip=Ball((0, -2.30, 7.95), (0.88, 0.70, 0.80), 0.9),
        wing=Ball((0.98, -2.62, 7.25), (0.56, 0.48, 0.74), 0.75),
    ),
    eye=replace(ADA.eye, upper_opening=1.10, lower_opening=0.84, outer_corner=0.28, inner_corner=-0.20),
    mouth=replace(
        ADA.mouth, half_width=2.15, upper_lip=0.72, lower_lip=0.86, upper_fullness=0.38, lower_fullness=0.48
    ),
    brow=Brow(
        x=((0, 1.42), (0.3, 2.8), (0.65, 4.4), (1, 5.7)),
        y=((0, 2.55), (0.3, 2.98), (0.65, 3.22), (1, 2.58)),
        thickness=0.22,
    ),
    hair=Hair(
        line=(
            (0, 6.6), (0.42, 6.4), (0.80, 5.2), (1.02, 3.4), (1.16, 1.6), (1.27, 0.6), (1.36, 0.6),
            (1.50, 1.45), (1.64, 1.35), (1.80, -0.2), (2.05, -2.6), (2.5, -3.8), (3.141592653589793, -4.0),
        ),
        volume=0.75,
        grooves=1.5,
        bun=Ball((0, 11.2, -7.6), (3.9, 3.2, 3.9), 0),
    ),
    colours=Colours(
        skin=(0.53, 0.365, 0.285),
        lip=(0.50, 0.255, 0.235),
        cheek=(0.57, 0.31, 0.25),
        iris=(0.38, 0.24, 0.10),
        brow=(0.10, 0.07, 0.06),
        lash=(0.05, 0.04, 0.04),
        hair=(0.15, 0.105, 0.09),
        shirt=(0.62, 0.42, 0.16),
    ),
)  # fmt: skip
CHARACTERS: dict[str, Anatomy] = {
    "ada": ADA,
    "bruno": BRUNO,
    "mira": MIRA,
}
"""File name -> anatomy; ada is the face that opens by default."""
PRODUCTION = ("mira",)
"""Characters with the large set of shapes."""
