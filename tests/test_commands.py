"""The command line: what it prints, what it writes, and how it refuses."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import lsq_linear

from facepin.__main__ import main
from facepin.core.errors import FacepinError
from facepin.core.look.shading import MODES
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.files import open_rig, write_model
from facepin.session.solving.solving import PinSolver, Solved
from facepin.solvers import SOLVERS
from support.small_rigs import sheet


@pytest.fixture(scope="module")
def ict(shared: Path) -> Path:
    return shared / "models/ict-facekit/ict_expressions.glb"


@pytest.fixture(scope="module")
def ict_rig(ict: Path) -> Rig:
    return open_rig(ict)


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("rig") / "sheet.glb"
    write_model(sheet(), np.zeros(4), path)
    return path


def _in_a_box(square: np.ndarray, right: np.ndarray, limits: np.ndarray) -> np.ndarray:
    """argmin ½wᵀHw − qᵀw within limits, by scipy's bounded-variable least squares."""
    root = cholesky(square)
    target = solve_triangular(root, right, trans="T")
    return lsq_linear(root, target, (limits[:, 0], limits[:, 1]), method="bvls", tol=1e-14, max_iter=2000).x


def _expected(key: str, J: np.ndarray, d: np.ndarray, rig: Rig) -> np.ndarray:
    """The formulas of the paper for w0 = 0, and of the two solvers of ours, written out once more."""
    g = J.T @ d
    tau = g @ g / ((J @ g) @ (J @ g))
    k = J.shape[1]
    match key:
        case "pseudo_inverse":
            return np.linalg.pinv(J) @ d
        case "tikhonov":
            return np.linalg.solve(J.T @ J + 0.001 * np.eye(k), g)
        case "transpose":
            return tau * g
        case "hybrid":
            gamma = min(max(np.linalg.svd(J, compute_uv=False).min(), 0), 1)
            return gamma * np.linalg.pinv(J) @ d + (1 - gamma) * tau * g
        case "sparse":
            sizes = np.linalg.norm(rig.deltas.toarray().T.reshape(k, -1, 3).astype(float), axis=2).max(axis=1)
            scale = np.mean(sizes**2)
            price = SOLVERS[key].settings().price * scale**0.5 * np.maximum(sizes, scale**0.5 / 3)
            return _in_a_box(J.T @ J + 1e-6 * scale * np.eye(k), g - price, rig.limits)
        case "bounded":
            alpha = SOLVERS[key].settings().alpha * rig.scale
            return _in_a_box(J.T @ J + alpha * np.eye(k), g, rig.limits)
    raise AssertionError(f"no formula for {key}")


@pytest.mark.parametrize("count", [1, 5, 15])
def test_solve_prints_what_the_formulas_say(
    ict: Path, ict_rig: Rig, count: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    random = np.random.default_rng(count)
    moved = np.flatnonzero(np.abs(ict_rig.evaluate(np.full(53, 0.3)) - ict_rig.neutral).sum(axis=1) > 0.3)
    vertices = random.choice(moved, count, replace=False)
    moves = random.uniform(-0.6, 0.6, (count, 3))
    pins = [{"vertex": int(v), "move": m.tolist()} for v, m in zip(vertices, moves, strict=True)]
    (tmp_path / "pins.json").write_text(json.dumps({"pins": pins}))
    assert main(["solve", str(ict), "--pins", str(tmp_path / "pins.json"), "--solver", "all"]) == 0
    found = json.loads(capsys.readouterr().out)["solvers"]
    assert list(found) == list(SOLVERS)
    B = ict_rig.deltas.toarray().astype(float)
    J = B[(3 * vertices[:, None] + np.arange(3)).ravel()]
    d = moves.ravel()
    for key, answer in found.items():
        weights = np.array([answer["weights"][name] for name in ict_rig.shape_names])
        # What the hand's answer minimises is checked where its solver is.
        expected = weights if key == "hand" else _expected(key, J, d, ict_rig)
        # The pseudo-inverse is as large as the pins are contradictory; 1e-6 is meant of what is large.
        tolerance = 1e-6 * max(1.0, np.abs(expected).max())
        np.testing.assert_allclose(weights, expected, atol=tolerance, err_msg=key)
        miss = np.linalg.norm((J @ expected - d).reshape(-1, 3), axis=1).mean()
        assert answer["pin_error"] == pytest.approx(miss, rel=1e-5, abs=1e-6)
        outside = (expected < -1e-6) | (expected > 1 + 1e-6)
        assert answer["out_of_range"] == np.count_nonzero(outside)
        assert answer["milliseconds"] > 0
        assert "settings" in answer


def test_solve_takes_settings_a_start_and_limits_and_writes_poses(
    small: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "pins.json").write_text('{"pins": [{"vertex": 30, "move": [2, 2, 0]}]}')
    (tmp_path / "start.json").write_text(
        '{"format": "facepin-pose", "version": 1, "weights": {"shape0": 0.5}}'
    )
    words = ["solve", str(small), "--pins", str(tmp_path / "pins.json"), "--solver", "transpose,tikhonov"]
    words += ["--start", str(tmp_path / "start.json"), "--limits", "--set", "tikhonov.alpha=0.5"]
    words += ["--set", "step=unit", "--out", str(tmp_path / "pose.json")]
    assert main(words) == 0
    printed = capsys.readouterr()
    found = json.loads(printed.out)["solvers"]
    assert found["tikhonov"]["settings"]["alpha"] == 0.5
    assert found["transpose"]["settings"]["step"] == "unit"
    J, d, w0 = sheet().rows_at([30]), np.array([2.0, 2.0, 0.0]), np.array([0.5, 0, 0, 0])
    expected = {
        "transpose": w0 + J.T @ (d - J @ w0),
        "tikhonov": np.linalg.solve(J.T @ J + 0.5 * np.eye(4), J.T @ d + 0.5 * w0),
    }
    for key, weights in expected.items():
        clipped = np.clip(weights, 0, 1)
        np.testing.assert_allclose(list(found[key]["weights"].values()), clipped, atol=1e-6)
        pose = json.loads((tmp_path / f"pose-{key}.json").read_text())
        np.testing.assert_allclose(list(pose["weights"].values()), clipped, atol=1e-6)


def test_info_in_words_and_as_json(small: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["info", str(small), "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert set(facts) == {
        "name", "vertices", "edges", "faces", "triangles", "shapes", "combinations", "parts", "warnings",
    }  # fmt: skip
    assert facts["combinations"] == 0
    assert facts["vertices"] == 81
    assert facts["triangles"] == 128
    assert facts["shapes"] == ["shape0", "shape1", "shape2", "shape3"]
    assert main(["info", str(small)]) == 0
    assert "81" in capsys.readouterr().out


def test_render_draws_the_asked_size_and_view(small: Path, tmp_path: Path) -> None:
    for view, share in (("front", 0.4), ("left", 0.0)):
        out = tmp_path / f"{view}.png"
        words = [
            "render",
            str(small),
            "--size",
            "300x200",
            "--view",
            view,
            "--transparent",
            "--out",
            str(out),
        ]
        assert main(words) == 0
        picture = np.asarray(Image.open(out))
        assert picture.shape == (200, 300, 4)
        # A flat sheet: a square from the front, next to nothing from the side.
        covered = (picture[..., 3] > 128).mean()
        assert abs(covered - share) < 0.2


def test_render_shades_and_shows_pins_as_asked(small: Path, tmp_path: Path) -> None:
    pins = '[{"vertex": 40, "move": [0, 0, 0]}]'
    weights = '{"shape0": 1.0}'
    pose = tmp_path / "pose.json"
    pose.write_text(f'{{"format": "facepin-pose", "version": 1, "weights": {weights}, "pins": {pins}}}')

    def render(*words: str) -> np.ndarray:
        out = str(tmp_path / "x.png")
        assert main(["render", str(small), "--pose", str(pose), "--size", "90x60", *words, "--out", out]) == 0
        return np.asarray(Image.open(out).convert("RGB")).astype(int)

    looks = [render("--shading", mode) for mode in MODES if mode != "clay"]  # what this rig is made of anyway
    looks += [render("--pins-shown"), render("--pins-shown", "--scale", "2"), render("--supersampling", "2")]
    for at, one in enumerate(looks):
        assert one.shape == (60, 90, 3)
        for other in looks[:at]:
            assert np.abs(one - other).max() > 3
    np.testing.assert_array_equal(looks[0], render())


@pytest.mark.parametrize("suffix", [".glb", ".obj", ".ply", ".stl"])
def test_export_writes_the_posed_face(small: Path, tmp_path: Path, suffix: str) -> None:
    (tmp_path / "pose.json").write_text(
        '{"format": "facepin-pose", "version": 1, "weights": {"shape1": 0.8}}'
    )
    out = tmp_path / f"posed{suffix}"
    assert main(["export", str(small), "--pose", str(tmp_path / "pose.json"), "--out", str(out)]) == 0
    assert out.stat().st_size > 1000
    if suffix == ".glb":
        again = open_rig(out)
        np.testing.assert_allclose(again.rest_weights, [0, 0.8, 0, 0], atol=1e-6)
        np.testing.assert_allclose(again.deltas.toarray(), sheet().deltas.toarray(), atol=1e-6)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["nonsense"], "neither a rig nor a command"),
        (["info"], "RIG"),
        (["info", "missing.glb"], "no such file"),
        (["solve", "RIG", "--pins", "missing.json"], "missing.json"),
        (["solve", "RIG", "--pins", "PINS", "--solver", "magic"], "there is no solver 'magic'"),
        (["solve", "RIG", "--pins", "PINS", "--set", "alpha=lots"], "alpha"),
        (["solve", "RIG", "--pins", "PINS", "--set", "beta=1"], "beta"),
        (["render", "RIG", "--size", "0x10", "--out", "x.png"], "--size"),
        (["render", "RIG", "--out", "x.jpg"], ".png"),
        (["render", "RIG", "--out", "x.png", "--supersampling", "9"], "--supersampling"),
        (["render", "RIG", "--out", "x.png", "--scale", "0"], "--scale"),
        (["render", "RIG", "--out", "x.png", "--shading", "wax"], "wax"),
        (["export", "RIG", "--out", "x.fbx"], ".fbx"),
        (["--compare", "transpose,hybrid,sparse,bounded,tikhonov"], "do not fit"),
        (["--compare", "hybrid", "--solver", "sparse"], "--solver and --compare"),
        (["inof", "RIG"], "'inof' is neither"),
        (["a" * 300], "too long"),
        (["render", "RIG", "--out", "no-folder/x.png"], "no folder no-folder"),
        (["solve", "RIG", "--pins", "PINS", "--out", "."], "'.'"),
        (["solve", "RIG", "--pins", "PINS", "--out", "x.txt"], "x.txt"),
        (
            ["solve", "RIG", "--pins", "FAR", "--solver", "pseudo_inverse", "--out", "x.json"],
            "within 1e+06 face heights",
        ),
        (["solve", "RIG", "--pins", "SKEW"], "length 1 at right angles"),
    ],
)
def test_errors_are_one_line_and_exit_status_2(
    small: Path,
    tmp_path: Path,
    words: list[str],
    told: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    (tmp_path / "pins.json").write_text('{"pins": [{"vertex": 3, "move": [0, 1, 0]}]}')
    (tmp_path / "far.json").write_text('{"pins": [{"vertex": 3, "goal": [0, 0, 9e8]}]}')
    skew = {"vertex": 3, "move": [0, 1, 0], "freedom": "screen", "axes": [[1, 0, 0], [1, 0.001, 0]]}
    (tmp_path / "skew.json").write_text(json.dumps({"pins": [skew]}))
    places = {"RIG": str(small), "PINS": str(tmp_path / "pins.json")}
    places |= {"FAR": str(tmp_path / "far.json"), "SKEW": str(tmp_path / "skew.json")}
    monkeypatch.chdir(tmp_path)
    assert main([places.get(word, word) for word in words]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("facepin: ")
    assert printed.err.count("\n") == 1
    assert told in printed.err


@pytest.mark.parametrize(
    "command",
    [
        *("", "info", "solve", "render", "export", "bench", "compare", "study", "figures"),
        *("sheet", "turntable", "movie"),
    ],
)
def test_every_command_has_help(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        main([*command.split(), "--help"])
    assert stopped.value.code == 0
    assert "usage: facepin" in capsys.readouterr().out


def test_the_program_is_a_module_and_a_script() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "facepin", "--version"], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("facepin ")


def test_a_built_in_face_is_known_by_name(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["info", "bruno", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["name"] == "bruno"


def test_names_in_any_script_are_printed_whatever_the_terminal_knows(tmp_path: Path) -> None:
    rig = sheet()
    named = build_rig(
        "笑い", rig.neutral, rig.triangles.ravel(), np.full(len(rig.triangles), 3), [("笑い", rig.neutral)]
    )
    write_model(named, np.zeros(1), tmp_path / "a.glb")
    done = subprocess.run(
        [sys.executable, "-m", "facepin", "info", tmp_path / "a.glb", "--json"],
        capture_output=True,
        check=True,
        env={**os.environ, "PYTHONIOENCODING": "cp1252"},
    )
    assert json.loads(done.stdout.decode())["shapes"] == ["笑い"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no such device here")
def test_a_full_disk_is_told_of_in_one_line() -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "facepin", "info", "ada"], stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert done.returncode == 2
    assert done.stderr.startswith("facepin: ") and done.stderr.count("\n") == 1


def test_a_solver_that_fails_leaves_the_others(
    small: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "pins.json").write_text('{"pins": [{"vertex": 3, "move": [0, 1, 0]}]}')
    plain = PinSolver.solve

    def one_fails(solver: PinSolver, *rest: object) -> Solved:
        if solver.choice.kind.key == "hybrid":
            raise FacepinError("hybrid gave up")
        return plain(solver, *rest)

    monkeypatch.setattr(PinSolver, "solve", one_fails)
    words = ["solve", str(small), "--pins", str(tmp_path / "pins.json"), "--solver"]
    assert main([*words, "all"]) == 0
    printed = capsys.readouterr()
    assert set(json.loads(printed.out)["solvers"]) == set(SOLVERS) - {"hybrid"}
    assert printed.err == "facepin: hybrid gave up\n"
    assert main([*words, "hybrid"]) == 2
