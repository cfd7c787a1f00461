"""What the lines of a rotctld do (`docs/reference/rotctl.md`, *Commands*).

Capitals and small letters are judged alike: what follows tells the command that sets from the one that asks. The
server reads one blank-separated word after the other: a row that does not move matches just the words of its command.
"""

from __future__ import annotations

import re

from birdcage.protocol.hazard import Hazard, HazardTable
from birdcage.rotator.verdict import Grade

_WHERE = frozenset({"position"})
_ANYTHING = frozenset({"position", "turn", "limits", "settings"})
_NAME = r"(\?|[^\\\s]\S+)"
"""A word that is no command of its own: those are one letter, or begin with a backslash."""
_VALUE = r"[-+]?\d+(\.\d*)?"
_UNGUARDED = "birdcage checks no limits for this line."


def _row(pattern: str, grade: Grade = Grade.HARMLESS, consequence: str = "", **more: object) -> Hazard:
    return Hazard(frozenset(), re.compile(pattern), grade, consequence, **more)  # type: ignore[arg-type]


HAZARDS = HazardTable(
    rows=(
        _row(""),
        _row(r"p|\\get_pos"),
        _row(r"(p|\\set_pos) (?P<az>\S+) (?P<el>\S+)", Grade.MOVES, f"Turns both axes at once. {_UNGUARDED}",
             forgets=_WHERE, takes_s=2.0),
        _row(r"(p|\\set_pos) .*", Grade.MOVES, f"Turns the rotator where what follows says. {_UNGUARDED}",
             forgets=_WHERE, takes_s=2.0),
        _row(r"s|\\get_status|\\stop"),
        _row(r"k|\\park", Grade.MOVES,
             f"Sends the rotator to a park position of its own, which no command tells. {_UNGUARDED}",
             forgets=_WHERE, takes_s=2.0),
        _row(r"(m|\\move) .*", Grade.MOVES,
             f"Turns an axis until `S`, or the end of its range, stops it. {_UNGUARDED}", forgets=_WHERE, takes_s=2.0),
        _row(r"(r|\\reset)( .*)?", Grade.MOVES,
             "Resets the rotator: it may find its references again, turn over its whole range, and count anew.",
             forgets=_ANYTHING, takes_s=10.0),
        _row(r"_|\\get_info"),
        _row(r"1|\\dump_caps|\\dump_state", takes_s=1.0),
        _row(r"3|\\dump_conf"),
        _row(rf"\\get_conf {_NAME}"),
        _row(rf"(v|\\get_level|u|\\get_func|x|\\get_parm) {_NAME}"),
        _row(rf"(v|\\set_level|u|\\set_func|x|\\set_parm) {_NAME} {_VALUE}", Grade.SETTING,
             "Changes a setting of the rotator, until it is changed again.", forgets=frozenset({"settings"})),
        _row(rf"(c|\\set_conf) {_NAME} ({_NAME}|{_VALUE})", Grade.SETTING,
             "Changes how the server reaches its rotator, or the range that it tells: for all its clients.",
             forgets=_ANYTHING),
        _row(r"(w|\\send_cmd) .*", Grade.MOVES,
             f"Hands the line to the rotator's controller as it is: what that does is its own affair. {_UNGUARDED}",
             forgets=_ANYTHING, takes_s=2.0),
        _row(rf"\\pause {_VALUE}", Grade.SETTING, "The server answers nothing for that long, STOP included.",
             takes_s=2.0),
        _row("q|\\\\quit", Grade.SETTING, "Ends this connection. birdcage connects anew.", forgets=_WHERE),
    ),
    unlisted={"": "Undocumented command. It may move the rotator."},
    unlisted_grade=Grade.MOVES,
)  # fmt: skip
