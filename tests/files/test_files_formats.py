"""The doors: which reader, progress, cancelling."""

import os

import pytest

from facepin.core.errors import FacepinError
from facepin.files import READERS, open_rig
from support.sample_files import face_arrays, face_folder, face_gltf


class GivenUpError(Exception):
    pass


def give_up_at(report):
    """Return a progress callback that raises at the given report, counted from 0."""
    reports = []

    def progress(fraction, line):
        reports.append(line)
        if len(reports) > report:
            raise GivenUpError

    return progress


def samples(folder):
    """Yield the same face in all formats."""
    import numpy as np

    np.savez(folder / "face.npz", **face_arrays())
    yield folder / "face.npz"
    yield face_gltf().save(folder / "face.glb")
    yield face_folder(folder / "face")


def test_every_format_is_listed():
    assert list(READERS) == ["folder", ".obj", ".glb", ".gltf", ".vrm", ".npz"]


def test_all_formats_tell_of_progress_and_can_be_given_up_at_any_time(tmp_path):
    for path in samples(tmp_path):
        told = []
        open_rig(path, cache=False, progress=lambda *report, told=told: told.append(report))
        fractions = [fraction for fraction, _ in told]
        assert fractions == sorted(fractions)
        assert fractions[0] == 0.0
        assert fractions[-1] == 1.0
        assert all(line and len(line) < 80 for _, line in told)
        assert len(told) >= 4
        for report in range(len(told)):
            with pytest.raises(GivenUpError):
                open_rig(path, cache_folder=tmp_path / "cache", progress=give_up_at(report))
        assert not list((tmp_path / "cache").glob(".*"))


def test_a_path_may_be_text(tmp_path):
    path = face_gltf().save(tmp_path / "face.glb")
    assert open_rig(str(path)).name == "face"


@pytest.mark.parametrize("name", ["face.usda", "face.fbx", "face", "face.target.gz", ".glb"])
def test_unknown_suffixes_name_what_is_supported(tmp_path, name):
    (tmp_path / name).write_bytes(b"#usda 1.0")
    with pytest.raises(FacepinError, match=r"no reader for .* a folder of \.obj files, \.obj, \.glb"):
        open_rig(tmp_path / name)


def test_what_is_not_there_or_no_file(tmp_path):
    with pytest.raises(FacepinError, match=r"none\.glb: no such file or folder"):
        open_rig(tmp_path / "none.glb")
    for name in ("a\0b.glb", "x" * 5000):
        with pytest.raises(FacepinError):
            open_rig(name)
    os.mkfifo(tmp_path / "pipe.glb")
    with pytest.raises(FacepinError, match="neither a file nor a folder"):
        open_rig(tmp_path / "pipe.glb")


def test_a_neutral_is_for_folders_only(tmp_path):
    with pytest.raises(FacepinError, match="folder of"):
        open_rig(face_gltf().save(tmp_path / "face.glb"), neutral="x")


def test_errors_of_the_system_become_a_line(tmp_path, monkeypatch):
    path = face_gltf().save(tmp_path / "face.glb")
    for error, words in (
        (PermissionError(13, "Permission denied"), "Permission denied"),
        (MemoryError(), "memory"),
    ):

        def fails(self, mode="r", error=error):
            raise error

        monkeypatch.setattr(type(path), "open", fails)
        with pytest.raises(FacepinError, match=rf"face\.glb: .*{words}"):
            open_rig(path)


def test_openusd_is_not_read_yet(shared):
    with pytest.raises(FacepinError, match=r"no reader for '\.usda'"):
        open_rig(shared / "models" / "openusd_blendshapes" / "blendshapes.usda")
