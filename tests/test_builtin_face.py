"""The built-in faces: the committed files are what the generator makes."""

import sys
from pathlib import Path

import numpy as np
import pytest

ASSETS = Path(__file__).resolve().parents[1] / "assets"


@pytest.fixture(scope="module")
def ada():
    """The default character, made afresh."""
    sys.path.insert(0, str(ASSETS))
    from generator.assembly import build_model
    from generator.character import build_character
    from generator.characters import CHARACTERS

    yield build_model(build_character(CHARACTERS["ada"]))
    sys.path.remove(str(ASSETS))


def test_committed_file_is_what_the_generator_makes(ada):
    from generator.assembly import arrays

    made = arrays(ada)
    with np.load(ASSETS / "faces" / "ada.npz", allow_pickle=False) as stored:
        assert set(stored.files) == set(made)
        for name, array in made.items():
            if array.dtype.kind == "f":
                np.testing.assert_allclose(stored[name], array, atol=1e-4, err_msg=name)
            else:
                np.testing.assert_array_equal(stored[name], array, err_msg=name)


def test_files_depend_on_the_arrays_only(ada, tmp_path):
    from generator.archive import write_archive

    for name in ("one.npz", "two.npz"):
        write_archive(tmp_path / name, {"a": np.arange(3), "b": np.eye(2)})
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "two.npz").read_bytes()
