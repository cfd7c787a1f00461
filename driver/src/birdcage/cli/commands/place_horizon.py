"""`birdcage place horizon`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from birdcage.base.reason import Reason
from birdcage.cli.exits import DATA_EPILOG, EPILOG
from birdcage.cli.options import find_paths, flags, global_options, load_settings
from birdcage.cli.sky_options import NEGATIVE_NUMBERS

if TYPE_CHECKING:
    from birdcage.sky.horizon import HorizonMask


@click.group("horizon", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def horizon() -> None:
    """Keep the line of trees and roofs at the active place. It tells what is heard; it refuses no motion."""


@horizon.command("show", short_help="Print its points.", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def show() -> None:
    """Print its points, azimuth and elevation a line, as `import` reads them."""
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.sky.horizon import HorizonMask
    from birdcage.sky.horizon_file import write_horizon

    mask = HorizonMask(load_settings(find_paths()).place.horizon)
    if flags().json:
        tell_json([list(point) for point in mask.points])
    elif mask:
        tell(write_horizon(mask).rstrip())
    else:
        say("The horizon is flat: it has no points.")


@horizon.command("import", epilog=DATA_EPILOG)
@click.argument("file", type=click.Path(path_type=Path))
@global_options("config", "json", "verbose")
def import_(file: Path) -> None:
    """Take the horizon from FILE, in place of the one before.

    One point a line: azimuth and elevation in true degrees, `#` for remarks (Stellarium's list). The table that PVGIS
    prints is read too, and heights alone: the first one north, then clockwise.
    """
    from birdcage.cli.place_words import read_mask

    _keep(read_mask(file))


@horizon.command("add", epilog=DATA_EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("az_deg", type=click.FloatRange(-360.0, 360.0))
@click.argument("el_deg", type=click.FloatRange(-90.0, 90.0))
@global_options("config", "json", "verbose")
def add(az_deg: float, el_deg: float) -> None:
    """Add one point, or measure the one at that azimuth again."""
    from birdcage.sky.horizon import HorizonMask

    _keep(HorizonMask(load_settings(find_paths()).place.horizon).insert(az_deg, el_deg))


@horizon.command("record", short_help="Add the point at which the dish looks now.", epilog=EPILOG)
@global_options()
def record() -> None:
    """Add the point at which the dish looks now: jog it along the tree line, and record at each corner.

    The dish is asked where it points, and not moved.
    """
    from birdcage.base.errors import PositionUnknown
    from birdcage.cli.dish import how_to_home, open_dish
    from birdcage.cli.options import wanted
    from birdcage.sky.horizon import HorizonMask

    with open_dish(wanted(), survey=False) as dish:
        state = dish.come_up(15.0)
    position = state.position
    if position is None or state.position_lost is not None:
        raise PositionUnknown(f"The dish does not know where it points. {how_to_home(state)}", reason=Reason.UNHOMED)
    if not abs(position.el_deg) <= 90.0:
        raise PositionUnknown(f"Elevation {position.el_deg:.2f}° is beyond the zenith. Point the dish at the horizon.")
    _keep(HorizonMask(load_settings(find_paths()).place.horizon).insert(position.az_deg, position.el_deg))


@horizon.command("clear", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def clear() -> None:
    """Take all points away: a flat horizon."""
    from birdcage.sky.horizon import HorizonMask

    _keep(HorizonMask())


def _keep(mask: HorizonMask) -> None:
    """Write it into `[place]`, and to the saved place where that is the one in use."""
    from birdcage.base.places import keep_horizon
    from birdcage.cli.say import say
    from birdcage.sky.horizon import horizon_words

    paths = find_paths()
    saved = keep_horizon(paths, load_settings(paths).place, mask.points)
    say(f"Kept for {saved or 'this place'}: {horizon_words(mask.points)}.")
