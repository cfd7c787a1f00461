"""`birdcage rssi`."""

from __future__ import annotations

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.source_option import heard_by, source_option


@click.command("rssi", epilog=exits.EPILOG)
@click.option("--count", metavar="N", type=click.IntRange(min=1), help="End after so many readings.")
@click.option("--seconds", metavar="S", type=click.FloatRange(min=0.1), help="End after so long.")
@click.option("--record", is_flag=True, help="Keep all readings too: `birdcage recordings` lists them.")
@source_option
@global_options()
def command(count: int | None, seconds: float | None, source: str | None, record: bool) -> None:
    """Print the signal strength, a line each reading, as often as its source tells it. Moves nothing.

    The source is the one of the mounted feed, or the one that --source names. The dish's own tuner is read while the
    dish rests. If another birdcage program has the port, that one reads the tuner. Ctrl+C ends it; mean, scatter and
    the direction of the strongest signal follow on stderr. With --json each line is one object.
    """
    from birdcage.cli.rssi_run import print_readings

    wants = wanted()
    by = heard_by(source, wants.settings)
    print_readings(wants, by, count=count, seconds=seconds, record=record, as_json=flags().json)
