"""Commands of the page of passes: the list, the time machine, and what leaves the page as files."""

from __future__ import annotations

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext

HERE = ("passes",)


def can_choose(context: CommandContext) -> str | None:
    """Return why there is no pass to do something with."""
    if context.sky is None or not context.sky.rows:
        return "No passes yet."
    return None


def can_hear(context: CommandContext) -> str | None:
    """Return why what the feed hears is unknown."""
    if context.sky is None or not context.sky.rows:
        return "No passes yet."
    return None if context.sky.feed else "The feed has no band. Set freq_min_hz and freq_max_hz in birdcage.toml."


def _pass(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, footer: str = "",
          footer_still: str = "") -> Command:  # fmt: skip
    return Command(name, keys, shown, title, text, "Passes", can_choose, footer, HERE, footer_still=footer_still)


def _time(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, footer: str = "") -> Command:
    return Command(name, keys, shown, title, text, "Time machine", footer=footer, where=HERE)


PASSES = (
    Command("pass-up", ("up", "k"), "↑ k", "Pass above", "Select the row above.", "Passes", where=HERE),
    Command("pass-down", ("down", "j"), "↓ j", "Pass below", "Select the row below.", "Passes", where=HERE),
    Command("pass-page-up", ("pageup",), "PgUp", "Page up", "One screen.", "Passes", where=HERE),
    Command("pass-page-down", ("pagedown",), "PgDn", "Page down", "One screen.", "Passes", where=HERE),
    Command("pass-first", ("home",), "Home", "First pass", "Select the first row.", "Passes",
            where=HERE),
    Command("pass-filter", ("slash",), "/", "Filter", "Type parts of names, numbers or groups.", "Passes", where=HERE,
            footer="filter"),
    _pass("pass-sort", ("s",), "s", "Order", "Sort by next event, time in reach, maximum elevation or AOS.",
          "order"),
    _pass("pass-reachable", ("r",), "r", "In reach only", "Hide or show passes out of reach of this dish.",
          "in reach"),
    Command("pass-hearable", ("h",), "h", "Hearable only",
            "Hide or show satellites that the feed can't hear.", "Passes", can_hear, where=HERE),
    Command("pass-view", ("v",), "v", "Next view",
            "Elevation or figures; on a small screen path and timeline too.",
            "Passes", where=HERE, footer="view"),
    _pass("pass-follow", ("f",), "f", "Plan and follow",
          "Show the plan of the selected pass on F2. Nothing moves until you press Enter there.", "follow", "plan"),
    _pass("pass-favourites", ("F",), "F", "Favourites only", "Hide or show all other satellites."),
    _pass("pass-favourite", ("asterisk",), "*", "Favourite", "Mark or unmark the satellite of the selected pass.",
          "favourite"),
    Command("pass-undo", ("u",), "u", "Undo favourite", "Undo the last change of a favourite.", "Passes",
            where=HERE),
    Command("pass-world", ("w",), "w", "World map",
            "Ground track of the selected pass, footprint, day and night. w goes back.", "Passes",
            where=HERE, footer="world"),
    _pass("pass-export", ("x",), "x", "Export",
          "Save the listed passes as calendar (ICS), table (CSV) and JSON.", "export"),
    _time("time-back", ("left_square_bracket",), "[", "Earlier", "Show the sky a minute earlier. Nothing moves."),
    _time("time-forward", ("right_square_bracket",), "]", "Later", "Show the sky a minute later. Nothing moves.",
          "time"),
    _time("time-far-back", ("left_curly_bracket",), "{", "Much earlier", "Half an hour."),
    _time("time-far-forward", ("right_curly_bracket",), "}", "Much later", "Half an hour."),
    Command("time-event", ("e",), "e", "Jump to next event",
            "Show the next rise, reach, culmination or set of the selected pass.", "Time machine",
            can_choose, where=HERE),
    _time("time-type", ("t",), "t", "Jump to a time …", "Type the time to show, in UTC. Nothing moves."),
    _time("time-pause", ("z",), "z", "Pause", "Pause or continue the time shown."),
    _time("time-faster", ("full_stop",), ".", "Faster", "Run the time shown, up to 900 times as fast."),
    _time("time-slower", ("comma",), ",", "Slower", "Run the time shown more slowly."),
    _time("time-now", ("n",), "n", "Back to now", "Show now again.", "now"),
)  # fmt: skip
