"""The menu bar says what can be done now."""

from pathlib import Path

import pytest
from imgui_bundle import imgui

from facepin.core.events import PointerMoved
from facepin.panels.availability import WITHOUT_FACE
from facepin.panels.commands import Command, keys_of
from support.driver import App, running

COMMANDS = {command.title: command for command in Command}


def items(app: App, monkeypatch: pytest.MonkeyPatch) -> dict[str, tuple[bool, bool]]:
    """Draw a frame with all menus open: (enabled, ticked) of each item."""
    found: dict[str, tuple[bool, bool]] = {}

    def item(title: str, key: str | None = None, *, selected: bool = False, enabled: bool = True) -> bool:
        command = COMMANDS.get(title.split(":")[0])
        if command is not None:
            assert key in (*keys_of(command, "facepin"), None)
        found[title.split("###")[0]] = enabled, selected
        return False

    with monkeypatch.context() as patched:
        patched.setattr(imgui, "begin_menu", lambda *_: True)
        patched.setattr(imgui, "end_menu", lambda: None)
        patched.setattr(imgui, "menu_item_simple", item)
        app.step(PointerMoved(5, 5))
    return found


def test_without_a_face_only_what_needs_none_can_be_chosen(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    with running(tmp_path / "none.glb", wait=False) as app:
        app.until(lambda: app.desk.loading is None)
        found = items(app, monkeypatch)
        assert app.desk.stage is None
        there = {COMMANDS[title]: enabled for title, (enabled, _) in found.items() if title in COMMANDS}
        assert len(there) > 20
        for command, enabled in there.items():
            assert enabled == (command in WITHOUT_FACE - {Command.UNSAVED_WORK}), command


def test_what_is_on_is_ticked_and_undo_says_what_it_takes_back(monkeypatch: pytest.MonkeyPatch) -> None:
    with running() as app:
        for command in (Command.HISTORY, Command.CHART, Command.SYMMETRY, Command.REFERENCE_FROM_POSE):
            assert items(app, monkeypatch)[command.title][1] is False
            app.ask(command)
        found = items(app, monkeypatch)
        for command in (Command.HISTORY, Command.CHART, Command.SYMMETRY):
            assert found[command.title] == (True, True)
        assert found["Undo: Set the reference"] == (True, False)
        assert found["Redo"] == (False, False)
        assert found[Command.FORGET_REFERENCE.title] == (True, False)
