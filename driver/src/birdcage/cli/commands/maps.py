"""`birdcage maps`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.commands.maps_horizon import horizon
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
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.skymap.map_file import list_maps

    maps = list_maps(find_paths().signal_recordings)
    if flags().json:
        tell_json([_values(each) for each in maps])
        return
    if not maps:
        say("No map was made yet.")
    for each in maps:
        span = "" if each.low is None or each.high is None else f"  {each.low:.4g} to {each.high:.4g} {each.unit}"
        demo = "  DEMO" if each.demo else ""
        heard = f"{each.heard} of {each.plan.cells}"
        tell(f"{each.number:4}  {each.begun:%Y-%m-%d %H:%M}Z  {each.source:10} {heard:>13}{span}{demo}")


def _values(head: MapHead) -> dict[str, object]:
    from birdcage.cli.say import iso

    return {
        "number": head.number, "begun": iso(head.begun), "ended": iso(head.ended), **head.plan.values(),
        "source": head.source, "unit": head.unit, "demo": head.demo, "heard": head.heard, "of": head.plan.cells,
        "low": head.low, "high": head.high,
    }  # fmt: skip


command.add_command(horizon)
