"""The one table of commands: it makes the bindings, the footer, the palette and the help page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage.station.state import Activity

from birdcage_tui.view import View

Reason = Callable[[View], str | None]
"""Why a command cannot be given now, as a sentence; None when it can."""


def _always(_: View) -> str | None:
    return None


def can_move(view: View) -> str | None:
    """Return why the dish cannot be moved now; the station checks again, and its word counts."""
    state = view.state
    if state.fault is not None:
        return "A fault waits: Enter acknowledges it."
    if not view.link_up:
        return "The dish does not answer."
    if state.held is not None:
        return "STOP is latched: Enter releases it."
    if state.motion_refused_because:
        return state.motion_refused_because
    if state.homed is False or state.position is None:
        return "The dish does not know where it points: home it first."
    return None


def can_home(view: View) -> str | None:
    """Return why the dish cannot be homed now."""
    state = view.state
    if not view.link_up:
        return "The dish does not answer."
    if state.held is not None:
        return "STOP is latched: Enter releases it."
    if state.dish is not None and state.dish.homing_s is None:
        return f"The {state.dish.name} homes only by itself."
    return "It is homing already." if state.activity is Activity.HOMING else None


def can_release(view: View) -> str | None:
    """Return why there is nothing to release, acknowledge or accept."""
    state = view.state
    if state.fault is None and state.held is None and not state.motion_refused_because:
        return "Nothing is held, and there is no fault."
    return None


@dataclass(frozen=True, slots=True)
class Command:
    """One thing a person can do. `keys` are Textual's names; `shown` is how the key is written."""

    name: str
    keys: tuple[str, ...]
    shown: str
    title: str
    help: str
    group: str
    refused: Reason = _always
    footer: str = ""
    """The word in the footer; not there when empty."""
    priority: bool = False


PAGES = (
    ("dashboard", "Dashboard", "What it does, what stops it, what comes next."),
    ("control", "Control", "Move it by hand, to presets, or along a pass."),
    ("signal", "Signal", "Signal strength, sweeps and the sky map."),
    ("system", "System", "Hardware, motors, NVS, receiver and health."),
    ("console", "Console", "Every byte on the wire, and the dish's own prompt."),
    ("camera", "Camera", "Pictures by the clock, or at events of a pass."),
    ("passes", "Passes", "What will be in reach, and when."),
    ("setup", "Setup", "From wires to the first satellite."),
    ("motor", "Motor", "A DiSEqC positioner: one axis along the arc."),
    ("survey", "Survey", "What the dish says about itself, command by command."),
)

COMMANDS: tuple[Command, ...] = (
    Command(
        "stop",
        (),
        "Space",
        "STOP",
        "Stop everything now and hold. Ctrl+C does it in text fields too.",
        "Safety",
        footer="STOP",
    ),
    Command(
        "release",
        ("enter",),
        "Enter",
        "Release or acknowledge",
        "Acknowledge a fault, let go of HELD, or accept the dish's own limits. Nothing moves by it.",
        "Safety",
        can_release,
    ),
    Command(
        "goto",
        ("g",),
        "g",
        "Go to …",
        "Type azimuth and elevation; Enter sends the dish there.",
        "Motion",
        can_move,
        "go to",
    ),
    Command(
        "left", ("left",), "←", "Step counterclockwise", "One degree of azimuth, counterclockwise.", "Motion", can_move
    ),
    Command("right", ("right",), "→", "Step clockwise", "One degree of azimuth, clockwise.", "Motion", can_move),
    Command("up", ("up",), "↑", "Step up", "One degree of elevation, up.", "Motion", can_move),
    Command("down", ("down",), "↓", "Step down", "One degree of elevation, down.", "Motion", can_move),
    Command(
        "home",
        ("H",),
        "H",
        "Home the dish …",
        "Find the references by running into the stops. Asks first.",
        "Motion",
        can_home,
        "home",
    ),
    Command("help", ("question_mark",), "?", "Help", "All keys, and what each one does.", "App", footer="help"),
    Command(
        "palette", ("colon", "ctrl+p"), ":", "All commands", "Find a command by its name.", "App", footer="commands"
    ),
    Command("theme", ("T",), "T", "Next theme", "dusk, daylight, night.", "App"),
    Command(
        "quit",
        ("ctrl+q",),
        "Ctrl+Q",
        "Quit",
        "Stop the dish if it moves, close the port, leave.",
        "App",
        footer="quit",
        priority=True,
    ),
    *(
        Command(
            f"page-{name}", (f"f{number}", str(number % 10)), str(number % 10), title, text, "Pages", priority=False
        )
        for number, (name, title, text) in enumerate(PAGES, 1)
    ),
)
BY_NAME = {command.name: command for command in COMMANDS}
