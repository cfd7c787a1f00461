"""`birdcage craft`."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG, NOT_DONE
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from collections.abc import Sequence

    from birdcage.sky.update.craft import Craft


@click.group("craft", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def command() -> None:
    """Ask a prediction server, if you have one: BIRDCAGE_CRAFT_URL, or elements.craft_url in birdcage.toml.

    It computes for its own place, not for yours, and birdcage never follows it: `birdcage passes` needs no network.
    Whether its angles include refraction is up to that server.
    """


@command.command("search", epilog=DATA_EPILOG)
@click.argument("text")
@click.option("--limit", type=click.IntRange(min=1), default=20, show_default=True, help="How many at most.")
@global_options("config", "json", "verbose")
@click.pass_context
def search(context: click.Context, text: str, limit: int) -> None:
    """Find satellites by name."""
    found = _service().search(text, limit)
    _tell(context, found, ("name", "target_type", "target_id", "elevation_deg", "groups"))


@command.command("up", epilog=DATA_EPILOG)
@click.option("--min-elevation", type=click.FloatRange(-90.0, 90.0), default=0.0, show_default=True, help="In degrees.")
@global_options("config", "json", "verbose")
@click.pass_context
def up(context: click.Context, min_elevation: float) -> None:
    """List what is up now."""
    found = _service().up(min_elevation)
    _tell(context, found, ("name", "target_type", "target_id", "azimuth_deg", "elevation_deg", "range_km"))


@command.command("passes", epilog=DATA_EPILOG)
@click.argument("satellite")
@click.option("--hours", type=click.FloatRange(0.0, 240.0), default=24.0, show_default=True, help="How far ahead.")
@click.option("--next", "only_next", is_flag=True, help="Only the next one.")
@global_options("config", "json", "verbose")
@click.pass_context
def passes(context: click.Context, satellite: str, hours: float, only_next: bool) -> None:
    """List the passes of a satellite."""
    service = _service()
    first = service.next_pass(satellite) if only_next else None
    found = (() if first is None else (first,)) if only_next else service.passes(satellite, hours)
    _tell(context, found, ("name", "norad_id", "aos", "tca", "los", "max_elevation_deg"))


def _service() -> Craft:
    from birdcage.base.errors import ConfigError
    from birdcage.cli.commands.elements_common import elements_settings
    from birdcage.sky.update.craft import Craft

    url = elements_settings().craft_url
    if url is None:
        raise ConfigError("No prediction server is set. BIRDCAGE_CRAFT_URL names one. `birdcage passes` needs none.")
    return Craft(url)


def _tell(context: click.Context, found: Sequence[object], columns: Sequence[str]) -> None:
    from dataclasses import fields

    from birdcage.cli.say import iso, say, tell_json
    from birdcage.cli.table import tell_table

    def plain(value: object) -> object:
        return iso(value) if isinstance(value, datetime) else value

    if flags().json:
        tell_json(
            [{each.name: plain(getattr(row, each.name)) for each in fields(row)} for row in found]  # type: ignore[arg-type]
        )
    elif found:
        head = [column.removesuffix("_deg").replace("_", " ").upper() for column in columns]
        tell_table(head, [[_shown(getattr(row, column)) for column in columns] for row in found])
    if not found:
        say("It knows of none.")
        context.exit(NOT_DONE)


def _shown(value: object) -> str:
    if value is None:
        return "-"
    if isinstance(value, datetime):
        return f"{value:%Y-%m-%d %H:%M:%S}"
    if isinstance(value, tuple):
        return " ".join(map(str, value)) or "-"
    return f"{value:.1f}" if isinstance(value, float) else str(value)
