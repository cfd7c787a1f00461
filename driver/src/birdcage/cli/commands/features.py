"""`birdcage features`."""

from __future__ import annotations

from typing import Any

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted

_HEAD = ("name", "what", "set", "asked")
_SHORTEST = 20
"""No cell of what a feature is gets shorter than that."""


@click.command("features", epilog=exits.EPILOG)
@global_options()
def command() -> None:
    """List what this dish tells besides its position, and what you may set.

    One line each: name, what it is with its unit, and how it is set. A wide terminal also shows what the dish is asked.
    `birdcage get NAME` reads it, `birdcage set NAME VALUE` sets it. until restart: the dish forgets it when it
    restarts. from power-up: it is saved, and counts from the next power-up on.

    If another birdcage program has the port, that one is asked. With a named firmware no port is opened.
    """
    from birdcage.cli.dish_features import list_features
    from birdcage.cli.say import say, tell_json

    told = list_features(wanted())
    rows = told["features"]
    if flags().json:
        tell_json(told)
    elif not rows:
        say("This dish tells its position only.")
    else:
        _tell(rows)


def _tell(rows: list[dict[str, Any]]) -> None:
    """Print each group of each page below its heading."""
    from birdcage.cli.feature_pages import heading_of
    from birdcage.cli.say import tell
    from birdcage.cli.table import GAP, cut, fitting, room, tell_table, widths_of

    groups: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        groups.setdefault(heading_of(row), []).append(row)
    for heading, rows_of in groups.items():
        tell(heading)
        cells = [(f"{GAP}{row['id']}", f"{row['label']}{_unit(row)}", _set(row), row["asked"] or "") for row in rows_of]
        shown, width = fitting(_HEAD, widths_of([""] * len(_HEAD), cells), room(), ("asked",), "what", _SHORTEST)
        whats = (f"{cut(row['label'], width - len(_unit(row)))}{_unit(row)}" for row in rows_of)
        lines = [[what if at == 1 else line[at] for at in shown] for line, what in zip(cells, whats, strict=True)]
        tell_table(lines[0], lines[1:])


def _unit(row: dict[str, Any]) -> str:
    return f", {row['unit']}" if row["unit"] else ""


def _set(row: dict[str, Any]) -> str:
    """Return range and life of what is set; what is neither told nor done at once can be set alone."""
    if row["writer"] == "read only":
        return "read only"
    only = not row["told"] and row["kind"] != "momentary"
    return ", ".join(part for part in (_range(row), row["writer"], "not told" if only else "") if part)


def _range(row: dict[str, Any]) -> str:
    low, high, kind = row["low"], row["high"], row["kind"]
    if kind == "switch":
        return "on, off"
    if low is None and high is None:
        return ""
    if low is None:
        return f"up to {high:.4g}"
    return f"from {low:.4g}" if high is None else f"{low:.4g} to {high:.4g}"
