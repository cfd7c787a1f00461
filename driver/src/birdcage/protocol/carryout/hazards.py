"""What the lines of the console of a Carryout of 2003 do, as far as its owner tells."""

from __future__ import annotations

from birdcage.protocol.carryout.dialect import DIALECT
from birdcage.protocol.hazard import HazardTable, row_maker
from birdcage.rotator.verdict import Grade

MENUS = frozenset(DIALECT.prompts)
SUBMENUS = MENUS - {"root"}

_WHERE = frozenset({"position", "turn"})
_NVS = frozenset({"limits", "search", "settings"})
_ANYTHING = frozenset({"position", "turn", "homed", "limits", "search", "settings"})
_UNDOCUMENTED = r"(?!(\?|q)$).+"
"""Any line but the two that each menu has."""
_UNGUARDED = "birdcage checks no limits for this line."
_row = row_maker(MENUS, DIALECT.root)


HAZARDS = HazardTable(
    rows=(
        _row("all", ""),
        _row("all", r"\?"),
        _row("sub", "q"),
        _row("root", "target|motor|dvb|os|nvs"),
        _row("root", "q", Grade.RUINS,
             "At the root menu, `q` ends the shell of other dishes of this family until a power cycle."),
        _row("root", ".*q.*", Grade.RUINS,
             "A byte lost on the way could leave a bare `q` of this line, which may end the shell until a power cycle.",
             loose=True),
        _row("target", r"g (?P<az>\S+) (?P<el>\S+)", Grade.MOVES,
             f"Moves both axes. No command is known to stop them. {_UNGUARDED}", forgets=_WHERE, takes_s=60.0),
        _row("target", "g( .*)?", Grade.MOVES,
             "Moves the dish; what it does about a missing angle is unknown. No command is known to stop it. "
             f"{_UNGUARDED}", forgets=_WHERE, takes_s=60.0),
        _row("motor", _UNDOCUMENTED, Grade.MOVES,
             f"Undocumented command of a menu that moves the motors by hand. {_UNGUARDED}",
             forgets=_ANYTHING, takes_s=60.0, loose=True),
        _row("nvs", r"e( \S+)?"),
        _row("nvs", "e 102 .+", Grade.SETTING,
             "Changes the greatest elevation that the dish takes; `s` makes it permanent. A feed may strike above 73°.",
             forgets=_NVS),
        _row("nvs", r"e \S+ .+", Grade.SETTING,
             "Changes a setting of the dish; `s` makes it permanent. The one that disables tracking also disables "
             "homing: its angles mean nothing then.", forgets=_NVS),
        _row("nvs", "s( .*)?", Grade.SETTING,
             "Writes all changed settings into flash, wrong ones too.", forgets=_NVS, takes_s=10.0),
    ),
    unlisted={
        "": "Undocumented command. It may move the dish, change a setting, or worse.",
        "os": "Undocumented command of a menu that ends processes of the dish. Its shell may be one of them.",
    },
)  # fmt: skip
