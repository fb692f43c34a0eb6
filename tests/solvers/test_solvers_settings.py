"""Settings as text and as plain values."""

import json

import pytest

from facepin.solvers import SOLVERS
from facepin.solvers.interface import SolverKind
from facepin.solvers.settings import make_settings, parse_settings, plain_settings


@pytest.mark.parametrize("kind", SOLVERS.values(), ids=SOLVERS)
def test_defaults_survive_json(kind: SolverKind) -> None:
    default = kind.settings()
    plain = json.loads(json.dumps(plain_settings(default)))
    assert make_settings(kind, plain) == default
    assert make_settings(kind, {}) == default


def test_text_and_plain_values_mean_the_same() -> None:
    text = make_settings(SOLVERS["transpose"], {"step": "unit", "iterations": "20"})
    assert text == make_settings(SOLVERS["transpose"], {"step": "unit", "iterations": 20})
    assert isinstance(text.iterations, int)
    for word in ("on", "true", "Yes", "1", True):
        assert make_settings(SOLVERS["tikhonov"], {"relative": word}).relative is True
    for word in ("off", "false", "NO", "0", False):
        assert make_settings(SOLVERS["tikhonov"], {"relative": word}).relative is False
    assert make_settings(SOLVERS["tikhonov"], {"alpha": "1e-4"}).alpha == 1e-4
    assert isinstance(make_settings(SOLVERS["tikhonov"], {"alpha": 1}).alpha, float)


def test_a_gamma_by_hand_turns_the_automatic_one_off() -> None:
    given = make_settings(SOLVERS["hybrid"], {"gamma": "0.3"})
    assert (given.gamma, given.automatic) == (0.3, False)
    both = make_settings(SOLVERS["hybrid"], {"gamma": 0.3, "automatic": True})
    assert (both.gamma, both.automatic) == (0.3, True)


@pytest.mark.parametrize(
    ("key", "values", "message"),
    [
        ("tikhonov", {"alpah": "1"}, "tikhonov has no setting 'alpah' (there are: alpha, relative)"),
        ("pseudo_inverse", {"alpha": "1"}, "pseudo_inverse has no setting 'alpha' (there are: none)"),
        ("tikhonov", {"alpha": "much"}, "tikhonov: alpha=much is not a number"),
        ("tikhonov", {"alpha": "nan"}, "tikhonov: alpha=nan is not a number"),
        ("tikhonov", {"alpha": "inf"}, "tikhonov: alpha=inf is not a number"),
        ("tikhonov", {"alpha": True}, "tikhonov: alpha=True is not a number"),
        ("tikhonov", {"alpha": None}, "tikhonov: alpha=None is not a number"),
        ("tikhonov", {"alpha": "-1"}, "tikhonov: alpha=-1 is out of range (0 to 1000)"),
        ("tikhonov", {"relative": "maybe"}, "tikhonov: relative=maybe is neither on nor off"),
        ("transpose", {"iterations": "0"}, "transpose: iterations=0 is out of range (1 to 200)"),
        ("transpose", {"iterations": "2.5"}, "transpose: iterations=2.5 is not a whole number"),
        ("transpose", {"step": "long"}, "transpose: step=long is not one of: exact, spectral, unit"),
        ("transpose", {"step": ["exact"]}, "transpose: step=['exact'] is not one of: exact, spectral, unit"),
        ("hybrid", {"gamma": "1.5"}, "hybrid: gamma=1.5 is out of range (0 to 1)"),
    ],
)
def test_refusals_say_what_is_allowed(key: str, values: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError) as caught:
        make_settings(SOLVERS[key], values)
    assert str(caught.value) == message


def test_an_assignment_goes_to_every_solver_that_has_it() -> None:
    kinds = [SOLVERS[key] for key in ("pseudo_inverse", "tikhonov", "transpose", "hybrid", "bounded")]
    made = parse_settings(kinds, ["step=unit", "alpha=0.5", " bounded.alpha = 0.25 "])
    assert list(made) == [kind.key for kind in kinds]
    assert made["pseudo_inverse"] == SOLVERS["pseudo_inverse"].settings()
    assert made["transpose"].step == made["hybrid"].step == "unit"
    assert made["tikhonov"].alpha == 0.5
    assert made["bounded"].alpha == 0.25


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("alpha", "cannot read the setting 'alpha' (write name=value or solver.name=value)"),
        ("=1", "cannot read the setting '=1' (write name=value or solver.name=value)"),
        ("alpha=", "cannot read the setting 'alpha=' (write name=value or solver.name=value)"),
        ("beta=1", "no setting 'beta' (there are: pseudo_inverse: none; tikhonov: alpha, relative)"),
        ("sparse.price=1", "no solver 'sparse' to give 'price' to (there are: pseudo_inverse, tikhonov)"),
        ("tikhonov.beta=1", "tikhonov has no setting 'beta' (there are: alpha, relative)"),
        ("alpha=a=b", "tikhonov: alpha=a=b is not a number"),
    ],
)
def test_assignments_are_refused_in_one_line(text: str, message: str) -> None:
    with pytest.raises(ValueError) as caught:
        parse_settings([SOLVERS["pseudo_inverse"], SOLVERS["tikhonov"]], [text])
    assert str(caught.value) == message
