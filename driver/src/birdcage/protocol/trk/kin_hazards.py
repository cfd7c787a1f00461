"""What the lines of a relative's console do, as far as sources tell (docs/reference/g2-kin.md, *Menus*)."""

from __future__ import annotations

from birdcage.console.dialect import ConsoleDialect
from birdcage.protocol.hazard import Hazard, HazardTable, row_maker
from birdcage.rotator.facts import Facts
from birdcage.rotator.verdict import Grade

_WHERE = frozenset({"position", "turn"})
_REFERENCE = _WHERE | {"homed"}
_NVS = frozenset({"limits", "search", "settings"})
_ALL = _REFERENCE | _NVS
_UNDOCUMENTED = r"(?!(\?|q|help( \S+)?)$).+"
"""Any line but those that each menu has."""
_UNGUARDED = "birdcage checks no limits for this line."
_HOMING = "Runs the axis into its stop to find its reference. Only cutting the power stops that."


def kin_hazards(dialect: ConsoleDialect, facts: Facts) -> HazardTable:
    """Return the table of a relative that homes by command, with the menus of a dialect."""
    homing_s = facts.homing_s
    assert homing_s is not None, "each of them homes by command"
    menus = frozenset(dialect.prompts)
    row = row_maker(menus, dialect.root)
    settings: tuple[Hazard, ...] = ()
    if "nvs" in menus:
        settings = (
            row("nvs", r"d( \S+)?", takes_s=10.0),
            row("nvs", r"e( \S+)?"),
            row("nvs", r"e \S+ .+", Grade.SETTING,
                "Changes a setting of the dish; `s` makes it permanent. Row 20 switches its TV search, and with it "
                "homing at power-up. What other rows do is not known.", forgets=_NVS),
            row("nvs", "s( .*)?", Grade.SETTING,
                "Writes all changed settings into flash, wrong ones too: they apply from the next start.",
                forgets=_NVS, takes_s=10.0),
        )  # fmt: skip
    return HazardTable(
        rows=(
            row("all", ""),
            row("all", r"\?|help( \S+)?"),
            row("sub", "q"),
            row("root", "|".join(sorted(menus - {dialect.root}))),
            row("root", "q", Grade.RUINS,
                "At the root menu, `q` ends the shell of a relative of this dish until a power cycle."),
            row("root", ".*q.*", Grade.RUINS,
                "A byte lost on the way could leave a bare `q` of this line, which may end the shell until a power "
                "cycle.", loose=True),
            row("root", "stow( .*)?", Grade.RUINS,
                "Folds relatives of this dish flat. A feed that is not the stock one may be crushed, and nothing "
                "stops it.", forgets=_WHERE, takes_s=60.0),
            row("root", "reboot( .*)?", Grade.MOVES,
                "Restarts relatives of this dish: it may home and begin its TV search.",
                forgets=_ALL, takes_s=180.0, restarts=True),
            row("mot", "a"),
            row("mot", r"a (?P<axis>[01]) (?P<angle>\d\S*)", Grade.MOVES, f"Moves an axis. {_UNGUARDED}",
                forgets=_WHERE, takes_s=20.0),
            row("mot", "h 0", Grade.MOVES, _HOMING, forgets=_REFERENCE, takes_s=homing_s, homes=(0,)),
            row("mot", "h 1", Grade.MOVES, _HOMING, forgets=_REFERENCE, takes_s=homing_s, homes=(1,)),
            row("mot", r"h \*", Grade.MOVES, _HOMING, forgets=_REFERENCE, takes_s=2 * homing_s, homes=(0, 1)),
            row("mot", _UNDOCUMENTED, Grade.MOVES,
                f"Undocumented command of the menu that moves the motors. {_UNGUARDED}",
                forgets=_ALL, takes_s=60.0, loose=True),
            *settings,
        ),
        unlisted={"": "Undocumented command. It may move the dish, change a setting, or worse."},
    )  # fmt: skip
