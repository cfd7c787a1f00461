"""Commands of the Calibrate tab of F8: objects, nudges, peaks, sets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.base.geometry import shortest_turn

from birdcage_tui.commands.signal import can_find, deaf
from birdcage_tui.commands.table import Command, Reason, always
from birdcage_tui.shown.allowed import CommandContext, can_move, can_release

if TYPE_CHECKING:
    from birdcage.calibration.guide import GuideView

PAGE = "calibrate"
HERE, OBJECTS, PEAKS, SETS = (PAGE,), ("calibrate-objects",), ("calibrate-peaks",), ("calibrate-sets",)
SAME_DEG = 0.02
"""Less than the smallest step of these gears: it has not been moved since."""


def can_calibrate(context: CommandContext) -> str | None:
    """Return why nothing can be calibrated."""
    now = context.calibrate
    if now is None or now.guide is None:
        return (now.wrong if now is not None else "") or "The calibration is still opening."
    return None


def can_select(context: CommandContext) -> str | None:
    """Return why there is no next object to select."""
    now = context.calibrate
    if now is not None and now.guide is not None and not now.guide.proposals:
        return now.wrong or "This dish can hear nothing that is in reach now."
    return can_calibrate(context)


def can_return(context: CommandContext) -> str | None:
    """Return why the current object cannot be selected."""
    now = context.calibrate
    if now is not None and now.guide is not None and not now.guide.target:
        return "No object yet. n: select the next best one."
    return can_calibrate(context)


def can_go(context: CommandContext) -> str | None:
    """Return why the dish cannot be sent to an object."""
    now = context.calibrate
    if now is not None and now.guide is not None and not (now.guide.proposals or now.guide.target):
        return now.wrong or "This dish can hear nothing that is in reach now."
    return can_calibrate(context) or can_move(context)


def can_nudge(context: CommandContext) -> str | None:
    """Return why the dish cannot be nudged."""
    return can_calibrate(context) or can_move(context)


def can_take(context: CommandContext) -> str | None:
    """Return why no peak can be taken; while something is held, Enter releases that first, as everywhere."""
    if can_release(context) is None:
        return None
    now = context.calibrate
    if now is None or now.guide is None:
        return can_calibrate(context)
    if not now.guide.target:
        return "No object yet. n: select the next best one."
    return now.guide.may_not_take or _taken(now.guide)


def can_find_peak(context: CommandContext) -> str | None:
    """Return why the peak of the present object cannot be found by the signal."""
    now = context.calibrate
    if now is None or now.guide is None:
        return can_calibrate(context)
    if not now.guide.target:
        return "No object yet. n: select the next best one."
    if (reason := deaf(context)) is not None:
        return f"{reason} Nudge to the highest signal by your own meter, or choose another source on F3."
    return can_find(context) or now.guide.may_not_take or None


def _taken(guide: GuideView) -> str | None:
    """Return the number of a peak on this object that was taken right here: the same again would count twice."""
    position = guide.position
    for peak in guide.peaks:
        if position is not None and peak.target == guide.target:
            turn = abs(shortest_turn(peak.dish_az_deg, position.dish_az_deg))
            if max(turn, abs(peak.dish_el_deg - position.dish_el_deg)) < SAME_DEG:
                return f"Already saved as peak {peak.number}. n: select the next object."
    return None


def can_apply(context: CommandContext) -> str | None:
    """Return why there is nothing to keep."""
    now = context.calibrate
    if now is not None and now.guide is not None and now.guide.fit is None:
        return "No peaks yet."
    return can_calibrate(context)


def can_forget(context: CommandContext) -> str | None:
    """Return why there is nothing to forget."""
    now = context.calibrate
    if now is not None and now.guide is not None and not now.guide.peaks:
        return "No peaks yet."
    return can_calibrate(context)


def can_undo(context: CommandContext) -> str | None:
    """Return why nothing can be brought back."""
    now = context.calibrate
    return can_calibrate(context) or (None if now is not None and now.removed else "No deleted peaks.")


def can_use(context: CommandContext) -> str | None:
    """Return why no kept set can be put into force; while something is held, Enter releases that first."""
    if can_release(context) is None:
        return None
    now = context.calibrate
    return can_calibrate(context) or (None if now is not None and now.sets else "No saved sets. a: save one.")


def can_go_or_release(context: CommandContext) -> str | None:
    """Return why Enter on an object does nothing; while something is held, it releases that first."""
    return None if can_release(context) is None else can_go(context)


def _at(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, group: str = "Calibrate",
        refused: Reason = always, footer: str = "", where: tuple[str, ...] = HERE) -> Command:  # fmt: skip
    return Command(f"calibrate-{name}", keys, shown, title, text, group, refused, footer, where, page=PAGE)


CALIBRATE = (
    Command("tab-calibrate", ("C",), "C", "Calibrate", "Measure the alignment of the dish with peaks on known objects.",
            "Tabs", where=("setup",), page=PAGE),
    _at("take", ("enter",), "Enter", "Save peak",
        "The signal is highest here. Save the direction of dish and object.", refused=can_take, footer="save peak"),
    _at("find", ("f",), "f", "Find the peak …",
        "Find the peak of the object by the signal and save it: nothing is nudged. Asks first.", refused=can_find_peak,
        footer="find peak"),
    _at("next", ("n",), "n", "Next object", "Select the next best object. Nothing moves until you press Enter.",
        refused=can_select, footer="next"),
    _at("again", ("m",), "m", "Current object",
        "Select the current object to return to it. Nothing moves until you press Enter.", refused=can_return),
    _at("left", ("left", "h"), "← h", "Nudge left", "One step on the sky, as seen from the dish.", "Nudge", can_nudge),
    _at("right", ("right", "l"), "→ l", "Nudge right", "One step on the sky.", "Nudge", can_nudge, "nudge"),
    _at("up", ("up", "k"), "↑ k", "Nudge up", "One step on the sky.", "Nudge", can_nudge),
    _at("down", ("down", "j"), "↓ j", "Nudge down", "One step on the sky.", "Nudge", can_nudge),
    _at("apply", ("a",), "a", "Use this fit …", "Save the fit under a name and use it for all pointing.",
        "Results", can_apply, "apply"),
    _at("view", ("v",), "v", "Next picture", "Residuals, or peaks on the sky.", "Results",
        footer="picture"),
    _at("objects", ("o",), "o", "Objects", "Select another object.", "Lists", footer="objects"),
    _at("peaks", ("p",), "p", "Peaks", "Saved peaks.", "Lists", footer="peaks"),
    _at("sets", ("s",), "s", "Sets", "Saved alignments.", "Lists", footer="sets"),
    _at("undo", ("u",), "u", "Restore peaks", "Restore the last deleted peaks.", "Lists", can_undo),
    _at("refresh", ("r",), "r", "Look again", "Find again what is up and best to peak on.", "Lists",
        can_calibrate),
    _at("begin", ("X",), "X", "Delete all peaks …", "Start anew after you move the base. Asks first.", "Lists",
        can_forget),
    _at("object-up", ("up", "k"), "↑ k", "Object above", "Select the row above.", "Objects", where=OBJECTS),
    _at("object-down", ("down", "j"), "↓ j", "Object below", "Select the row below.", "Objects", where=OBJECTS),
    _at("object-go", ("enter",), "Enter", "Go there", "Turn the dish to the object under the cursor.", "Objects",
        can_go_or_release, "go there", OBJECTS),
    _at("peak-up", ("up", "k"), "↑ k", "Peak above", "Select the row above.", "Peaks", where=PEAKS),
    _at("peak-down", ("down", "j"), "↓ j", "Peak below", "Select the row below.", "Peaks", where=PEAKS),
    _at("peak-forget", ("d", "delete"), "d", "Delete peak", "u restores it.", "Peaks", can_forget, "forget",
        PEAKS),
    _at("set-up", ("up", "k"), "↑ k", "Set above", "Select the row above.", "Sets", where=SETS),
    _at("set-down", ("down", "j"), "↓ j", "Set below", "Select the row below.", "Sets", where=SETS),
    _at("set-use", ("enter",), "Enter", "Use this set", "Use the alignment under the cursor. Nothing moves.",
        "Sets", can_use, "use it", SETS),
)  # fmt: skip
