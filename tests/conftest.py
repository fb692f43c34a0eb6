"""Fixtures shared by all tests."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from facepin.core.errors import FacepinError

if TYPE_CHECKING:
    import moderngl

SHARED = Path(__file__).resolve().parents[2] / "shared"


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of real models beside the checkout; tests that need it are skipped where it is missing."""
    if not SHARED.is_dir():
        pytest.skip("the folder of test models beside the checkout is missing")
    return SHARED


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--regenerate", action="store_true", help="store the golden pictures anew")


@pytest.fixture(scope="module")
def gl_context() -> Iterator["moderngl.Context"]:
    """One windowless OpenGL context per test file."""
    from facepin.gpu.picture import open_context

    try:
        ctx = open_context()
    except FacepinError as error:
        if "FACEPIN_SCREEN" in os.environ:
            raise  # where a screen was set up for the tests, software OpenGL is there too
        pytest.skip(str(error))
    yield ctx
    ctx.release()


@pytest.fixture
def gl(gl_context: "moderngl.Context") -> Iterator["moderngl.Context"]:
    """The context, with a check that no OpenGL error is left over before and after the test."""
    assert gl_context.error == "GL_NO_ERROR"
    yield gl_context
    assert gl_context.error == "GL_NO_ERROR"
