"""A field that a number is typed into."""

from imgui_bundle import imgui

from facepin.core.errors import FacepinError
from facepin.core.typed_number import typed_number
from facepin.panels.requests import Refused


def number_field(label: str, value: float, digits: int) -> float | Refused | None:
    """Draw a field that shows a number; return another one when that was typed, or what is wrong with it.

    What is not edited is not rounded to what is shown either.

    Parameters
    ----------
    label : str
        Of the item.
    value : float
        The number now.
    digits : int
        How many of its digits are shown.
    """
    shown = f"{value:.{digits}g}"
    text = imgui.input_text(label, shown, imgui.InputTextFlags_.auto_select_all)[1]
    if not imgui.is_item_deactivated_after_edit() or text == shown:
        return None
    try:
        return typed_number(text)
    except FacepinError as error:
        return Refused(str(error))
