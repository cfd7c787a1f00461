"""`birdcage maps drift`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import find_paths, flags, global_options

if TYPE_CHECKING:
    from birdcage.skymap.drift import Drift


@click.command("drift", short_help="Show how gain and pointing changed while a map was made.", epilog=DATA_EPILOG)
@click.argument("number", metavar="MAP", type=click.IntRange(1))
@global_options("config", "json", "verbose")
def drift(number: int) -> None:
    """Show how gain and pointing changed while MAP was made, by its reference crosses.

    Gain is in parts of that of the first cross, in decibels for a map in decibels. The source is at rest: where it
    seems to have moved to the right, the dish looks to the left of where it did. `birdcage export --without-drift`
    takes the change of gain out. Pointing is not corrected: a dish that has lost steps must be homed.
    """
    from birdcage.cli.say import iso, say, tell_json
    from birdcage.cli.table import tell_table
    from birdcage.skymap.drift import crosses_in, drift_of
    from birdcage.skymap.map_file import read_map

    sky_map = read_map(find_paths().signal_recordings, number)
    made = crosses_in(sky_map.crosses, decibels=sky_map.decibels)
    changes = drift_of(made, decibels=sky_map.decibels)
    if flags().json:
        tell_json([
            {"utc": iso(each.utc), "gain": each.gain, "floor": each.floor, "right_deg": each.right_deg,
             "up_deg": each.up_deg, "sigma_deg": each.sigma_deg, "lost_steps": each.lost_steps}
            for each in changes
        ])  # fmt: skip
        return
    if not made:
        say(f"Map {number} has no reference cross. `birdcage scan --reference 119W` makes them.")
    elif not changes:
        say(f"No source stands out of the {len(made)} reference crosses of map {number}.")
    else:
        unit = "dB" if sky_map.decibels else ""
        tell_table(("time", "gain", "right", "up", "±", ""), [_row(each, unit) for each in changes], "")
        if any(each.lost_steps for each in changes):
            say("The dish points elsewhere than it says: it has lost steps, or was moved. Home it.")


def _row(each: Drift, unit: str) -> tuple[str, ...]:
    gain = f"{each.gain:+.2f} {unit}" if unit else f"{each.gain:.3f}"
    lost = "lost steps" if each.lost_steps else ""
    return (f"{each.utc:%Y-%m-%d %H:%M:%S}Z", gain, f"{each.right_deg:+.2f}°", f"{each.up_deg:+.2f}°",
            f"{each.sigma_deg:.2f}°", lost)  # fmt: skip
