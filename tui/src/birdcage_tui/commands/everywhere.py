"""Commands that hold on every page, and the pages themselves."""

from __future__ import annotations

from birdcage_tui.commands.table import Command, can_home, can_release

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
        "Type where to, such as 180 45; Enter sends the dish there.",
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
