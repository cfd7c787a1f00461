"""Commands of the console, which lies over a page: its log, its line, and its view."""

from __future__ import annotations

from birdcage_tui.commands.table import Command

PAGE, WHERE = "console", ("console",)
LINE = ("console-input",)

CONSOLE: tuple[Command, ...] = (
    Command(
        "console-type", ("i",), "i", "Type a line", "Puts the cursor into the line; Enter does it too, in the log.",
        "Console", where=WHERE,
    ),
    Command(
        "console-find", ("slash",), "/", "Find in the log", "Type, Enter; then n and N step through the matches.",
        "Console", where=WHERE,
    ),
    Command("console-next", ("n",), "n", "Next match", "The match below.", "Console", where=WHERE),
    Command("console-previous", ("N",), "N", "Previous match", "The match above.", "Console", where=WHERE),
    Command(
        "console-stamps", ("t",), "t", "Times", "UTC, seconds since the line before, or none.", "Console",
        where=WHERE,
    ),
    Command(
        "console-hex", ("x",), "x", "Hexadecimal", "Every byte as two digits, and as text beside it.", "Console",
        where=WHERE,
    ),
    Command(
        "console-polling", ("p",), "p", "Polling, every byte",
        "Shows polling, echoes and marks of harmless lines, or folds them away again.", "Console", where=WHERE,
    ),
    Command(
        "console-save", ("s",), "s", "Save to a file", "Writes all lines that are kept here into a new file.",
        "Console", where=WHERE,
    ),
    Command(
        "console-clear", ("c",), "c", "Clear the view", "Empties the log here. The transcript files keep everything.",
        "Console", where=WHERE,
    ),
    Command("console-up", ("up",), "↑", "Scroll up", "Reading stops the log from following.", "Console", where=WHERE),
    Command("console-down", ("down",), "↓", "Scroll down", "One row down.", "Console", where=WHERE),
    Command("console-page-up", ("pageup",), "PgUp", "Page up", "Works while you type, too.", "Console", where=WHERE),
    Command("console-page-down", ("pagedown",), "PgDn", "Page down", "One page down.", "Console", where=WHERE),
    Command("console-home", ("home",), "Home", "Oldest line", "As far back as lines are kept.", "Console", where=WHERE),
    Command(
        "console-end", ("end",), "End", "Follow the newest line", "And go on following.", "Console", where=WHERE,
    ),
    Command(
        "console-complete", ("tab",), "Tab", "Complete",
        "A command of the dish's menu; on an empty line the dish is asked for its list.", "Line", where=LINE,
        page=PAGE,
    ),
    Command("console-older", ("up",), "↑", "Older line", "What was typed before.", "Line", where=LINE, page=PAGE),
    Command("console-newer", ("down",), "↓", "Newer line", "What was typed after that.", "Line", where=LINE, page=PAGE),
    Command(
        "console-recall", ("ctrl+r",), "^R", "Search what was typed",
        "Type a part; again for an older one; Enter takes it into the line, and sends nothing.", "Line",
        where=(*LINE, "console-find"), page=PAGE,
    ),
    Command(
        "console-end-line", ("ctrl+g",), "^G", "End what still prints", "Sends a bare Enter to the dish.", "Line",
        where=(*WHERE, *LINE),
    ),
)  # fmt: skip
