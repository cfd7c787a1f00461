"""What the lines of the Trav'lers' consoles do (`docs/reference/travler.md`)."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from birdcage.protocol.hal.dialect import DIALECTS
from birdcage.protocol.hal.variant import NVS, VARIANTS, HalVariant
from birdcage.protocol.hazard import Hazard, HazardTable, row_maker
from birdcage.rotator.verdict import Grade

Row = Callable[..., Hazard]

_WHERE = frozenset({"position", "turn"})
_ALL = frozenset({"position", "turn", "homed", "limits", "search", "settings"})
_NVS = frozenset({"limits", "search", "settings"})
_UNGUARDED = "birdcage checks no limits for this line."
_QUEUED = f"Moves an axis after the move under way. Nothing can cancel it. {_UNGUARDED}"
_NO_SEARCH = "Ends the TV search; it begins again at the next power-up."
_MAYBE_NO_SEARCH = "May end a TV search, until the next power-up: told of the older Trav'ler alone."


def hazards_of(variant: HalVariant) -> HazardTable:
    """Return the table of one of the Trav'lers."""
    row = row_maker(frozenset(DIALECTS[variant.firmware].prompts), "root")
    return HazardTable(
        rows=(
            row("all", ""),
            row("all", r"\?"),
            *_of_tunnel(row, variant),
            *_of_home(row, variant),
            *_too_high(row, variant),
            *_of_motor(row, variant.motor),
            *_of_search(row, variant),
            *_of_settings(row, variant),
        ),
        unlisted={"": "Undocumented command. It may change a setting, or worse."},
    )


def _of_tunnel(row: Row, variant: HalVariant) -> Iterator[Hazard]:
    for menu in dict.fromkeys(("root", variant.home)):
        where = "At the root menu" if menu == "root" else f"In menu `{menu}`"
        yield row(menu, "q", Grade.RUINS,
                  f"{where}, `q` may end the shell: the dish then stays silent until a power cycle.")  # fmt: skip
        yield row(menu, ".*q.*", Grade.RUINS,
                  "A byte lost on the way could leave a bare `q` of this line, which may end the shell until a power "
                  "cycle.", loose=True)  # fmt: skip
    if variant.home != "root":
        yield row("root", variant.home)


def _too_high(row: Row, variant: HalVariant) -> Iterator[Hazard]:
    if not variant.stalls_above:
        return
    highest_deg = variant.el_deg[1]
    for line in (r"a (?P<motor>\S+) (?P<el>.+)", r"g (?P<az>\S+) (?P<el>\S+)( .*)?"):
        yield row(variant.motor, line, Grade.RUINS,
                  f"Above {highest_deg:g}° the elevation stalls, and the whole dish may lock up until a power cycle.",
                  forgets=_WHERE, takes_s=30.0, above_deg=highest_deg)  # fmt: skip


def _of_home(row: Row, variant: HalVariant) -> Iterator[Hazard]:
    home = variant.home
    for menu in variant.submenus:
        yield row(menu, "q")
    yield row(home, "|".join(variant.submenus))
    yield row(home, "stow( .*)?", Grade.RUINS,
              "Folds the dish flat by itself. A feed that is not the stock one may be crushed, and nothing stops it.",
              forgets=_WHERE, takes_s=60.0)  # fmt: skip
    homes = "homes, turns over its whole range and begins its TV search"
    if not variant.home_told:
        homes = "may home, turn over its whole range and begin a TV search"
    yield row(home, "reboot( .*)?", Grade.MOVES, f"Restarts the dish: it {homes}.",
              forgets=_ALL, takes_s=180.0, restarts=True)  # fmt: skip


def _of_motor(row: Row, motor: str) -> Iterator[Hazard]:
    yield row(motor, "a")
    yield row(motor, r"a (?P<axis>[01]) (?P<angle>\d\S*)", Grade.MOVES, _QUEUED, forgets=_WHERE, takes_s=20.0)
    yield row(motor, r"a 2 \S+", Grade.MOVES, "Turns the feed. Its range is undocumented.", takes_s=20.0)
    yield row(motor, "a .+", Grade.MOVES,
              f"{_QUEUED} A sign is part of the angle: -0.5 is half a degree below zero.",
              forgets=_WHERE, takes_s=20.0)  # fmt: skip
    yield row(motor, r"g (?P<az>\S+) (?P<el>\S+) \S+", Grade.MOVES,
              f"Moves all axes at once until any key ends it. {_UNGUARDED}", forgets=_WHERE, takes_s=30.0)  # fmt: skip
    yield row(motor, "g( .*)?", Grade.MOVES,
              "Moves the dish at once until any key ends it; what it does about a missing angle is unknown. "
              f"{_UNGUARDED}", forgets=_WHERE, takes_s=30.0)  # fmt: skip


def _of_search(row: Row, variant: HalVariant) -> Iterator[Hazard]:
    search, forgets = variant.search, frozenset({"position", "search"})
    ends = _NO_SEARCH if variant.search_told else _MAYBE_NO_SEARCH
    if search == "ngsearch":
        yield row(search, "s( .*)?", Grade.SETTING, ends, forgets=forgets)
        return
    yield row(search, "tasks")
    yield row(search, "kill search", Grade.SETTING, ends, forgets=forgets)
    yield row(search, "kill( (?!search$).*)?", Grade.RUINS,
              "Ends a task of the dish. What that task did, its console or its motors too, may stay dead until a "
              "power cycle.", forgets=_ALL)  # fmt: skip


def _of_settings(row: Row, variant: HalVariant) -> Iterator[Hazard]:
    lowest = "|".join(map(str, variant.lowest.values()))
    yield row(NVS, r"d( \S+)?", takes_s=10.0)
    yield row(NVS, r"e( \S+)?")
    yield row(NVS, f"e 0*({lowest}) .+", Grade.SETTING,
              f"Changes the lowest elevation that the dish takes; `s` makes it permanent. {variant.lower_down} A feed "
              "may strike there.", forgets=_NVS)  # fmt: skip
    yield row(NVS, r"e \S+ .+", Grade.SETTING,
              "Changes a setting of the dish; `s` makes it permanent. Disabling the GPS of a dish that has one is "
              "said to cut its two units off from each other for good.", forgets=_NVS)  # fmt: skip
    yield row(NVS, "s( .*)?", Grade.SETTING,
              "Writes all changed settings into flash, wrong ones too: they apply from the next start.",
              forgets=_NVS, takes_s=10.0)  # fmt: skip


HAZARDS = {variant.firmware: hazards_of(variant) for variant in VARIANTS}
