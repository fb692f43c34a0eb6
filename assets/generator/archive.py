"""Writes .npz files that depend on nothing but their arrays: equal arrays, equal bytes."""

import io
import zipfile
from pathlib import Path

import numpy as np

EPOCH = (1980, 1, 1, 0, 0, 0)
"""The oldest time that a zip can tell."""


def write_archive(path: Path, arrays: dict[str, np.ndarray]) -> None:
    """Write the arrays in the given order, compressed, without time stamps or pickles."""
    with zipfile.ZipFile(path, "w") as archive:
        for name, array in arrays.items():
            buffer = io.BytesIO()
            np.lib.format.write_array(buffer, np.ascontiguousarray(array), allow_pickle=False)
            entry = zipfile.ZipInfo(name + ".npy", EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, buffer.getvalue(), compresslevel=9)
