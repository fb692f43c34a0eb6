"""One part of a frame, which may fail without the others."""

from collections.abc import Iterator
from contextlib import contextmanager

from imgui_bundle import imgui, implot

from facepin.desk.desk import Desk
from facepin.desk.faults import Within


@contextmanager
def part(desk: Desk, where: str) -> Iterator[Within]:
    """Draw one part of a frame: what goes wrong in it is told, and imgui is left as it was found.

    Parameters
    ----------
    desk : Desk
        Tells what went wrong.
    where : str
        What the part is, for the user.
    """
    before = imgui.internal.ErrorRecoveryState()
    imgui.internal.error_recovery_store_state(before)
    with desk.faults.within(where) as within:
        try:
            yield within
        except Exception:
            _close(before)
            raise


def _close(before: imgui.internal.ErrorRecoveryState) -> None:
    """End all windows, tables, styles … that were begun since; imgui's own complaints are of no use here."""
    io = imgui.get_io()
    usual = io.config_error_recovery_enable_assert, io.config_error_recovery_enable_debug_log
    io.config_error_recovery_enable_assert = io.config_error_recovery_enable_debug_log = False
    tooltip, io.config_error_recovery_enable_tooltip = io.config_error_recovery_enable_tooltip, False
    imgui.internal.error_recovery_try_to_recover_state(before)
    io.config_error_recovery_enable_assert, io.config_error_recovery_enable_debug_log = usual
    io.config_error_recovery_enable_tooltip = tooltip
    # Charts have a context of their own, which can't be told to end what was begun.
    implot.destroy_context()
    implot.create_context()
