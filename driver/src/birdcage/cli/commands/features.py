"""`birdcage features`."""

from __future__ import annotations

from typing import Any

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted


@click.command("features", epilog=exits.EPILOG)
@global_options()
def command() -> None:
    """List what this dish tells besides its position, and what you may set.

    One line each: name, what it is, unit, range, and how it is set. `birdcage get NAME` reads it, `birdcage set NAME
    VALUE` sets it. until restart: the dish forgets it when it restarts. from power-up: it is saved, and counts from the
    next power-up on.

    If another birdcage program has the port, that one is asked. With a named firmware no port is opened.
    """
    from birdcage.cli.dish_features import list_features
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.table import tell_table

    told = list_features(wanted())
    rows = told["features"]
    if flags().json:
        tell_json(told)
    elif not rows:
        say("This dish tells its position only.")
    else:
        head = ("name", "what", "unit", "range", "set")
        tell_table(head, [(row["id"], row["label"], row["unit"] or "-", _range(row), _set(row)) for row in rows])


def _set(row: dict[str, Any]) -> str:
    """Return how it is set; what is neither told nor done at once can be set alone."""
    only = not row["told"] and row["kind"] != "momentary"
    return f"{row['writer']}, not told" if only else str(row["writer"])


def _range(row: dict[str, Any]) -> str:
    low, high, kind = row["low"], row["high"], row["kind"]
    if kind == "switch":
        return "on, off"
    if low is None and high is None:
        return "-"
    if low is None:
        return f"up to {high:.4g}"
    return f"from {low:.4g}" if high is None else f"{low:.4g} to {high:.4g}"
