"""Fast products with B against plain sparse and dense algebra."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from facepin.core import columns as columns_module
from facepin.core.columns import Columns


def matrix(densities: list[float], vertices: int = 200, seed: int = 0) -> csc_array:
    random = np.random.default_rng(seed)
    size = 3 * vertices
    dense = random.normal(size=(size, len(densities))) * (
        random.uniform(size=(size, len(densities))) < densities
    )
    return csc_array(dense.astype(np.float32))


KINDS = {
    "sparse": [0.01, 0.05, 0.1],
    "dense": [1.0, 0.5, 0.9],
    "mixed": [0.02, 1.0, 0.0, 0.4, 0.1, 0.05, 0.8],
    "still": [0.0, 0.0],
    "barely": [0.1] * 12 + [0.2],
    "one": [0.3],
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("active", [0.0, 0.2, 1.0])
def test_product(kind: str, active: float) -> None:
    deltas = matrix(KINDS[kind])
    random = np.random.default_rng(1)
    columns = Columns(deltas)
    for _ in range(20):
        weights = random.normal(size=deltas.shape[1]) * (random.uniform(size=deltas.shape[1]) <= active)
        product = columns.product(weights)
        assert product.dtype == np.float32
        np.testing.assert_allclose(product, deltas.toarray().astype(np.float64) @ weights, atol=1e-5)


@pytest.mark.parametrize("kind", KINDS)
def test_rows_and_largest_moves(kind: str) -> None:
    deltas = matrix(KINDS[kind])
    columns = Columns(deltas)
    wanted = np.array([5, 5, 0, 599, 17, 300])
    np.testing.assert_array_equal(columns.rows(wanted), deltas.toarray()[wanted])
    assert columns.rows(wanted[:0]).shape == (0, deltas.shape[1])
    lengths = np.linalg.norm(deltas.toarray().reshape(-1, 3, deltas.shape[1]), axis=1)
    np.testing.assert_allclose(columns.largest_moves(), lengths.max(axis=0), rtol=1e-6)


def test_too_large_columns_stay_sparse(monkeypatch: pytest.MonkeyPatch) -> None:
    deltas = matrix(KINDS["dense"])
    monkeypatch.setattr(columns_module, "DENSE_BYTES", 600 * 4)
    columns = Columns(deltas)
    weights = np.array([1.0, -2.0, 0.5])
    np.testing.assert_allclose(columns.product(weights), deltas.toarray() @ weights, atol=1e-5)
    np.testing.assert_array_equal(columns.rows(np.arange(600)), deltas.toarray())
