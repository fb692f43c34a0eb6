"""What happens between two frames, told a frame's worth at a time."""

from imgui_bundle import imgui

from facepin.core.events import Event, KeyPressed, PointerMoved, PointerPressed, PointerReleased, Scrolled
from facepin.panels import layout
from facepin.window.incoming import Incoming
from support.driver import App, running


def told(*events: Event) -> list[list[Event]]:
    """The events frame by frame, of which imgui must hear the same ones."""
    incoming, frames, heard = Incoming(), [], []
    for event in events:
        incoming.add(event, lambda event=event: heard.append(event))
    while incoming:
        frames.append(incoming.take())
        assert heard == [event for frame in frames for event in frame]
    return frames


def test_a_button_has_a_frame_of_its_own_after_a_move_and_keys_keep_their_place() -> None:
    near, far = PointerMoved(1, 1), PointerMoved(90, 90)
    press, release, key = PointerPressed(90, 90), PointerReleased(90, 90), KeyPressed("z")
    assert told(near, far, press, release) == [[near, far], [press], [release]]
    assert told(press, far, near, release, key) == [[press], [far, near], [release, key]]
    assert told(key, press, release, press) == [[key, press], [release], [press]]
    assert told(near, Scrolled(1, 1, 1), far, key) == [[near, Scrolled(1, 1, 1), far, key]]


def clicked(app: App, x: float, y: float) -> None:
    """A tap of a pen: move, press and release come at once."""
    app.step(PointerMoved(x, y), PointerPressed(x, y), PointerReleased(x, y), frames=4)


def test_a_tap_without_a_hover_before_it_reaches_tabs_sliders_and_menus() -> None:
    with running(size=(1280, 720)) as app:
        app.step(PointerMoved(500, 690), frames=4)
        bar = imgui.internal.find_window_by_name(layout.LIBRARY).dock_node.tab_bar
        tab = next(tab for tab in bar.tabs if tab.window.name == layout.LIBRARY)
        clicked(app, bar.bar_rect.min.x + tab.offset + tab.width / 2, bar.bar_rect.get_center().y)
        assert app.desk.library is not None
        assert app.desk.library.looked_at, "the tab Poses did not come up"

        other = next(tab for tab in bar.tabs if tab.window.name == layout.WEIGHTS)
        clicked(app, bar.bar_rect.min.x + other.offset + other.width / 2, bar.bar_rect.get_center().y)
        columns = app.desk.view.weights.columns
        assert columns is not None
        app.step(PointerMoved(500, 690), frames=4)
        begin, end = columns.slider
        clicked(app, (begin + end) / 2, columns.y(3) + columns.row / 2)
        app.until(lambda: not app.session.in_gesture)
        assert app.session.pose.weights.any(), "the slider did not hear the press"

        app.step(PointerMoved(500, 690), frames=4)
        clicked(app, 15, 8)
        assert imgui.is_popup_open("", imgui.PopupFlags_.any_popup), "the menu did not open"
