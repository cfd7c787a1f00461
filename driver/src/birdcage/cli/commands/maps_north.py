"""`birdcage maps north`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.map_lesson import map_meant, refuse_demo
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from birdcage.base.paths import Paths
    from birdcage.skymap.arc_lesson import ArcLesson


@click.command("north", short_help="Propose north and tilt by the arc of satellites in a map.", epilog=DATA_EPILOG)
@click.argument("number", metavar="MAP", type=click.IntRange(1))
@click.option("--within", "within_deg", metavar="DEG", type=click.FloatRange(4.0, 180.0), default=180.0,
              help="North is off by no more than this.  [default: all round]")  # fmt: skip
@click.option("--calibrate", is_flag=True, help="Keep the slots that were found as peaks for `birdcage calibrate fit`.")
@global_options("config", "json", "firmware", "verbose")
def north(number: int, within_deg: float, calibrate: bool) -> None:
    """Propose north and tilt by the arc of satellites in MAP. Nothing is kept without --calibrate.

    You need not know which satellite is which. The known slots are fitted to the whole map, for every turn of the base
    and a tilt of up to 6°. It refuses a map with fewer than three satellites, and one that two ways to stand explain
    about equally well. The offset in elevation stays what it is: a map of the arc hardly tells it from a tilt.
    """
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.skymap.arc_lesson import in_use

    meant, paths = map_meant(number)
    found = meant.north(within_deg)
    if flags().json:
        tell_json(_values(found, demo=meant.sky_map.demo))
    else:
        for line in _lines(found, in_use(meant.sky_map).az_offset_deg):
            tell(line)
    if calibrate:
        refuse_demo(meant, paths)
        say(_keep(found, paths))


def _keep(found: ArcLesson, paths: Paths) -> str:
    from birdcage.calibration.map_peaks import peaks_of_map
    from birdcage.calibration.peaks_file import add_peak, peaks_file

    kept = [add_peak(peaks_file(paths), peak) for peak in peaks_of_map(found)]
    if not kept:
        return "The map does not tell when it was made, so nothing was kept."
    numbers = f"{kept[0].number} to {kept[-1].number}"
    return f"Kept {len(kept)} peaks for the calibration, {numbers}: `birdcage calibrate fit`."


def _lines(found: ArcLesson, now_deg: float) -> list[str]:
    lines = []
    for each in found.slots:
        beside = f", measured with {', '.join(each.beside)}" if each.beside else ""
        dish = f"dish {each.dish_az_deg:6.2f}° {each.dish_el_deg:5.2f}° ±{each.sigma_deg:.2f}°"
        lines.append(
            f"{each.seen.slot.label:>7}  {dish}, true {each.seen.az_deg:6.2f}° {each.seen.el_deg:5.2f}°{beside}"
        )
    stands, (turn, to_north, to_west) = found.alignment, found.sigmas_deg
    offset = f"{_signed(stands.az_offset_deg):+.2f}° ±{turn:.2f}°"
    leans = f"{stands.an_deg:+.2f}° ±{to_north:.2f}° to the north, {stands.aw_deg:+.2f}° ±{to_west:.2f}° to the west"
    return [
        *lines,
        f"North  azimuth offset {offset}, where the map was made with {_signed(now_deg):+.2f}°",
        f"Tilt   {math.hypot(stands.an_deg, stands.aw_deg):.2f}°: {leans}",
    ]


def _signed(angle_deg: float) -> float:
    from birdcage.base.geometry import shortest_turn

    return shortest_turn(0.0, angle_deg)


def _values(found: ArcLesson, *, demo: bool) -> dict[str, object]:
    stands, (turn, to_north, to_west) = found.alignment, found.sigmas_deg
    return {
        "az_offset_deg": round(_signed(stands.az_offset_deg), 3), "az_offset_sigma_deg": round(turn, 3),
        "an_deg": round(stands.an_deg, 3), "an_sigma_deg": round(to_north, 3),
        "aw_deg": round(stands.aw_deg, 3), "aw_sigma_deg": round(to_west, 3),
        "el_offset_deg": round(stands.el_offset_deg, 3), "ca_deg": round(stands.ca_deg, 3),
        "explained": round(found.explained, 3),
        "runner_up": None if math.isinf(found.runner_up) else round(found.runner_up, 2),
        "slots": [
            {
                "slot": each.seen.slot.label, "true_az_deg": round(each.seen.az_deg, 3),
                "true_el_deg": round(each.seen.el_deg, 3), "dish_az_deg": round(each.dish_az_deg, 3),
                "dish_el_deg": round(each.dish_el_deg, 3), "sigma_deg": round(each.sigma_deg, 3),
                "with": list(each.beside),
            }
            for each in found.slots
        ],
        "demo": demo,
    }  # fmt: skip
