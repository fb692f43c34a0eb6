"""`facepin figures`: the paper's figures on a page."""

from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facepin.__main__ import main
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.figures.paper import command as paper
from facepin.figures.paper import remakes
from facepin.figures.paper.page import Remake, Table, page
from facepin.figures.posing import (
    DELIGHT,
    dragged,
    handles,
    in_sight,
    most_moved_in_sight,
    named_weights,
)
from facepin.options import open_with_bar
from support.small_rigs import sheet


class _Links(HTMLParser):
    """Collects what a page points to, and checks that every tag is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.ids: set[str] = set()
        self.open: list[str] = []
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        found = dict(attributes)
        self.links += [found[name] or "" for name in ("href", "src") if name in found]
        self.ids |= {found["id"] or ""} if "id" in found else set()
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def two_layers(front: Rig) -> Rig:
    """A sheet with another one behind it, which the same shapes move more."""
    n = front.vertex_count
    faces = np.concatenate([front.corners, front.corners + n])
    deltas = []
    for j, name in enumerate(front.shape_names):
        delta = front.deltas[:, [j]].toarray().reshape(-1, 3)
        deltas.append((name, np.concatenate([delta, 2 * delta])))
    back = front.neutral - np.array([0, 0, 0.5], np.float32)
    return build_rig("two", np.concatenate([front.neutral, back]), faces, np.full(len(faces) // 4, 4), deltas)


def test_pins_go_where_a_mouse_could_press() -> None:
    rig = two_layers(sheet())
    n = rig.vertex_count // 2
    assert in_sight(rig, 40) and not in_sight(rig, 40 + n)
    weights = np.array([0.8, 0.0, 0.6, 0.0])
    wanted = rig.evaluate(weights)
    chosen = most_moved_in_sight(rig, wanted, 5)
    assert len(chosen) == 5 and max(chosen) < n
    gaps = np.linalg.norm(rig.neutral[list(chosen)][:, None] - rig.neutral[list(chosen)], axis=2)
    assert gaps[np.triu_indices(5, 1)].min() > 0.06 * rig.height
    moved = np.linalg.norm(wanted - rig.neutral, axis=1)
    assert moved[chosen[0]] == moved[:n].max()
    assert len(handles(rig, weights)) == 2
    for pin in dragged(rig, chosen, wanted):
        assert pin.goal[:2] == pytest.approx(wanted[pin.vertex, :2])
        assert pin.goal[2] == pytest.approx(rig.neutral[pin.vertex, 2]), "a mouse leaves depth as it was"


def test_expressions_are_found_by_any_spelling() -> None:
    flat = sheet()
    names = ("jawOpen", "mouthSmile_L", "browInnerUp_L", "browInnerUp_R")
    delta = flat.deltas[:, [0]].toarray().reshape(-1, 3)
    rig = build_rig("f", flat.neutral, flat.corners, flat.face_sizes, [(name, delta) for name in names])
    assert named_weights(rig, DELIGHT).tolist() == [0.5, 0.8, 0.9, 0.9]


def test_the_page_escapes_what_it_is_given_and_points_below_its_folder(tmp_path: Path) -> None:
    remake = Remake(
        "Figure 1",
        "<b>",
        "1 < 2 & 3",
        '"made"',
        ((tmp_path / "a b" / "x.png", 'a "picture"'),),
        Table(("rig", "n"), (("<i>", "2"),)),
        (tmp_path / "weights.csv",),
    )
    text = page("Title & co", "lead", [("<rig>", [remake])], tmp_path)
    found = _Links(text)
    assert "<i>" not in text and "1 &lt; 2 &amp; 3" in text
    assert {"a b/x.png", "weights.csv"} <= set(found.links)
    assert {link.removeprefix("#") for link in found.links if link.startswith("#")} <= found.ids
    assert "prefers-color-scheme: dark" in text and "http" not in text


@pytest.fixture
def light(monkeypatch: pytest.MonkeyPatch) -> Rig:
    """Small pictures, and a small rig instead of the built-in faces."""
    rig = sheet(shapes=8)
    monkeypatch.setattr(paper, "PANE", (60, 70))
    monkeypatch.setattr(remakes, "SMALL", (40, 48))
    monkeypatch.setattr(remakes, "MANY_SHAPES", 7)
    monkeypatch.setattr(paper, "open_with_bar", lambda path: rig)
    return rig


def test_all_figures_are_made_and_linked(light: Rig, tmp_path: Path) -> None:
    assert main(["figures", "--no-table", "--out", str(tmp_path / "out")]) == 0
    text = (tmp_path / "out/index.html").read_text()
    for number in ("Figures 2 and 3", "Figures 4 and 6", "Figure 5", "Figure 7", "Figure 8"):
        assert text.count(f"<b>{number}</b>") == 1
    assert "seed 1" in text and "sheet: 81 vertices, 8 shapes" in text
    links = [link for link in _Links(text).links if not link.startswith("#")]
    assert len(links) > 20
    for link in links:
        path = tmp_path / "out" / link
        assert path.is_file()
        if path.suffix == ".png":
            with Image.open(path) as picture:
                picture.load()


def test_a_seed_makes_the_same_files_and_another_seed_others(tmp_path: Path) -> None:
    rig, made = sheet(), []
    for name in ("one", "same"):
        remake = remakes.target_pose(remakes.Studio(rig, tmp_path / name, 1, None, None))
        paths = [*(path for path, _ in remake.images), *remake.files]
        made.append({path.name: path.read_bytes() for path in paths if path.name != "figures.json"})
    assert len(made[0]) > 5 and made[0] == made[1]
    one, other = (remakes.in_steps(remakes.Studio(rig, tmp_path, seed, None, None)) for seed in (1, 2))
    assert one.text != other.text


def test_the_steps_of_figure_8_come_closer_to_what_is_meant(tmp_path: Path) -> None:
    studio = remakes.Studio(open_with_bar(None), tmp_path, 1, None, None)
    remake = remakes.in_steps(studio)
    assert remake.title == "From the neutral in 6 steps, by transposition"
    first, last = (float(word) for word in remake.text.replace(",", " ").split() if word.startswith("0."))
    assert last < first


def test_gamma_is_the_smallest_singular_value(tmp_path: Path) -> None:
    rig = open_with_bar(None)
    remake = remakes.hybrid_pins(remakes.Studio(rig, tmp_path, 1, None, None))
    wanted = rig.evaluate(named_weights(rig, remakes.ANGER))
    (vertex,) = most_moved_in_sight(rig, wanted, 1)
    rows = rig.deltas.toarray()[3 * vertex : 3 * vertex + 3]
    assert f"{np.linalg.svd(rows)[1].min():.3f} with 1" in remake.text


def test_table_1_has_the_papers_numbers_beside_ours(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(paper, "TABLE_1", paper.TABLE_1[:1])
    table = paper.table_1([sheet()], None).table
    assert table is not None
    ours, theirs = table.rows
    assert ours[:5] == ("sheet", "81", "144", "64", "4") and ours[6] == ours[8] == ""
    assert theirs[1:5] == ("6,720", "19,984", "13,264", "40") and (theirs[6], theirs[8]) == ("150", "9.9")
    assert float(ours[5]) > 0 and float(ours[7]) > 0


def test_a_rig_that_does_not_move_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    flat = sheet()
    arrays = {"neutral": flat.neutral, "faces": flat.corners.reshape(-1, 4)}
    np.savez(tmp_path / "still.npz", deltas=np.zeros((1, 81, 3)), **arrays)
    command = ["figures", str(tmp_path / "still.npz"), "--no-table", "--out", str(tmp_path / "out")]
    assert main(command) == 2
    assert "no shape moves the face" in capsys.readouterr().err.splitlines()[-1]
    assert not (tmp_path / "out/index.html").exists()
