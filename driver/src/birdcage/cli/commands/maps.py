"""`birdcage maps`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.commands.maps_beam import beam
from birdcage.cli.commands.maps_drift import drift
from birdcage.cli.commands.maps_horizon import horizon
from birdcage.cli.commands.maps_north import north
from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import find_paths, flags, global_options

if TYPE_CHECKING:
    from birdcage.skymap.map_file import MapHead


@click.group("maps", epilog=DATA_EPILOG, invoke_without_command=True)
@click.pass_context
@global_options("config", "json", "verbose")
def command(context: click.Context) -> None:
    """List maps of the sky; with more words, see what one teaches."""
    if context.invoked_subcommand is None:
        _list()


def _list() -> None:
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.table import tell_table
    from birdcage.skymap.map_file import list_maps

    maps = list_maps(find_paths().signal_recordings)
    if flags().json:
        tell_json([_values(each) for each in maps])
        return
    if not maps:
        say("No map was made yet.")
        return
    tell_table(("map", "begun", "region", "step", "heard", "source", "level", ""), [_row(each) for each in maps], "r")


def _row(head: MapHead) -> tuple[str, ...]:
    from birdcage.skymap.sky_map import region_words

    plan = head.plan
    level = "-" if head.low is None or head.high is None else f"{head.low:.4g} to {head.high:.4g} {head.unit}"
    return (
        str(head.number), f"{head.begun:%Y-%m-%d %H:%M:%S}Z", region_words(plan, head.about), f"{plan.step_deg:g}°",
        f"{head.heard} of {plan.cells}", head.source, level, "DEMO" if head.demo else "",
    )  # fmt: skip


def _values(head: MapHead) -> dict[str, object]:
    from birdcage.cli.say import iso

    return {
        "number": head.number, "begun": iso(head.begun), "ended": iso(head.ended), **head.plan.values(),
        "source": head.source, "unit": head.unit, "demo": head.demo, "heard": head.heard, "of": head.plan.cells,
        "low": head.low, "high": head.high, "target": head.about.get("target"),
    }  # fmt: skip


command.add_command(horizon)
command.add_command(beam)
command.add_command(drift)
command.add_command(north)
