"""The made-up faces have exactly the sizes of the paper's Table 1."""

import numpy as np
import pytest

from facepin.core.mesh.topology import edge_count
from facepin.figures.bench.stand_ins import TABLE_1, TableRow, stand_in


@pytest.mark.parametrize("row", TABLE_1, ids=lambda row: row.name)
def test_counts_are_those_of_the_table(row: TableRow) -> None:
    rig = stand_in(row)
    counts = rig.vertex_count, edge_count(rig), len(rig.face_sizes), rig.shape_count
    assert counts == (row.vertices, row.edges, row.faces, row.shapes)
    assert len(np.unique(rig.triangles)) == rig.vertex_count, "every vertex is on a face"
    assert (rig.largest_moves > 0.01 * rig.height).all() and not rig.warnings


def test_a_stand_in_is_always_the_same() -> None:
    one, other = stand_in(TABLE_1[3]), stand_in(TABLE_1[3])
    np.testing.assert_array_equal(one.deltas.data, other.deltas.data)
    np.testing.assert_array_equal(one.neutral, other.neutral)


def test_sizes_of_no_mesh_are_refused() -> None:
    with pytest.raises(ValueError, match="no ball with holes has 500 vertices, 10 edges"):
        stand_in(TableRow("none", 500, 10, 480, 3, 0.0, 0.0))
