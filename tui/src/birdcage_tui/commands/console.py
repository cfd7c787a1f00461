"""Commands of the console, which lies over a page: its log, its line, and its view."""

from __future__ import annotations

from birdcage_tui.commands.table import Command

PAGE, WHERE = "console", ("console",)
LINE = ("console-input",)

CONSOLE: tuple[Command, ...] = (
    Command(
        "console-type", ("i",), "i", "Type a line", "Type a command for the dish. Enter in the log does the same.",
        "Console", where=WHERE,
    ),
    Command(
        "console-find", ("slash",), "/", "Find in the log", "Type, Enter; then n and N step through the matches.",
        "Console", where=WHERE,
    ),
    Command("console-next", ("n",), "n", "Next match", "Go to the match below.", "Console", where=WHERE),
    Command("console-previous", ("N",), "N", "Previous match", "Go to the match above.", "Console", where=WHERE),
    Command(
        "console-stamps", ("t",), "t", "Times", "Show UTC, seconds since the previous line, or neither.", "Console",
        where=WHERE,
    ),
    Command(
        "console-hex", ("x",), "x", "Hexadecimal", "Show every byte in hex, with the text beside it.", "Console",
        where=WHERE,
    ),
    Command(
        "console-polling", ("p",), "p", "Polling, every byte",
        "Show or hide polling, echoes and marks of harmless lines.", "Console", where=WHERE,
    ),
    Command(
        "console-save", ("s",), "s", "Save to a file", "Save all lines here to a new file.",
        "Console", where=WHERE,
    ),
    Command(
        "console-clear", ("c",), "c", "Clear the view", "Clear the log here. The transcript files keep everything.",
        "Console", where=WHERE,
    ),
    Command("console-up", ("up",), "↑", "Scroll up", "Scrolling stops the log from following.", "Console", where=WHERE),
    Command("console-down", ("down",), "↓", "Scroll down", "One row down.", "Console", where=WHERE),
    Command("console-page-up", ("pageup",), "PgUp", "Page up", "Works while you type, too.", "Console", where=WHERE),
    Command("console-page-down", ("pagedown",), "PgDn", "Page down", "One page down.", "Console", where=WHERE),
    Command("console-home", ("home",), "Home", "Oldest line", "Go to the oldest stored line.", "Console", where=WHERE),
    Command(
        "console-end", ("end",), "End", "Follow the newest line", "Follow again.", "Console", where=WHERE,
    ),
    Command(
        "console-complete", ("tab",), "Tab", "Complete",
        "Complete a command of the dish's menu. On an empty line, ask the dish for its list.", "Line", where=LINE,
        page=PAGE,
    ),
    Command("console-older", ("up",), "↑", "Older line", "Show the previous line.", "Line", where=LINE, page=PAGE),
    Command("console-newer", ("down",), "↓", "Newer line", "Show the next line.", "Line", where=LINE, page=PAGE),
    Command(
        "console-recall", ("ctrl+r",), "^R", "Search typed lines",
        "Type a part; press again for an older one. Enter copies it to the line and sends nothing.", "Line",
        where=(*LINE, "console-find"), page=PAGE,
    ),
    Command(
        "console-end-line", ("ctrl+g",), "^G", "End the output", "Send a bare Enter to the dish.", "Line",
        where=(*WHERE, *LINE),
    ),
)  # fmt: skip
