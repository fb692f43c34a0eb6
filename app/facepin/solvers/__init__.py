"""Solvers: from the displacement of the pins to the weights of the shapes.  numpy only.

A solver prepares what depends on the pin rows J alone, once per drag, and then answers every frame:

    solve = SOLVERS["transpose"].prepare(PinSystem(rows, limits, scale), TransposeSettings())
    weights = solve(displacement, start).weights

With w0 the weights at the start of the drag and r = d - J w0 what the pins still miss, the four solvers of
the paper return w0 plus a matrix times r; for w0 = 0 that is the paper's equation.  `sparse` and `bounded`
minimise within limits, `hand` balances forces within them.  A new solver is one file and one line below.
"""

from facepin.solvers import bounded, hand, hybrid, pseudo_inverse, sparse, tikhonov, transpose
from facepin.solvers.interface import SolverKind

SOLVERS: dict[str, SolverKind] = {
    "pseudo_inverse": pseudo_inverse.KIND,
    "tikhonov": tikhonov.KIND,
    "transpose": transpose.KIND,
    "hybrid": hybrid.KIND,
    "sparse": sparse.KIND,
    "bounded": bounded.KIND,
    "hand": hand.KIND,
}
"""Every solver by key, in the order they are shown."""
