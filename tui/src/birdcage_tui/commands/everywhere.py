"""Commands that hold on every page, and the pages themselves."""

from __future__ import annotations

from birdcage.station.known import SearchSwitch
from birdcage.station.state import Search

from birdcage_tui.commands.table import Command, can_home, can_release
from birdcage_tui.view import View


def can_end_search(view: View) -> str | None:
    """Return why the TV search cannot be ended here and now."""
    dish, search = view.state.dish, view.state.search
    if not view.link_up or dish is None:
        return "The dish does not answer."
    if dish.search_switch is not SearchSwitch.UNTIL_POWER_UP:
        return "This dish's TV search is switched off by a setting: Setup (8), step 3."
    if search is Search.OFF_UNTIL_POWER_UP:
        return "It is ended already. It begins again at the next power-up."
    return None


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

SAFETY = (
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
)

MOTION = (
    Command(
        "goto",
        ("g",),
        "g",
        "Go to …",
        "Type where to: 180 45, moon, 28.2E, a satellite; Enter sends the dish there.",
        "Motion",
        footer="go to",
    ),
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
)

SEARCH = (
    Command(
        "search", ("K",), "K", "End the TV search …",
        "End the firmware's own search, which moves the dish by itself. Asks first.", "Motion", can_end_search,
    ),
)  # fmt: skip

APP = (
    Command(
        "help",
        ("question_mark",),
        "?",
        "Help",
        "What can be done here, key by key; Enter or a click does it.",
        "App",
        footer="help",
    ),
    Command("palette", ("colon", "ctrl+p"), ":", "All commands", "Find a command by its name.", "App", footer="all"),
    Command(
        "jump",
        ("semicolon", "ctrl+o"),
        ";",
        "Jump to a control",
        "Puts a letter on everything that can be reached; that letter goes there.",
        "App",
        footer="jump",
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
)

PAGE_COMMANDS = tuple(
    Command(f"page-{name}", (f"f{number}", str(number % 10)), str(number % 10), title, text, "Pages")
    for number, (name, title, text) in enumerate(PAGES, 1)
)
