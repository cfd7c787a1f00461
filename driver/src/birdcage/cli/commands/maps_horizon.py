"""`birdcage maps horizon`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.map_lesson import map_meant, refuse_demo
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from birdcage.base.config.sections import PlaceSettings
    from birdcage.base.paths import Paths
    from birdcage.skymap.horizon_lesson import HorizonProposal


@click.command("horizon", short_help="Propose the line of trees and roofs that a map shows.", epilog=DATA_EPILOG)
@click.argument("number", metavar="MAP", type=click.IntRange(1))
@click.option("--accept", metavar="all|AZ,AZ…", help="Put these points into the horizon of the active place.")
@global_options("config", "json", "firmware", "verbose")
def horizon(number: int, accept: str | None) -> None:
    """Propose the line of trees and roofs that MAP shows. Nothing is kept without --accept.

    Trees are as warm as the ground, and the sky above them is cold. Each point says how sure it is. A direction that is
    clear lowers the horizon you have, and never raises it. --accept takes the points at these azimuths; all others stay
    as they are in the horizon of the place.
    """
    from birdcage.cli.say import say, tell, tell_json

    meant, paths = map_meant(number)
    found = meant.horizon()
    if flags().json:
        tell_json(_values(found, demo=meant.sky_map.demo))
    else:
        for point in found.points:
            words = "clear down to here" if point.is_clear else f"±{point.sigma_deg:.1f}°"
            tell(f"{point.az_deg:7.2f} {point.el_deg:6.2f}  {words}")
        if not meant.is_place_known:
            say("No place is known, so satellites near the trees can't be told from them.")
    if accept is not None:
        refuse_demo(meant, paths)
        _keep(found, accept, meant.settings.place, paths)


def _keep(found: HorizonProposal, accept: str, place: PlaceSettings, paths: Paths) -> None:
    from birdcage.base.places import keep_horizon
    from birdcage.cli.say import say
    from birdcage.sky.horizon import HorizonMask, horizon_words
    from birdcage.skymap.horizon_accepted import chosen_by, with_accepted

    chosen = list(range(len(found.points)))
    if accept.casefold() != "all":
        try:
            chosen = chosen_by(found.points, [float(each) for each in accept.split(",")])
        except ValueError:
            raise click.UsageError(f"{accept!r} is no list of azimuths. Type all, or 160,175.5.") from None
        except LookupError as wrong:
            raise click.UsageError(str(wrong)) from None
    mask = with_accepted(HorizonMask(place.horizon), found.points, chosen)
    saved = keep_horizon(paths, place, mask.points)
    say(f"Kept for {saved or 'this place'}: {horizon_words(mask.points)}.")


def _values(found: HorizonProposal, *, demo: bool) -> dict[str, object]:
    return {
        "points": [
            {"az_deg": each.az_deg, "el_deg": round(each.el_deg, 2), "sigma_deg": round(each.sigma_deg, 2),
             "clear": each.is_clear}
            for each in found.points
        ],
        "rise": round(found.rise, 3), "unit": "ratio of powers" if found.in_powers else "counts",
        "unknown_azimuths": found.unknown, "demo": demo,
    }  # fmt: skip
