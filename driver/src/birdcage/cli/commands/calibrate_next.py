"""`birdcage calibrate next`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import NO_DISH, flags, global_options, wanted
from birdcage.cli.sky_options import at_option

if TYPE_CHECKING:
    from datetime import datetime

SHOWN = 8


@click.command("next", short_help="Suggest what to peak on next.", epilog=DATA_EPILOG)
@at_option("When.")
@click.option("--all", "every", is_flag=True, help=f"All that is up and in reach, not the best {SHOWN} alone.")
@global_options("firmware", "json", "config", "verbose", firmware=NO_DISH)
def next_(at: datetime | None, every: bool) -> None:
    """Name what to peak on next: what makes the pointing known best over the whole sky.

    Sun, Moon and geostationary places that are up, in reach and not known to be beyond the feed's hearing. RISE is the
    signal to expect. FOUND TO is how well a person finds its middle. SKY THEN is the error to expect over the whole
    sky afterwards. Elevations include refraction, as `tracking.refraction` sets it. No dish is needed.
    """
    from datetime import UTC, datetime

    from birdcage.calibration.next_best import enough
    from birdcage.calibration.peaks_file import load_peaks, peaks_file
    from birdcage.calibration.work import fit_for, proposals_for
    from birdcage.cli.calibrate_words import ENOUGH, proposal_values, tell_proposals
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.standing import limits_of

    dish = wanted()
    peaks = load_peaks(peaks_file(dish.paths))
    for problem in peaks.problems:
        say(problem)
    fitted = fit_for(dish.settings, peaks.entries)
    found = proposals_for(dish.settings, peaks.entries, at or datetime.now(UTC), limits_of(dish), fitted, dish.beam)
    shown = found if every else found[:SHOWN]
    refraction = dish.settings.tracking.refraction
    if flags().json:
        tell_json([proposal_values(each, refraction) for each in shown])
        return
    if not found:
        say("This feed can hear nothing in reach now that has no peak yet.")
        return
    tell_proposals(shown)
    say(f"Elevations include refraction ({refraction})." if refraction != "none" else "No refraction is included.")
    say(ENOUGH if enough(found) else f"Best: {found[0].candidate.name} {found[0].words()}.")
