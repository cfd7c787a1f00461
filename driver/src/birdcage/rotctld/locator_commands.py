"""The commands of Hamlib that compute and ask no dish: `L l D d E e B A a`."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from birdcage.rotctld import locator
from birdcage.rotctld.arguments import number
from birdcage.rotctld.client_context import ClientContext
from birdcage.rotctld.result import CommandResult, keyed
from birdcage.rotctld.rprt import RotctldError, Rprt

Computation = Callable[[Sequence[str]], CommandResult]


def computed(compute: Computation) -> Callable[[ClientContext, Sequence[str]], CommandResult]:
    """Make a command of a computation: a value that it can't take is EINVAL."""

    def call(_: ClientContext, arguments: Sequence[str]) -> CommandResult:
        try:
            return compute(arguments)
        except (ValueError, OverflowError) as error:
            raise RotctldError(Rprt.EINVAL, f"{' '.join(arguments)}: {error}.") from None

    return call


def lonlat2loc(arguments: Sequence[str]) -> CommandResult:
    """Tell the locator of a place; its length is rounded down to whole pairs."""
    lon_deg, lat_deg = map(number, arguments[:2])
    return keyed(("Locator",), locator.to_locator(lon_deg, lat_deg, int(arguments[2]) // 2))


def loc2lonlat(arguments: Sequence[str]) -> CommandResult:
    """Tell where the middle of a locator is."""
    lon_deg, lat_deg = locator.from_locator(arguments[0])
    return keyed(("Longitude", "Latitude"), f"{lon_deg:.6f}", f"{lat_deg:.6f}")


def dms2dec(arguments: Sequence[str]) -> CommandResult:
    """Tell decimal degrees; 1 as the last argument means south or west."""
    degrees, minutes, seconds = int(arguments[0]), int(arguments[1]), number(arguments[2])
    value_deg = locator.from_dms(degrees, minutes, seconds, negative=int(arguments[3]) == 1)
    return keyed(("Dec Degrees",), f"{value_deg:.6f}")


def dec2dms(arguments: Sequence[str]) -> CommandResult:
    """Tell degrees, minutes and seconds of decimal degrees."""
    degrees, minutes, seconds, negative = locator.to_dms(number(arguments[0]))
    keys = ("Degrees", "Minutes", "Seconds", "S/W")
    return keyed(keys, f"{degrees}", f"{minutes}", f"{seconds:.6f}", f"{negative:d}")


def dmmm2dec(arguments: Sequence[str]) -> CommandResult:
    """Tell decimal degrees of degrees and minutes. Hamlib 4.5.4 adds the flag as seconds, and so does this."""
    value_deg = locator.from_dms(int(arguments[0]), number(arguments[1]), 0.0, negative=False)
    return keyed(("Dec Deg",), f"{value_deg + int(arguments[2]) / 3600.0:.6f}")


def dec2dmmm(arguments: Sequence[str]) -> CommandResult:
    """Tell degrees and minutes of decimal degrees."""
    degrees, minutes, seconds, negative = locator.to_dms(number(arguments[0]))
    keys = ("Degrees", "Dec Minutes", "S/W")
    return keyed(keys, f"{degrees}", f"{minutes + seconds / 60.0:.6f}", f"{negative:d}")


def qrb(arguments: Sequence[str]) -> CommandResult:
    """Tell distance and bearing from one place to another."""
    km, bearing_deg = locator.distance_and_bearing(*map(number, arguments))
    return keyed(("QRB Distance", "QRB Azimuth"), f"{km:.6f}", f"{bearing_deg:.6f}")


def a_sp2a_lp(arguments: Sequence[str]) -> CommandResult:
    """Tell the bearing of the long way round, for one of the short way."""
    bearing_deg = number(arguments[0])
    if not 0.0 <= bearing_deg <= 360.0:
        raise ValueError("a bearing is 0 to 360")
    return keyed(("Long Path Deg",), f"{bearing_deg + (180.0 if bearing_deg < 180.0 else -180.0):.6f}")


def d_sp2d_lp(arguments: Sequence[str]) -> CommandResult:
    """Tell how long the long way round is."""
    return keyed(("Long Path km",), f"{locator.ROUND_THE_EARTH_KM - number(arguments[0]):.6f}")
