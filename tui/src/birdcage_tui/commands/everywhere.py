"""Commands that hold on every page, and the pages themselves."""

from __future__ import annotations

from birdcage.station.known import SearchSwitch
from birdcage.station.state import LinkPhase, TvSearch

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext, can_home, can_release, can_sync


def can_end_search(context: CommandContext) -> str | None:
    """Return why the TV search cannot be ended here and now."""
    state, dish = context.state, context.state.dish
    if state.link.state is not LinkPhase.UP or dish is None:
        return "The dish does not answer."
    if dish.search_switch is SearchSwitch.NEVER_SEARCHES:
        return "This dish has no TV search."
    if dish.search_switch is SearchSwitch.NOT_KNOWN:
        return "No command is known that ends this dish's TV search. Wait until it rests."
    if dish.search_switch is not SearchSwitch.UNTIL_POWER_UP:
        return "This dish's TV search is switched off by a setting: Setup (8), step 3."
    if state.search is TvSearch.OFF_UNTIL_POWER_UP:
        return "The search has ended. It starts again at the next power-up."
    return None


def can_show_other(context: CommandContext) -> str | None:
    """Return why no other dish can be shown."""
    return None if context.several else "There is one dish. `birdcage-tui --also FILE` drives a second one."


PAGES = (
    ("dashboard", "Dashboard", "Position, motion, what STOP can do, what to do next."),
    ("control", "Control", "Move the dish by hand, go to presets, track a pass."),
    ("signal", "Signal", "Signal strength, sweeps and the sky map."),
    ("system", "System", "Hardware, motors, NVS, receiver and health."),
    ("console", "Console", "Every byte on the wire, and the dish's own prompt."),
    ("camera", "Camera", "Pictures by the clock, or at events of a pass."),
    ("passes", "Passes", "Upcoming passes, and when each is in reach."),
    ("setup", "Setup", "From wires to the first satellite."),
    ("motor", "Motor", "A DiSEqC positioner: one axis along the arc."),
    ("survey", "Survey", "Find the carriers in a band and identify them."),
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
        "Acknowledge a fault, release HELD, or accept the dish's own limits. Nothing moves.",
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
        "Run into the end stops to find the position. Asks first.",
        "Motion",
        can_home,
        "home",
    ),
    Command(
        "sync", ("Y",), "Y", "Sync the rotator …",
        "Say where it points, if its zero is where it was switched on. Nothing moves.", "Motion", can_sync,
    ),
)  # fmt: skip

SEARCH = (
    Command(
        "search", ("K",), "K", "End the TV search …",
        "End the firmware's TV search, which moves the dish. Asks first.", "Motion", can_end_search,
    ),
)  # fmt: skip

APP = (
    Command(
        "help",
        ("question_mark",),
        "?",
        "Help",
        "Keys of this page. Enter or a click runs one.",
        "App",
        footer="help",
    ),
    Command("palette", ("colon", "ctrl+p"), ":", "All commands", "Find a command by its name.", "App", footer="all"),
    Command(
        "jump",
        ("semicolon", "ctrl+o"),
        ";",
        "Jump to a control",
        "Put a letter on every control. Type the letter to go there.",
        "App",
        footer="jump",
    ),
    Command(
        "elements-add",
        ("I",),
        "I",
        "Add elements …",
        "Type the path of a file with TLE or OMM, or paste its text. F7 shows its passes at once.",
        "App",
    ),
    Command(
        "place-set",
        ("L",),
        "L",
        "Set location …",
        "Type a city, a locator, or latitude and longitude. Passes are recomputed at once.",
        "App",
    ),
    Command("theme", ("T",), "T", "Next theme", "Dusk, daylight, night. Your choice is saved.", "App"),
    Command(
        "quit",
        ("ctrl+q",),
        "Ctrl+Q",
        "Quit",
        "Leave. A dish that moves is stopped first, unless another program drives it.",
        "App",
        footer="quit",
        priority=True,
    ),
)

DISHES = (
    Command(
        "other-dish",
        ("O",),
        "O",
        "Other dish",
        "Show the other dish on these pages. Nothing stops, and nothing ends.",
        "App",
        can_show_other,
        footer="other dish",
        where=("dishes",),
    ),
)
"""Where the app has several; Space stops all of them."""

PAGE_COMMANDS = tuple(
    Command(f"page-{name}", (f"f{number}", str(number % 10)), str(number % 10), title, text, "Pages")
    for number, (name, title, text) in enumerate(PAGES, 1)
)
