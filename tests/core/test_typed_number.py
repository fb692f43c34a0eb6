"""What is typed means what it says, or is refused."""

import pytest

from facepin.core.errors import FacepinError
from facepin.core.typed_number import typed_number


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.123456789", 0.123456789),
        (" 0,5 ", 0.5),
        (",5", 0.5),
        ("5.", 5.0),
        ("50%", 0.5),
        ("12,5 %", 0.125),
        ("1/2", 0.5),
        ("-1 / 4", -0.25),
        ("\N{MINUS SIGN}0.25", -0.25),
        ("+1e-3", 0.001),
    ],
)
def test_a_number_in_any_usual_spelling_is_understood(text: str, value: float) -> None:
    assert typed_number(text) == value


@pytest.mark.parametrize(
    "text", ["", "abc", "1/0", "1//2", "0.5x", "1,000.5", "1.000,5", "nan", "inf", "1e999", "%", "5 0 %%"]
)
def test_anything_else_is_refused_in_one_line_that_says_what_was_typed(text: str) -> None:
    with pytest.raises(FacepinError) as refused:
        typed_number(text)
    assert repr(text.strip()) in str(refused.value)
    assert "\n" not in str(refused.value)
