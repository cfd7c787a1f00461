"""`birdcage recordings`."""

from __future__ import annotations

import click

from birdcage.cli import exits
from birdcage.cli.options import find_paths, flags, global_options


@click.command("recordings", epilog=exits.EPILOG)
@click.option("--csv", "csv_number", type=click.IntRange(1), metavar="NUMBER", help="Print all readings of one as CSV.")
@global_options("config", "json", "verbose")
def command(csv_number: int | None) -> None:
    """List the recordings of the signal. `r` on F3 and `birdcage rssi --record` make them.

    A recording holds time, direction, value, SNR, lock and polarisation of each reading. The oldest recordings give way
    once the file holds two million readings.
    """
    from birdcage.cli.say import iso, say, tell, tell_json
    from birdcage.signal.recordings import csv_lines, list_recordings, read_recording

    path = find_paths().signal_recordings
    recordings = list_recordings(path)
    if csv_number is not None:
        named = next((each for each in recordings if each.number == csv_number), None)
        if named is None:
            raise click.UsageError(f"There is no recording {csv_number}. `birdcage recordings` lists them.")
        for line in csv_lines(named, read_recording(path, csv_number)):
            tell(line)
        return
    if flags().json:
        tell_json({
            "recordings": [
                {
                    "number": each.number, "begun": iso(each.begun),
                    "ended": None if each.ended is None else iso(each.ended),
                    "source": each.source, "unit": each.unit, "settings": each.settings, "demo": each.demo,
                    "targets": each.targets, "readings": each.readings, "low": each.low, "high": each.high,
                }
                for each in recordings
            ]
        })  # fmt: skip
        return
    if not recordings:
        say("Nothing recorded yet. `r` on F3 and `birdcage rssi --record` record the signal.")
    for each in recordings:
        span = "" if each.low is None or each.high is None else f"  {each.low:.4g} to {each.high:.4g} {each.unit}"
        demo = "  DEMO" if each.demo else ""
        targets = f"  {', '.join(each.targets)}" if each.targets else ""
        began = f"{each.begun:%Y-%m-%d %H:%M:%S}Z"
        tell(f"{each.number:4}  {began}  {each.source:10} {each.readings:8} readings{span}{targets}{demo}")
