"""Situations that pass searches got wrong: those of Skyfield's test_satellite_events.py (MIT), and more of the kind.

Skyfield's issues 559 and 996, and passes of eccentric orbits that it lists without their rise.
"""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from birdcage.sky.frames import posix_s, utc
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet, track

BOSTON = Observer(42.3581, -71.0636)
FORTNIGHT = datetime(2020, 1, 1, tzinfo=UTC), 14 * 24.0

# name, lines, place, (start, hours), mask, passes
SITUATIONS = {
    "low orbit": (
        "1 37820U 11053A   14314.79851609  .00064249  00000-0  44961-3 0  5637",
        "2 37820  42.7687 147.7173 0010686 283.6368 148.1694 15.73279710179072",
        BOSTON, (datetime(2014, 11, 10, tzinfo=UTC), 24.0), 20.0, 4,
    ),
    "three days, very eccentric": (
        "1 27540U 02048A   20007.25125384  .00001047  00000-0  00000+0 0  9992",
        "2 27540  51.8988 127.5680 8897013 285.8757   2.8911  0.37604578 17780",
        BOSTON, FORTNIGHT, 20.0, None,
    ),
    "transfer orbit": (
        "1 44802U 19080C   20010.68544515  .00001373  00000-0  27860-3 0  9997",
        "2 44802   5.1041 192.7327 7266711 217.6622  57.0965  2.30416801  1028",
        BOSTON, FORTNIGHT, 20.0, None,
    ),
    "geostationary, never up": (
        "1 35812U 09046A   20008.38785173 -.00000341 +00000-0 +00000-0 0  9999",
        "2 35812 000.0518 095.9882 0002721 218.8296 045.1595 01.00269700038098",
        BOSTON, FORTNIGHT, 20.0, 0,
    ),
    "low inclination, never up": (
        "1 28485U 04047A   20010.76403232 +.00000826 +00000-0 +25992-4 0  9999",
        "2 28485 020.5579 055.7027 0010957 208.9479 151.0347 15.04516653829549",
        BOSTON, FORTNIGHT, 20.0, 0,
    ),
    "polar": (
        "1 43477U 18047B   20011.66650462 +.00000719  00000-0 +29559-4 0    08",
        "2 43477  88.9974 159.0391 0019438 141.4770 316.8932 15.23958285 91199",
        BOSTON, FORTNIGHT, 20.0, 30,
    ),
    "a rise just before the highest point": (
        "1 00172U 19029BR  21063.59692852  .00001103  00000-0  33518-4 0  9998",
        "2 00172  53.0000  36.7036 0003481 299.7327  99.3331 15.05527065  1779",
        Observer(53.10373, 8.85132), (datetime(2021, 3, 3, 21, 36, tzinfo=UTC), 4.8), 25.0, 2,
    ),
    "sets only": (
        "1 39191U 13031D   21365.68950013 -.00000013  00000-0  00000-0 0  9995",
        "2 39191 000.0397 004.0913 0002586 278.0623 077.8173 05.00115674155430",
        Observer(-24.626331, -70.403964, 2369.34), (datetime(2022, 1, 2, 3, 15, tzinfo=UTC), 0.5), 30.0, 1,
    ),
    "rises only": (
        "1 41105U 15074A   24238.84268576 -.00000128  00000+0  00000+0 0  9993",
        "2 41105   5.0153  78.6193 0002491 153.4123  31.4253  1.00270890 31881",
        Observer(55.671429, 37.62539, 180.0), (datetime(2024, 8, 26, 8, 38, tzinfo=UTC), 5.0), 14.0, 1,
    ),
    "Molniya": (
        "1 08195U 75081A   06176.33215444  .00000099  00000-0  11873-3 0   813",
        "2 08195  64.1586 279.0717 6877146 264.7651  20.2257  2.00491383225656",
        BOSTON, (datetime(2006, 6, 25, tzinfo=UTC), 240.0), 0.0, None,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SITUATIONS)
def test_agrees_with_brute_force(agree, tle, name: str) -> None:
    line1, line2, place, (start, hours), mask_deg, passes = SITUATIONS[name]
    count = agree([tle(name, line1, line2)], place, start, hours, mask_deg)
    assert count == passes if passes is not None else count > 3


def test_a_geostationary_satellite_is_up_all_the_time(tle) -> None:
    anik = tle(
        "ANIK F1R",
        "1 28868U 05036A   20011.46493281 -.00000066  00000-0  00000+0 0  9999",
        "2 28868   0.0175  50.4632 0002403 284.1276 195.8977  1.00270824 52609",
    )
    start, hours = FORTNIGHT
    (only,) = search(Fleet([anik]), BOSTON, start, hours, 20.0)
    assert (only.already_up, only.still_up) == (True, True)
    assert (only.aos, only.los) == (start, start + timedelta(hours=hours))
    assert only.aos <= only.tca <= only.los
    assert 27.0 < only.max_elevation_deg < 30.0


def test_a_pass_close_to_the_start_is_all_there(tle) -> None:
    kanopus = tle(
        "KANOPUS",
        "1 38707U 12039A   24247.82317651  .00138984  00000-0  16635-2 0  9998",
        "2 38707  97.4945 189.8924 0007050 108.0286 252.1739 15.60479551673427",
    )
    start = datetime(2024, 9, 5, tzinfo=UTC)
    (only,) = search(Fleet([kanopus]), Observer(48.6622, 34.8862), start, 24.0, 70.0)
    told = [round((when - start).total_seconds()) for when in (only.aos, only.tca, only.los)]
    assert told == [32, 50, 68]
    assert not only.already_up


def test_a_rise_without_a_highest_point_is_highest_at_the_end(tle) -> None:
    line1, line2, place, (start, hours), mask_deg, _ = SITUATIONS["rises only"]
    (only,) = search(Fleet([tle("ELEKTRO-L", line1, line2)]), place, start, hours, mask_deg)
    assert only.tca == only.los == start + timedelta(hours=hours)
    assert (only.already_up, only.still_up) == (False, True)
    assert only.max_elevation_deg > 14.0


def test_grazing_passes_of_seconds_are_found(agree, orbits, start) -> None:
    """The mask is set a thousandth of a degree below the highest point of a pass, then above it."""
    place = Observer(47.0, 8.0)
    low = [one for one in orbits(24, 3) if one.mean_motion_rev_day > 12.0]
    grazed = 0
    for one in low:
        for found in list(search(Fleet([one]), place, start + timedelta(hours=1), 24.0))[:3]:
            if found.already_up or found.still_up:
                continue
            begin = found.tca - timedelta(minutes=6)
            below = agree([one], place, begin, 0.2, found.max_elevation_deg - 0.001)
            assert below == 1
            assert agree([one], place, begin, 0.2, found.max_elevation_deg + 0.001) == 0
            grazed += below
    assert grazed > 5


def test_a_dip_below_the_mask_parts_two_passes(agree, orbits, start) -> None:
    """Distant orbits may have several highest points; the mask is set just above the lowest point between them."""
    place = Observer(47.0, 8.0)
    t_s = posix_s(start) + np.arange(0.0, 86400.0, 30.0)
    parted = 0
    for one in orbits(40, 8):
        el = track(one, place, t_s).el_deg
        for low in np.flatnonzero((el[1:-1] < el[:-2]) & (el[1:-1] <= el[2:]) & (el[1:-1] > 3.0)) + 1:
            begin = utc(t_s[low]) - timedelta(hours=4.1)
            whole = agree([one], place, begin, 8.0, el[low] - 1e-3)
            assert agree([one], place, begin, 8.0, el[low] + 1e-4) == whole + 1
            parted += 1
    assert parted > 3
