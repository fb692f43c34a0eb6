"""Makes the built-in faces from anatomical parameters, with numpy and scipy only.

`python assets/make_faces.py` writes assets/faces/*.npz.  Everything here is written from scratch: no geometry
is taken from elsewhere.  The way from parameters to a rig:

- `anatomy` names every number of a character, `characters` holds the characters;
- `field` turns them into one signed distance field, the head;
- `topology` is a fixed grid of quads with rings round eye and mouth, `openings` are the curves of lids and
  lips, `lids` lays the rings round the eye, and `skin` the whole grid on the field (one half, then mirrored:
  symmetry is exact);
- `eyes`, `mouth_parts`, `brows`, `ears`, `hair` and `shirt` are the other meshes, `colours` paints the skin;
- `landmarks` carries places between faces, so that shapes and paint are written once, on a reference face;
- `deformer` spreads displacements of lips, lids and brows over the skin with the matrices of `operators`,
  `shapes_*` say what shapes move, `folds` where skin folds with them;
- `assembly` joins all of it, `archive` writes it, `checks` measures it.

Conventions: +x is the character's left, y up, z forward, about centimetres; angles in degrees where named so.
"""
