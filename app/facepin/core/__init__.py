"""Values and numbers: rig, pins, pose, camera, picking.  numpy and scipy only.

Conventions, stated once:

- Space is right-handed with y up; a camera looks down its own -z.
- Lengths are in the rig file's own unit, angles in radians.
- Pixels are framebuffer pixels, origin top left, y down; a pixel's centre is at +0.5.
- Vectors are rows, (n, 3); matrices act on columns and are transposed only when uploaded.
- Geometry is float32, weights and solver input float64.
- A vertex index is the index in the file as loaded; it is never changed.
- Arrays inside a frozen value are read-only, so a value can be shared and compared by identity.
"""
