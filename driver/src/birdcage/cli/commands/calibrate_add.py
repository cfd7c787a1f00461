"""`birdcage calibrate add`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.base.reason import Reason
from birdcage.cli.exits import EPILOG
from birdcage.cli.options import Wanted, flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, at_option, no_options_among

if TYPE_CHECKING:
    from datetime import datetime

    from birdcage.station.state import Pointing


@click.command("add", short_help="Take a peak.", epilog=EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1, required=True)
@click.option("--dish-az", "dish_az_deg", type=click.FloatRange(-720.0, 720.0), metavar="DEG",
              help="What the dish read, in its own degrees.  [default: the dish is asked]")  # fmt: skip
@click.option("--dish-el", "dish_el_deg", type=click.FloatRange(-90.0, 180.0), metavar="DEG", help="The same.")
@at_option("When that was.")
@click.option("--sigma", "sigma_deg", type=click.FloatRange(0.001, 45.0), metavar="DEG",
              help="How well it was peaked.  [default: by the signal to expect]")  # fmt: skip
@global_options()
def add(
    target: tuple[str, ...], dish_az_deg: float | None, dish_el_deg: float | None, at: datetime | None,
    sigma_deg: float | None,
) -> None:  # fmt: skip
    """Take a peak: the dish is on TARGET now, or was with these readings.

    TARGET is named as for `birdcage where`. The dish does not move.
    """
    from birdcage.calibration.guide import peak_at
    from birdcage.calibration.peaks_file import add_peak, peaks_file
    from birdcage.cli.calibrate_words import peak_values
    from birdcage.cli.named_target import find_target
    from birdcage.cli.say import say, tell_json

    no_options_among(target)
    if (dish_az_deg is None) != (dish_el_deg is None):
        raise click.UsageError("--dish-az and --dish-el go together.")
    if at is not None and dish_az_deg is None:
        raise click.UsageError("--at goes with --dish-az and --dish-el: the dish tells where it is now.")
    dish = wanted()
    meant = find_target(target, dish.paths, None, say).target
    if dish_az_deg is not None and dish_el_deg is not None:
        position = _typed(dish_az_deg, dish_el_deg, at)
    else:
        position = _asked(dish)
    peak = add_peak(peaks_file(dish.paths), peak_at(dish.settings, meant, position, sigma_deg, dish.beam))
    if flags().json:
        tell_json(peak_values(peak))
    else:
        say(
            f"Peak {peak.number}: {peak.target} at {peak.true_az_deg:.2f}° / {peak.true_el_deg:.2f}°, the dish at "
            f"{peak.dish_az_deg:.2f}° / {peak.dish_el_deg:.2f}°, good to {peak.sigma_deg:.2f}°."
        )
    if peak.true_el_deg <= 0.0:
        say(f"{peak.target} stands below the horizon at that time: `birdcage calibrate remove {peak.number}`.")


def _typed(az_deg: float, el_deg: float, at: datetime | None) -> Pointing:
    from datetime import UTC, datetime

    from birdcage.station.state import Pointing

    return Pointing(az_deg, el_deg, az_deg, el_deg, 0.0, at or datetime.now(UTC))


def _asked(wanted: Wanted) -> Pointing:
    from birdcage.base.errors import PositionUnknown
    from birdcage.cli.dish import how_to_home, open_dish

    with open_dish(wanted, survey=False) as dish:
        state = dish.come_up(15.0)
    if state.position is None or state.position_lost is not None:
        raise PositionUnknown(
            f"The dish does not know where it points, so the peak is not taken. {how_to_home(state)}",
            reason=Reason.UNHOMED,
        )
    return state.position
