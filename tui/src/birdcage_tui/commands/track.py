"""Commands of the tabs of the control page, and of its Craft tab, where a target is followed."""

from __future__ import annotations

from birdcage_tui.commands.table import Command, Reason
from birdcage_tui.shown.allowed import DESK_AWAITED, CommandContext, can_release, can_step
from birdcage_tui.shown.pursuit import pursuit_of

PAGE, HERE = "control", ("craft",)
TABS = ("control", "craft", "network")


def can_search(context: CommandContext) -> str | None:
    """Return why no target can be searched for."""
    if context.track is None:
        return DESK_AWAITED
    return context.track.problem if context.track.is_away else None


def can_watch(context: CommandContext) -> str | None:
    """Return why there is no target to do something with."""
    if context.track is None or context.track.is_away:
        return can_search(context)
    return "No target selected. / searches." if context.track.choice is None else None


def can_follow(context: CommandContext) -> str | None:
    """Return why the chosen target cannot be pointed at or followed; the station checks again."""
    return can_watch(context) or can_step(context) or (None if context.track is None else context.track.problem or None)


def can_leave(context: CommandContext) -> str | None:
    """Return why there is nothing to leave."""
    return None if pursuit_of(context.state) is not None else "No target is being followed."


def can_take(context: CommandContext) -> str | None:
    """Return why Enter does nothing here; while something is held, it releases that first, as everywhere."""
    return None if can_release(context) is None else can_search(context)


def can_forget(context: CommandContext) -> str | None:
    """Return why there is nothing to forget."""
    return "No interrupted pass." if context.track is None or context.track.unfinished is None else None


def can_take_offer(context: CommandContext) -> str | None:
    """Return why the target that was offered cannot be followed; what is held is released first, as everywhere."""
    return None if can_release(context) is None else can_follow(context)


def can_take_autotrack(context: CommandContext) -> str | None:
    """Return why autotrack, which was offered, cannot begin; what is held is released first, as everywhere."""
    return None if can_release(context) is None else can_autotrack(context)


def can_autotrack(context: CommandContext) -> str | None:
    """Return why autotrack cannot be switched. Off is always possible."""
    if context.track is not None and context.track.autotrack:
        return None
    return can_search(context) or can_step(context)


def _tab(name: str, key: str, title: str, text: str) -> Command:
    return Command(f"tab-{name}", (key,), key, title, text, "Tabs", where=TABS, page=PAGE)


def _craft(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, refused: Reason = can_watch,
           footer: str = "", group: str = "Craft") -> Command:  # fmt: skip
    return Command(f"track-{name}", keys, shown, title, text, group, refused, footer, HERE, page=PAGE)


def _offer(deed: str, title: str, text: str, footer: str) -> Command:
    """Return what Enter does while the row is shown that says what would move."""
    refused = can_take_autotrack if deed == "autotrack" else can_take_offer
    return Command(f"offer-{deed}", ("enter",), "Enter", title, text, "Craft", refused, footer, (f"offer-{deed}",),
                   page=PAGE)  # fmt: skip


TRACK = (
    _tab("manual", "b", "Manual", "Move the dish by hand."),
    _tab("presets", "P", "Presets", "Saved directions, over the whole width."),
    _tab("craft", "c", "Craft", "Find a target, see its pass, and follow it."),
    _tab("network", "N", "Network", "Who may move the dish, and how."),
    Command(
        "open-craft", ("f",), "f", "Follow a target", "Open Track: search, passes, following.", "Craft",
        footer="follow", footer_still="targets", where=("dashboard",), page=PAGE,
    ),
    _craft("search", ("slash",), "/", "Search", "Type a name, a number, a slot (19.2E), a body, or 180 45.",
           can_search, "search"),
    _craft("watch", ("w",), "w", "Watch", "Show the target without moving. Ends following."),
    _craft("aim", ("a",), "a", "Aim once", "Offer to point at the target once: Enter does it.", can_follow),
    _craft("follow", ("f",), "f", "Follow",
           "Offer to keep the dish on the target once it is in reach: Enter does it.", can_follow, "follow"),
    _craft("leave", ("x",), "x", "Leave", "End following. The dish stays where it is.", can_leave, "leave"),
    _craft("take", ("enter",), "Enter", "Choose", "Select the target or pass under the cursor.", can_take, "choose"),
    _offer("follow", "Follow the picked pass", "Follow what the row above the plan names.", "follow it"),
    _offer("aim", "Point once", "Point once at what the row above the plan names.", "point once"),
    _offer("autotrack", "Start autotrack", "Follow the scheduled passes one after another.", "start autotrack"),
    _craft("up", ("up", "k"), "↑ k", "Row above", "In the targets or the passes.", can_search),
    _craft("down", ("down", "j"), "↓ j", "Row below", "In the targets or the passes.", can_search),
    _craft("earlier", ("left_square_bracket",), "[", "0.1 s earlier", "The target comes earlier than computed.",
           group="Time offset"),
    _craft("later", ("right_square_bracket",), "]", "0.1 s later", "The target comes later than computed.",
           footer="offset", group="Time offset"),
    _craft("far-earlier", ("left_curly_bracket",), "{", "1 s earlier", "In steps of a second.",
           group="Time offset"),
    _craft("far-later", ("right_curly_bracket",), "}", "1 s later", "In steps of a second.",
           group="Time offset"),
    _craft("on-time", ("z",), "z", "No offset", "Reset the time offset.", group="Time offset"),
    _craft("view", ("v",), "v", "Next view", "Curves, passes, autotrack and radio take turns where there is no room "
           "for all.", can_search, "view"),
    _craft("autotrack", ("A",), "A", "Autotrack", "Offer to follow the scheduled passes one after another: Enter "
           "does it. A switches it off, too.", can_autotrack),
    _craft("frequency", ("F",), "F", "Frequency …", "Downlink in MHz. Empty: the satellite's own."),
    _craft("forget", ("D",), "D", "Dismiss", "Stop offering the interrupted pass.", can_forget),
)  # fmt: skip
