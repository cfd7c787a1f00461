"""The words of the console: which way it works now, what a line would do, what waits."""

from __future__ import annotations

from birdcage.station.raw import CONSOLE, IDLE_S, Grade, MenuCommand, Verdict
from birdcage.station.state import LinkPhase

from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import View

GRADES = {
    Grade.HARMLESS: ("", ""),
    Grade.SETTING: ("warn-row", "▲ SETTING"),
    Grade.MOVES: ("warn-row", "▲ MOVES"),
    Grade.RUINS: ("fault-row", "✖ CAN RUIN"),
}
"""The ink, the glyph and the word of each grade."""


def talking(view: View) -> bool:
    """Return whether the console has control: polling pauses."""
    return view.state.holder == CONSOLE


def mode_words(view: View, quiet_s: float) -> tuple[str, str, str]:
    """Return the mode, a sentence about it, and the ink of the mode."""
    if not view.link_up:
        return "NO LINK", "the dish does not answer; your text stays", "fault-row"
    if not talking(view):
        return "WATCH", "live", "key"
    age_s = view.position_age_s
    known = "position unknown" if age_s is None else f"position {age_text(age_s)} old"
    left_s = max(IDLE_S - quiet_s, 0.0)
    return "TALK", f"polling paused, {known}, {left_s:.0f} s idle returns control", "accent-row"


def prompt_words(view: View, prompt: str, *, has_prompt: bool) -> str:
    """Return what stands before the line: the prompt.

    A dash without a link; `?` while no prompt was seen; nothing on a machine that shows none.
    """
    if view.state.link.state is not LinkPhase.UP:
        return "—"
    if not has_prompt:
        return ""
    if not prompt:
        return "?"
    menu = view.state.menu
    return prompt if menu is None or prompt.lower().rstrip("> ") == menu else f"{menu} {prompt}"


def verdict_words(verdict: Verdict) -> str:
    """Return a hazard in words: the grade, and what it does."""
    word, does = GRADES[verdict.grade][1], verdict.consequence
    if verdict.limit:
        does = does.replace(UNCHECKED, "").rstrip()  # that the limit is told refutes it
    if verdict.listed and verdict.grade is Grade.MOVES and does.startswith("Moves "):
        return f"{word} {does.removeprefix('Moves ')}"
    unlisted = "" if verdict.listed else " (not in the table)"
    return f"{word}{unlisted}: {does}"


def held_words(line: str, verdict: Verdict, *, may_move: bool) -> str:
    """Return why a line that moves the dish is not sent while STOP is latched, and what to do."""
    how = " To release the motors now: F5 closes the console, then F2 and R." if verdict.releases else ""
    first = "Once the dish rests, Esc then Enter releases" if may_move else "Esc, then Enter, releases"
    return f"STOP is latched: `{line}` may move the dish and is not sent. {first} STOP.{how}"


def is_worse(verdict: Verdict, told: Verdict) -> bool:
    """Return whether a line would do something else, and not less bad, than what a person was told."""
    other = verdict.grade is told.grade and verdict.consequence != told.consequence
    return verdict.grade > told.grade or other or bool(verdict.limit and not told.limit)


def ink_of(verdict: Verdict) -> str:
    """Return the ink of the hint: a broken limit is as bad as what can ruin."""
    return "fault-row" if verdict.limit else GRADES[verdict.grade][0]


def asks(verdict: Verdict) -> bool:
    """Return whether a question is put before the line is sent; a change of a setting is armed in the line itself."""
    return verdict.grade >= Grade.MOVES or bool(verdict.limit)


def usage_words(command: MenuCommand) -> str:
    """Return how a command is used, and what it does."""
    told = "" if command.told_by_dish else "  (from the reference)"
    return f"{command.usage}   {command.help}".rstrip() + told


def offer_words(commands: tuple[MenuCommand, ...]) -> str:
    """Return the names that fit what was typed."""
    return "Tab: " + "  ".join(command.name for command in commands)


def bytes_text(count: int) -> str:
    """Return `340 B`, `1.2 kB`, `3.4 MB`."""
    if count < 1000:
        return f"{count} B"
    return f"{count / 1000:.1f} kB" if count < 1_000_000 else f"{count / 1_000_000:.1f} MB"


UNCHECKED = "birdcage checks no limits for this line."


def question_words(verdict: Verdict) -> str:
    """Return what is asked before a line that moves the dish, or that can ruin it."""
    limit = f"\n\n✖ LIMIT: {verdict.limit}" if verdict.limit else ""
    told = verdict_words(verdict)
    unchecked = "" if verdict.limit or UNCHECKED in told else f"\n\n{UNCHECKED}"
    return f"{told}{limit}{unchecked}"


NO_LIST = "No command of this machine is documented."


def list_words(commands: tuple[MenuCommand, ...]) -> str:
    """Return how many commands the dish itself has listed; Tab goes through all."""
    told = sum(command.told_by_dish for command in commands)
    if not told:
        return f"The reference lists {len(commands)} commands. Tab shows them." if commands else NO_LIST
    return f"The dish lists {told} commands here; {len(commands) - told} more are in the reference. Tab shows them."
