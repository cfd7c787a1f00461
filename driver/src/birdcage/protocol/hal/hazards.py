"""What the lines of the Trav'ler's console do (`docs/reference/travler.md`)."""

from __future__ import annotations

from birdcage.protocol.hal.dialect import DIALECT
from birdcage.protocol.hazard import HazardTable, row_maker
from birdcage.rotator.verdict import Grade

MENUS = frozenset(DIALECT.prompts)
SUBMENUS = MENUS - {"root"}

_WHERE = frozenset({"position", "turn"})
_ALL = frozenset({"position", "turn", "homed", "limits", "search", "settings"})
_NVS = frozenset({"limits", "search", "settings"})
_UNGUARDED = "birdcage checks no limits for this line."
_QUEUED = f"Moves an axis after the move under way. Nothing can cancel it. {_UNGUARDED}"
_row = row_maker(MENUS, DIALECT.root)


HAZARDS = HazardTable(
    rows=(
        _row("all", ""),
        _row("all", r"\?"),
        _row("sub", "q"),
        _row("root", "motor|ngsearch|nvs"),
        _row("root", "q", Grade.RUINS,
             "At the root menu, `q` may end the shell: the dish then stays silent until a power cycle."),
        _row("root", ".*q.*", Grade.RUINS,
             "A byte lost on the way could leave a bare `q` of this line, which may end the shell until a power cycle.",
             loose=True),
        _row("root", "stow( .*)?", Grade.RUINS,
             "Folds the dish flat by itself. A feed that is not the stock one may be crushed, and nothing stops it.",
             forgets=_WHERE, takes_s=60.0),
        _row("root", "reboot( .*)?", Grade.MOVES,
             "Restarts the dish: it homes, turns over its whole range and begins its TV search.",
             forgets=_ALL, takes_s=180.0, restarts=True),
        _row("motor", "a"),
        _row("motor", r"a (?P<axis>[01]) (?P<angle>\d\S*)", Grade.MOVES, _QUEUED, forgets=_WHERE, takes_s=20.0),
        _row("motor", r"a 2 \S+", Grade.MOVES, "Turns the feed. Its range is undocumented.", takes_s=20.0),
        _row("motor", "a .+", Grade.MOVES, f"{_QUEUED} A sign is part of the angle: -0.5 is half a degree below zero.",
             forgets=_WHERE, takes_s=20.0),
        _row("motor", r"g (?P<az>\S+) (?P<el>\S+) \S+", Grade.MOVES,
             f"Moves all axes at once until any key ends it. {_UNGUARDED}", forgets=_WHERE, takes_s=30.0),
        _row("motor", "g( .*)?", Grade.MOVES,
             "Moves the dish at once until any key ends it; what it does about a missing angle is unknown. "
             f"{_UNGUARDED}", forgets=_WHERE, takes_s=30.0),
        _row("ngsearch", "s( .*)?", Grade.SETTING, "Ends the TV search; it begins again at the next power-up.",
             forgets=frozenset({"position", "search"})),
        _row("nvs", r"d( \S+)?", takes_s=10.0),
        _row("nvs", r"e( \S+)?"),
        _row("nvs", "e 12[57] .+", Grade.SETTING,
             "Changes the lowest elevation that the dish takes; `s` makes it permanent. Below 15° its own moves are "
             "unreliable, and a feed may strike.", forgets=_NVS),
        _row("nvs", r"e \S+ .+", Grade.SETTING,
             "Changes a setting of the dish; `s` makes it permanent. Disabling the GPS of a dish that has one is said "
             "to cut its two units off from each other for good.", forgets=_NVS),
        _row("nvs", "s( .*)?", Grade.SETTING,
             "Writes all changed settings into flash, wrong ones too: they apply from the next start.",
             forgets=_NVS, takes_s=10.0),
    ),
    unlisted={"": "Undocumented command. It may change a setting, or worse."},
)  # fmt: skip
