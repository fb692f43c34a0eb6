"""The one table of commands, that menus, keys, palette and keyboard map are made of."""

from collections import Counter

import pytest

from facepin.core.events import KeyPressed, Modifiers
from facepin.panels.commands import HABIT_KEYS, Command, command_for, key_of, keys_of
from facepin.session.navigation import PRESETS


def test_every_command_has_a_topic_and_a_sentence_that_teaches() -> None:
    bare = [command.name for command in Command if not command.help.endswith(".") or command.topic == "More"]
    assert not bare, "give these a topic and a sentence of help"
    titles = Counter(command.title for command in Command)
    assert titles.most_common(1)[0][1] == 1


@pytest.mark.parametrize("habit", PRESETS)
def test_no_key_asks_for_two_things(habit: str) -> None:
    keys = Counter(key.lower() for command in Command for key in keys_of(command, habit))
    assert [key for key, times in keys.items() if times > 1] == []


@pytest.mark.parametrize("habit", PRESETS)
def test_what_has_a_key_keeps_one(habit: str) -> None:
    for command in Command:
        assert bool(keys_of(command, habit)) >= bool(command.shortcuts)
    assert set(HABIT_KEYS) == set(PRESETS)


@pytest.mark.parametrize(
    ("habit", "key", "modifiers", "command"),
    [
        ("facepin", "home", Modifiers(), Command.RESET_POSE),
        ("blender", "home", Modifiers(), Command.FRAME),
        ("blender", "numpad .", Modifiers(), Command.FRAME),
        ("blender", "numpad 1", Modifiers(), Command.FRONT),
        ("blender", "numpad 3", Modifiers(control=True), Command.RIGHT),
        ("blender", "x", Modifiers(), Command.DELETE_PINS),
        ("blender", "f3", Modifiers(), Command.PALETTE),
        ("maya", "a", Modifiers(), Command.FRAME),
        ("maya", "z", Modifiers(), Command.UNDO),
        ("maya", "z", Modifiers(shift=True), Command.REDO),
        ("maya", "w", Modifiers(), None),
        ("facepin", "p", Modifiers(control=True, shift=True), Command.PALETTE),
        ("facepin", "?", Modifiers(), Command.KEYBOARD),
        ("facepin", "q", Modifiers(), None),
    ],
)
def test_keys_ask_for_what_the_hand_means(
    habit: str, key: str, modifiers: Modifiers, command: Command | None
) -> None:
    assert command_for(KeyPressed(key, modifiers), habit) is command


def test_the_first_key_stands_in_the_menu() -> None:
    assert key_of(Command.REDO, "facepin") == "Ctrl+Shift+Z"
    assert key_of(Command.REDO, "maya") == "Ctrl+Y"
    assert key_of(Command.CLEAR_PINS, "facepin") == ""
