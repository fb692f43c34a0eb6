"""The characters that come with the program."""

from generator.anatomy import Anatomy, Ball, Bone, Brow, Colours, Eye, Hair, Mouth, Nose, Skull

ADA = Anatomy(
    skull=Skull(
        face=Ball((0, -1.6, 0.65), (6.05, 6.35, 6.1), 3.0),
        jaw=Bone((1.45, -7.25, 4.6), (4.0, -4.7, 0.1), (1.4, 1.35), 2.8),
        chin=Ball((0, -7.75, 5.62), (1.5, 1.4, 1.85), 2.2),
        cheek=Ball((3.40, -2.55, 4.15), (2.35, 1.95, 2.45), 2.2),
        buccal=Ball((3.0, -4.7, 3.65), (2.05, 1.95, 2.05), 2.4),
        muzzle=Ball((0, -5.05, 5.2), (2.6, 2.35, 2.45), 2.0),
        neck=Bone((0, -14.0, -2.6), (0, -5.0, -1.6), (2.5, 2.8), 2.2),
    ),
    nose=Nose(
        bridge=Bone((0, 1.3, 6.15), (0, -2.0, 7.75), (0.52, 0.58), 1.0),
        tip=Ball((0, -2.22, 8.12), (0.78, 0.70, 0.82), 0.9),
        wing=Ball((0.84, -2.60, 7.35), (0.50, 0.48, 0.74), 0.75),
        columella=Bone((0, -2.55, 8.02), (0, -2.90, 6.9), (0.33, 0.38), 0.8),
        nostril=Ball((0.47, -3.10, 7.62), (0.24, 0.38, 0.34), 0.20),
        philtrum=Bone((0, -3.75, 7.98), (0, -4.55, 7.98), (0.14, 0.20), 0.6),
    ),
    eye=Eye(upper_opening=1.18, outer_corner=0.20, crease=0.06, socket=1.13, pupil=0.235),
    mouth=Mouth(
        height=-5.45,
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
    hair=Hair(locks=0.05),
    colours=Colours(),
)
CHARACTERS: dict[str, Anatomy] = {
    "ada": ADA,
}
"""File name -> anatomy; ada is the face that opens by default."""
