"""Charts: what they show is what they were given, and the same input gives the same file."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image

from facepin.figures import chart_style, charts
from facepin.figures.charts import Series
from facepin.solvers import SOLVERS
from facepin.solvers.colours import INKS, REFERENCE

NAMES = [f"shape{j}" for j in range(60)]
LIMITS = np.tile([0.0, 1.0], (60, 1))


def some(seed: int, size: float = 0.5) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-size, size, 60)


SERIES = [
    Series("Reference", REFERENCE, np.where(np.arange(60) < 3, 0.8, 0.0)),
    Series("One", INKS["transpose"], some(1), "$E_{RMS}$ 0.3"),
    Series("Two", INKS["pseudo_inverse"], some(2, 500.0)),
]


def test_every_solver_has_a_look_of_its_own() -> None:
    assert list(INKS) == list(SOLVERS)
    for looks in zip(*INKS.values(), strict=True):
        assert len(set(looks)) == len(SOLVERS)


def test_sliders_show_numbers_and_bars_and_count_the_rest() -> None:
    figure = charts.slider_panels(NAMES, LIMITS, SERIES)
    rows = charts.strongest([each.weights for each in SERIES], charts.MOST_SLIDERS)
    assert len(rows) == charts.MOST_SLIDERS
    labels = [label.get_text() for label in figure.axes[0].get_yticklabels()]
    assert labels == [NAMES[j] for j in rows]
    for panel, each in zip(figure.axes, SERIES, strict=True):
        assert panel.get_title(loc="left") == each.title
        shown = [float(text.get_text().replace("−", "-").replace(",", "")) for text in panel.texts]
        np.testing.assert_allclose(shown, each.weights[rows], atol=0.5)
        bars = [patch.get_width() for patch in panel.patches[len(rows) :]]
        np.testing.assert_allclose(bars, np.clip(each.weights[rows], -1.1, 2.1), atol=0.02)
    hidden = np.abs(np.delete(SERIES[1].weights, rows)).max()
    assert figure.axes[1].get_xlabel() == f"and 32 more, up to ±{hidden:.2f}"
    assert figure.axes[0].get_xlabel() == "and 32 more, all at 0"


def test_a_strong_set_does_not_push_out_a_weak_one() -> None:
    weak, strong = np.zeros(60), some(3, 1000.0)
    weak[[5, 9]] = 0.2, 0.1
    assert {5, 9} <= set(charts.strongest([weak, strong], 6).tolist())
    assert charts.strongest([np.zeros(60)], 6).tolist() == []


def test_weights_are_the_heights_of_bars() -> None:
    figure = charts.weight_bars(NAMES, LIMITS, SERIES)
    for axes, each in zip(figure.axes, SERIES, strict=True):
        bars = [patch.get_height() for patch in axes.patches if patch.get_width() < 1]
        np.testing.assert_allclose(bars, each.weights)
    assert figure.axes[0].get_yscale() == "symlog", "weights of hundreds do not fit an even scale"
    assert charts.weight_bars(NAMES, LIMITS, SERIES[:2]).axes[0].get_yscale() == "linear"


def test_errors_are_the_distances_to_the_reference() -> None:
    reference = SERIES[0].weights
    figure = charts.error_charts(NAMES, reference, SERIES[1:])
    for axes in figure.axes:
        for line, each in zip(axes.lines, SERIES[1:], strict=True):
            np.testing.assert_allclose(line.get_ydata(), np.abs(each.weights - reference))
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["One   $E_{RMS}$ 0.3", "Two   "]


@pytest.mark.parametrize("shapes", [0, 1, 153])
def test_any_number_of_shapes_makes_charts(shapes: int, tmp_path: Path) -> None:
    names, limits = [f"s{j}" for j in range(shapes)], np.tile([0.0, 1.0], (shapes, 1))
    series = [Series("One", INKS["sparse"], np.linspace(0, 1, shapes))]
    for name, figure in {
        "sliders": charts.slider_panels(names, limits, series, "a note"),
        "weights": charts.weight_bars(names, limits, series, "a note"),
        "errors": charts.error_charts(names, np.zeros(shapes), series, "a note"),
    }.items():
        for path in chart_style.write_chart(tmp_path, name, figure):
            assert path.stat().st_size > 1000


def test_files_are_pictures_and_the_same_each_time(tmp_path: Path) -> None:
    first = chart_style.write_chart(tmp_path, "first", charts.slider_panels(NAMES, LIMITS, SERIES))
    second = chart_style.write_chart(tmp_path, "second", charts.slider_panels(NAMES, LIMITS, SERIES))
    assert [path.suffix for path in first] == [".png", ".svg"]
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
    with Image.open(first[0]) as picture:
        inches = 1.45 + 3 * (1.25 + 0.65)
        assert picture.width == pytest.approx(inches * chart_style.DPI, abs=2)
    assert ElementTree.parse(first[1]).getroot().tag.endswith("svg")


@pytest.mark.parametrize(
    ("value", "text"), [(0, "0"), (0.18734, "0.187"), (2.8387, "2.84"), (987.4, "987"), (4312.0, "4,312")]
)
def test_numbers_have_three_digits_that_matter(value: float, text: str) -> None:
    assert chart_style.number(value) == text


def test_names_are_text_whatever_formula_they_look_like(tmp_path: Path) -> None:
    names = ["$\\frac{a$", "a$b", "$x^2$", "<b>&amp;</b>", "_{^", "\\$5"]
    limits, weights = np.tile([0.0, 1.0], (6, 1)), np.linspace(0.1, 1, 6)
    series = [Series("one", INKS["sparse"], weights, "$E_{RMS}$ 0.1")]
    note = "$ $ {: 3"
    for figure in (
        charts.slider_panels(names, limits, series, note),
        charts.weight_bars(names, limits, series, note),
        charts.error_charts(names, 0.5 * weights, series, note),
    ):
        chart_style.write_chart(tmp_path, "chart", figure)
        labels = [
            label for axes in figure.axes for label in (*axes.get_xticklabels(), *axes.get_yticklabels())
        ]
        assert not any(label.get_parse_math() for label in labels)


def test_names_are_text_whatever_signs_and_letters_they_have(tmp_path: Path) -> None:
    names = ["$a", "b$", "$\\frac$", "a_{b}", "まばたき", "Улыбка", "ยิ้ม", "50%"]
    limits = np.tile([0.0, 1.0], (len(names), 1))
    weights = np.linspace(0.1, 1, len(names))
    series = [Series("Solver", INKS["sparse"], weights, "$E_{RMS}$ 0.1")]
    for name, chart in {
        "sliders": charts.slider_panels(names, limits, series, "$rig$ 名前: 8 shapes"),
        "weights": charts.weight_bars(names, limits, series, "$rig$"),
        "errors": charts.error_charts(names, weights * 0, series, "$rig$"),
    }.items():
        png, _ = chart_style.write_chart(tmp_path, name, chart)
        assert png.stat().st_size > 1000
