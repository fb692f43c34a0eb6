"""The one table of everything that needs no further word, and of the keys that ask for it."""

from enum import Enum
from typing import Literal

from facepin.core.events import KeyPressed
from facepin.core.look.camera import View
from facepin.core.turn import QUARTERS, Turn
from facepin.session.navigation import Habit

Topic = Literal["File", "Edit", "Pins", "Poses", "View", "Compare", "Help"]
"""What commands are listed under, in this order."""


class Command(Enum):
    """Everything that needs no further word: (title, shortcuts, topic, a sentence of help).

    Menus, keys, the command palette, the keyboard map and their tooltips share this one table.
    """

    OPEN_FILE = "Open file…", ("Ctrl+O",), "File", "Opens a scene or a face: .glb, .gltf, .vrm, .npz or .obj."
    OPEN_FOLDER = (
        "Open folder of OBJ files…",
        ("Ctrl+Shift+O",),
        "File",
        "Opens a face whose neutral and shapes are one OBJ file each.",
    )
    LOAD_POSE = (
        "Load pose…",
        ("Ctrl+L",),
        "File",
        "Puts a saved pose on this face; shapes are matched by name, so it may come from another rig.",
    )
    SAVE = (
        "Save",
        ("Ctrl+S",),
        "File",
        "Writes the scene: pins, weights, panes, cameras, and which rig they are for.",
    )
    SAVE_AS = "Save as…", ("Ctrl+Shift+S",), "File", "Writes the scene under another name."
    LOCATE_RIG = (
        "Show where the rig is…",
        (),
        "File",
        "For a scene whose rig is not where it was when the scene was saved.",
    )
    UNSAVED_WORK = (
        "Unsaved work…",
        (),
        "File",
        "Lists what was not saved when Facepin was left; it can be taken up again.",
    )
    SAVE_POSE = "Save pose…", (), "File", "Writes weights and pins alone as .json or .csv, for other rigs."
    EXPORT = (
        "Export model…",
        ("Ctrl+E",),
        "File",
        "Writes the rig with its pose as .glb, or the posed mesh as .obj, .ply or .stl.",
    )
    SCREENSHOT = "Save picture", ("F12",), "File", "Saves the face of the selected pane as a PNG."
    SCREENSHOT_PINS = (
        "Save picture with pins",
        ("Shift+F12",),
        "File",
        "Saves what the selected pane shows, with its pins and their goals.",
    )
    QUIT = "Quit", ("Ctrl+Q",), "File", "Leaves; what was not saved is kept and offered at the next start."
    UNDO = "Undo", ("Ctrl+Z",), "Edit", "Takes the last change back; a whole drag is one step."
    REDO = "Redo", ("Ctrl+Shift+Z", "Ctrl+Y"), "Edit", "Brings back what was undone."
    COPY_POSE = (
        "Copy the pose",
        ("Ctrl+C",),
        "Edit",
        "Puts all weights on the clipboard, as the text of a pose file.",
    )
    PASTE_POSE = (
        "Paste the pose",
        ("Ctrl+V",),
        "Edit",
        "Sets what was copied here or in another window; shapes are matched by name. Pins stay.",
    )
    HISTORY = (
        "History",
        ("Ctrl+Alt+Z",),
        "Edit",
        "Lists every step by its name; a click goes there, back or forth.",
    )
    RESET_POSE = "Reset the pose", ("Home",), "Edit", "All weights to zero; pins stay on their points."
    TIDY = (
        "Tidy the pose…",
        ("T",),
        "Edit",
        "Shows the fewest shapes that keep every pin, or without pins the face, as it is; then you decide.",
    )
    SYMMETRY = (
        "Symmetry",
        ("M",),
        "Edit",
        "A pin makes a twin across the face and drags it along; sliders of left and right move together.",
    )
    FLIP_POSE = "Flip the pose", ("Ctrl+M",), "Edit", "Left does what right did, and right what left did."
    MIRROR_LEFT = (
        "Mirror left to right",
        ("Shift+M",),
        "Edit",
        "The character's right side does what its left does.",
    )
    MIRROR_RIGHT = (
        "Mirror right to left",
        (),
        "Edit",
        "The character's left side does what its right does.",
    )
    SELECT_PINS = "Select all pins", ("Ctrl+A",), "Pins", "Selected pins move together."
    DELETE_PINS = "Remove selected pins", ("Delete", "Backspace"), "Pins", "The pose stays as it is."
    CLEAR_PINS = "Remove all pins", (), "Pins", "All but locked ones; the pose stays as it is."
    LOCK_PINS = (
        "Lock or unlock selected pins",
        ("L",),
        "Pins",
        "A locked pin holds its point, but is neither dragged nor removed.",
    )
    HIDE_PINS = "Hide selected pins", ("Ctrl+H",), "Pins", "A hidden pin goes on holding its point."
    SHOW_PINS = "Show hidden pins", ("Alt+H",), "Pins", "Brings all hidden pins back into the picture."
    SKETCH_PINS = (
        "Sketch strokes of pins",
        ("B",),
        "Pins",
        "A line drawn on the skin becomes a row of pins that move together.",
    )
    SAVE_LANDMARKS = "Save landmarks…", (), "Pins", "Writes the names of pins and where they are on this rig."
    LOAD_LANDMARKS = "Load landmarks…", (), "Pins", "Places a pin on every landmark of a file."
    SAVE_TO_LIBRARY = (
        "Save the pose to the library",
        ("Ctrl+B",),
        "Poses",
        "Keeps the pose beside the rig, with a picture: a click puts it back on the face.",
    )
    TAKE_POSES = (
        "Add the poses of another rig…",
        (),
        "Poses",
        "Copies a folder of poses into the library; shapes are matched by name.",
    )
    CONTACT_SHEET = (
        "Save a contact sheet",
        (),
        "Poses",
        "One image with all poses of the library and their names.",
    )
    POSE_PICTURES = (
        "Save a picture of every pose",
        (),
        "Poses",
        "A folder with one PNG for each pose of the library.",
    )
    TURNTABLE = (
        "Save a turntable",
        (),
        "Poses",
        "The face seen from all around, as pictures and as an animation.",
    )
    FILMSTRIP = "Filmstrip of this work", ("F5",), "Poses", "The steps that led to this pose, as pictures."
    SAVE_FILMSTRIP = "Save the filmstrip", (), "Poses", "The steps that led to this pose, as one image."
    FRAME = (
        "Frame the face",
        ("F",),
        "View",
        "Brings the part of the face that shapes move into the picture, or the selected pins.",
    )
    FRONT = "Front", ("1", "Numpad 1"), "View", "Looks at the face from the front."
    LEFT = "Character's left", ("3", "Numpad 3"), "View", "Looks at the side that is left to the character."
    RIGHT = (
        "Character's right",
        ("Ctrl+3", "Ctrl+Numpad 3"),
        "View",
        "Looks at the side that is right to the character.",
    )
    THREE_QUARTER = (
        "Three-quarter",
        ("7", "Numpad 7"),
        "View",
        "Looks half from the side, half from the front.",
    )
    BACK = "Back", ("Ctrl+1", "Ctrl+Numpad 1"), "View", "Looks at the back of the head."
    ORTHOGRAPHIC = (
        "Orthographic",
        ("5", "Numpad 5"),
        "View",
        "Draws parallel lines parallel, without perspective; once more brings it back.",
    )
    FACE_FORWARD = (
        "Turn the face forward",
        (),
        "View",
        "A quarter turn about the axis through the ears, for a face that lies on its back in its file.",
    )
    FACE_ROUND = (
        "Turn the face round",
        (),
        "View",
        "A quarter turn about the upright axis, for a face that looks elsewhere in its file.",
    )
    FACE_SIDEWAYS = (
        "Turn the face sideways",
        (),
        "View",
        "A quarter turn about the axis that it looks along, for a face that lies on its side in its file.",
    )
    TURN_LEFT = "Turn to the left", ("Numpad 4",), "View", "Steps round the face, to the left of the picture."
    TURN_RIGHT = (
        "Turn to the right",
        ("Numpad 6",),
        "View",
        "Steps round the face, to the right of the picture.",
    )
    TURN_UP = "Turn up", ("Numpad 8",), "View", "Looks from a step higher."
    TURN_DOWN = "Turn down", ("Numpad 2",), "View", "Looks from a step lower."
    SHADING = (
        "Next shading",
        ("S",),
        "View",
        "Goes on from studio to clay, wireframe over clay, normals, heat map.",
    )
    HEAT = (
        "Heat map of the move",
        ("H",),
        "View",
        "Colours the skin by how far it moved since the drag began: unwanted motion shows at once.",
    )
    WIREFRAME = "Wireframe", ("W",), "View", "Draws the edges of the mesh over the face."
    GHOST = (
        "Ghost: none, neutral, reference",
        ("G",),
        "View",
        "Lets the neutral or the reference pose shine through.",
    )
    GAZE = (
        "Gaze handle",
        ("E",),
        "View",
        "Shows an eye before the face: drag it, both eyes look there; a double click lets them look ahead.",
    )
    RESET_LAYOUT = "Reset the panel layout", (), "View", "Puts all panels back to where they stood first."
    REFERENCE_FROM_POSE = (
        "Take this pose as the reference",
        (),
        "Compare",
        "Errors are then measured against the pose as it is now.",
    )
    REFERENCE_FROM_FILE = (
        "Reference from a file…",
        (),
        "Compare",
        "Errors are then measured against a saved pose.",
    )
    CHART = (
        "Chart of weights and errors",
        ("F4",),
        "Compare",
        "Weights of all panes as bars, and their errors against the reference.",
    )
    SAVE_CHART = "Save the chart", (), "Compare", "As PNG, SVG and CSV, beside the pictures."
    SHOW_REFERENCE = (
        "Show the reference",
        (),
        "Compare",
        "In a pane of its own, with its weights as bars beside the others'.",
    )
    FORGET_REFERENCE = "Forget the reference", (), "Compare", "Nothing is measured against it any more."
    PALETTE = (
        "Find an action…",
        ("Ctrl+P", "Ctrl+Shift+P"),
        "Help",
        "Lists everything Facepin can do: type some letters of it, press Enter.",
    )
    KEYBOARD = "Keyboard and mouse", ("?", "F1"), "Help", "Shows every key and every gesture of the mouse."
    GUIDE = (
        "Show the first steps again",
        (),
        "Help",
        "Leads through the first drag, at the bottom of the picture.",
    )
    ABOUT = "About Facepin", (), "Help", "Version, licences, and the graphics driver for a bug report."

    def __init__(self, title: str, shortcuts: tuple[str, ...], topic: Topic, help: str) -> None:
        self.title = title
        """What a menu calls it."""
        self.shortcuts = shortcuts
        """Keys that ask for it, unless the user's habit has others: see `keys_of`."""
        self.topic = topic
        self.help = help
        """One sentence that teaches what it does."""


PICTURES = (Command.SCREENSHOT, Command.SCREENSHOT_PINS)
"""Those that change nothing."""

VIEW_COMMANDS: dict[Command, View] = {
    Command.FRONT: "front",
    Command.LEFT: "left",
    Command.RIGHT: "right",
    Command.THREE_QUARTER: "three-quarter",
    Command.BACK: "back",
}

FACE_TURNS: dict[Command, Turn] = {
    Command.FACE_FORWARD: QUARTERS["x"],
    Command.FACE_ROUND: QUARTERS["y"],
    Command.FACE_SIDEWAYS: QUARTERS["z"],
}
"""How each turns the face."""

HABIT_KEYS: dict[Habit, dict[Command, tuple[str, ...]]] = {
    "facepin": {},
    "maya": {
        Command.UNDO: ("Ctrl+Z", "Z"),
        Command.REDO: ("Ctrl+Y", "Shift+Z", "Ctrl+Shift+Z"),
        Command.FRAME: ("F", "A"),
        Command.WIREFRAME: ("4",),
    },
    "blender": {
        Command.RESET_POSE: ("Alt+G",),
        Command.DELETE_PINS: ("X", "Delete", "Backspace"),
        Command.FRAME: ("Home", "Numpad .", "F"),
        Command.THREE_QUARTER: ("7", "Numpad 0"),
        Command.WIREFRAME: ("Shift+Z", "W"),
        Command.PALETTE: ("F3", "Ctrl+P", "Ctrl+Shift+P"),
    },
}
"""Keys that are others than in the table of commands, where a habit has them."""


def keys_of(command: Command, habit: Habit) -> tuple[str, ...]:
    """Return the keys that ask for a command; the first one stands in the menus."""
    return HABIT_KEYS[habit].get(command, command.shortcuts)


def key_of(command: Command, habit: Habit) -> str:
    """Return the key that a menu shows for a command; empty when it has none."""
    return next(iter(keys_of(command, habit)), "")


def command_for(event: KeyPressed, habit: Habit) -> Command | None:
    """Return the command a key asks for, or None."""
    keys = (
        ["ctrl"] * event.modifiers.control + ["shift"] * event.modifiers.shift + ["alt"] * event.modifiers.alt
    )
    pressed = "+".join([*keys, event.key])
    for command in Command:
        if any(shortcut.lower() == pressed for shortcut in keys_of(command, habit)):
            return command
    return None
