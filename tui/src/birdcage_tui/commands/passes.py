"""Commands of the page of passes: the list, the time machine, and what leaves the page as files."""

from __future__ import annotations

from birdcage_tui.commands.table import Command
from birdcage_tui.view import View

HERE = ("passes",)


def can_choose(view: View) -> str | None:
    """Return why there is no pass to do something with."""
    if view.sky is None or not view.sky.rows:
        return "No pass is known yet."
    return None


def can_hear(view: View) -> str | None:
    """Return why nobody can say what the feed hears."""
    if view.sky is None or not view.sky.rows:
        return "No pass is known yet."
    return None if view.sky.feed else "The feed says no band: freq_min_hz and freq_max_hz in birdcage.toml do."


def _pass(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, footer: str = "") -> Command:
    return Command(name, keys, shown, title, text, "Passes", can_choose, footer, HERE)


def _time(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, footer: str = "") -> Command:
    return Command(name, keys, shown, title, text, "Time machine", footer=footer, where=HERE)


PASSES = (
    Command("pass-up", ("up", "k"), "↑ k", "Pass above", "Choose the one above.", "Passes", where=HERE),
    Command("pass-down", ("down", "j"), "↓ j", "Pass below", "Choose the one below.", "Passes", where=HERE),
    Command("pass-page-up", ("pageup",), "PgUp", "Page up", "As many as are seen.", "Passes", where=HERE),
    Command("pass-page-down", ("pagedown",), "PgDn", "Page down", "As many as are seen.", "Passes", where=HERE),
    Command("pass-first", ("home",), "Home", "First pass", "Follow what stands first in the list.", "Passes",
            where=HERE),
    Command("pass-filter", ("slash",), "/", "Filter", "Type parts of names, numbers or groups.", "Passes", where=HERE,
            footer="filter"),
    _pass("pass-sort", ("s",), "s", "Order", "By what comes next, minutes in reach, highest elevation, or AOS.",
          "order"),
    _pass("pass-reachable", ("r",), "r", "In reach only", "Hide what this dish cannot point at, or show it again.",
          "in reach"),
    Command("pass-hearable", ("h",), "h", "Hearable only",
            "Hide what the feed in use is not known to hear, or show it again.", "Passes", can_hear, where=HERE),
    Command("pass-view", ("v",), "v", "Next view",
            "Path, elevation, figures and timeline take turns on a small screen; elevation and figures on a large one.",
            "Passes", where=HERE, footer="view"),
    _pass("pass-follow", ("f",), "f", "Plan and follow",
          "Show the plan of the chosen pass on F2; Enter there follows it. Nothing moves before.", "follow"),
    _pass("pass-favourites", ("F",), "F", "Favourites only", "Hide all other satellites, or show them again."),
    _pass("pass-favourite", ("asterisk",), "*", "Favourite", "Mark the satellite of the chosen pass, or unmark it.",
          "favourite"),
    Command("pass-undo", ("u",), "u", "Undo favourite", "Take back the last marking or unmarking.", "Passes",
            where=HERE),
    Command("pass-world", ("w",), "w", "World map",
            "The ground track of the chosen pass, from where it is seen, day and night; w goes back.", "Passes",
            where=HERE, footer="world"),
    _pass("pass-export", ("x",), "x", "Export",
          "Write the listed passes as a calendar (ICS), a table (CSV) and JSON, and say where.", "export"),
    _time("time-back", ("left_square_bracket",), "[", "Earlier", "Show the sky a minute earlier. Nothing moves by it."),
    _time("time-forward", ("right_square_bracket",), "]", "Later", "Show the sky a minute later. Nothing moves by it.",
          "time"),
    _time("time-far-back", ("left_curly_bracket",), "{", "Much earlier", "Half an hour."),
    _time("time-far-forward", ("right_curly_bracket",), "}", "Much later", "Half an hour."),
    Command("time-event", ("e",), "e", "Jump to next event",
            "Show the moment at which the chosen pass rises, comes into reach, culminates or sets.", "Time machine",
            can_choose, where=HERE),
    _time("time-type", ("t",), "t", "Jump to a time …", "Type the moment to show, in UTC. Nothing moves by it."),
    _time("time-pause", ("z",), "z", "Pause", "Let the time shown stand still, or go on."),
    _time("time-faster", ("full_stop",), ".", "Faster", "Let the time shown run, up to 900 times as fast."),
    _time("time-slower", ("comma",), ",", "Slower", "Let the time shown run more slowly."),
    _time("time-now", ("n",), "n", "Back to now", "Show now again.", "now"),
)  # fmt: skip
