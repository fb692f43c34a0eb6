"""Folders that were parsed before."""

import os

import numpy as np
import pytest

from facepin.files import open_rig
from facepin.files.obj import cache as module
from support.sample_files import POSITIONS, dense, face_folder, obj_lines


@pytest.fixture
def reads(monkeypatch):
    """Names of the .obj files that were parsed."""
    import facepin.files.obj.folder as folder_reader

    seen = []
    original = folder_reader.cut_lines

    def noted(content, name):
        seen.append(name)
        return original(content, name)

    monkeypatch.setattr(folder_reader, "cut_lines", noted)
    return seen


def same(one, other):
    arrays = ("neutral", "corners", "face_sizes", "triangles", "limits", "rest_weights")
    return (
        all(np.array_equal(getattr(one, name), getattr(other, name)) for name in arrays)
        and np.array_equal(dense(one), dense(other))
        and (one.name, one.shape_names, one.parts, one.warnings, one.source)
        == (other.name, other.shape_names, other.parts, other.warnings, other.source)
    )


def test_a_folder_is_parsed_once(tmp_path, reads):
    folder, cache = face_folder(tmp_path / "f"), tmp_path / "cache"
    (folder / "still.obj").write_text(obj_lines(POSITIONS, "usemtl a\nf 1 2 3\n"))
    first = open_rig(folder, cache_folder=cache)
    assert len(reads) == 4
    assert same(open_rig(folder, cache_folder=cache), first)
    assert len(reads) == 4
    open_rig(folder, cache=False)
    assert len(reads) == 8


def test_a_changed_file_another_neutral_or_a_new_file_is_noticed(tmp_path, reads):
    folder, cache = face_folder(tmp_path / "f"), tmp_path / "cache"
    open_rig(folder, cache_folder=cache)
    reads.clear()
    changed, before = folder / "smile.obj", (folder / "smile.obj").stat()
    text = changed.read_text()
    changed.write_text(text.replace("1.", "2."))
    os.utime(changed, ns=(before.st_atime_ns, before.st_mtime_ns))
    assert changed.read_text() != text and changed.stat().st_size == before.st_size
    rig = open_rig(folder, cache_folder=cache)
    assert len(reads) == 3 and same(rig, open_rig(folder, cache=False))
    (folder / "smile.obj").rename(folder / "grin.obj")
    assert open_rig(folder, cache_folder=cache).shape_names == ("blink", "grin")
    (folder / "frown.obj").write_text(obj_lines(POSITIONS + 1))
    assert open_rig(folder, cache_folder=cache).shape_names == ("blink", "frown", "grin")
    (folder / "blink.obj").write_text(obj_lines(POSITIONS, "f 1 2 3\n"))
    assert "face_neutral" in open_rig(folder, cache_folder=cache, neutral="blink").shape_names


def broken_by_truncation(entry):
    entry.write_bytes(entry.read_bytes()[: entry.stat().st_size // 2])


def broken_by_flipped_bytes(entry):
    content = bytearray(entry.read_bytes())
    for at in range(200, len(content), 97):
        content[at] ^= 0xFF
    entry.write_bytes(content)


def broken_by_wrong_numbers(entry):
    arrays = dict(np.load(entry))
    arrays["rows"] = arrays["rows"] + 10**6
    np.savez(entry, **arrays)


def broken_by_nan(entry):
    arrays = dict(np.load(entry))
    arrays["values"] = arrays["values"] * np.float32(np.nan)
    np.savez(entry, **arrays)


def broken_by_a_missing_array(entry):
    arrays = dict(np.load(entry))
    del arrays["starts"]
    np.savez(entry, **arrays)


def broken_by_objects(entry):
    arrays = dict(np.load(entry))
    arrays["names"] = np.array([{"a": 1}, None], dtype=object)
    np.savez(entry, **arrays)


@pytest.mark.parametrize(
    "harm", [fault for name, fault in sorted(globals().items()) if name.startswith("broken_")]
)
def test_a_broken_entry_is_ignored_and_rewritten(tmp_path, reads, harm):
    folder, cache = face_folder(tmp_path / "f"), tmp_path / "cache"
    first = open_rig(folder, cache_folder=cache)
    (entry,) = cache.iterdir()
    harm(entry)
    reads.clear()
    assert same(open_rig(folder, cache_folder=cache), first)
    assert len(reads) == 3
    assert same(open_rig(folder, cache_folder=cache), first)
    assert len(reads) == 3


def test_a_cache_that_cannot_be_written_does_not_matter(tmp_path):
    folder = face_folder(tmp_path / "f")
    (tmp_path / "file").write_text("not a folder")
    assert open_rig(folder, cache_folder=tmp_path / "file").shape_count == 2
    assert open_rig(folder, cache_folder=tmp_path / "file" / "deeper").shape_count == 2


def test_old_entries_go(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "MOST_ENTRIES", 2)
    cache = tmp_path / "cache"
    for number in range(4):
        open_rig(face_folder(tmp_path / f"f{number}"), cache_folder=cache)
    assert len(list(cache.iterdir())) == 2


def test_the_cache_lies_in_the_users_own_folder_by_default(tmp_path, monkeypatch):
    import platformdirs

    monkeypatch.setattr(platformdirs, "user_cache_path", lambda *names, **more: tmp_path / "cache")
    open_rig(face_folder(tmp_path / "f"))
    assert len(list((tmp_path / "cache" / "rigs").iterdir())) == 1
