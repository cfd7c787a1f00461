"""The demo's receiver: a simulated one beside its dish, and made-up carriers of its low satellites to be heard.

All of it lies in the demo's throw-away folder. What a carrier is like depends on where the dish stands, so it is worked
out for the place of the demo whatever place is set later: the simulated dish does not move house.
"""

from __future__ import annotations

import json
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlencode

if TYPE_CHECKING:
    from birdcage.base.paths import Paths
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.observer import Observer

LO_HZ = 11.25e9
"""Of the stock feed: the receiver is tuned below 1.5 GHz, as a real one behind such a converter is."""
PASSBAND_HZ = 50_000.0
"""At 20 times the speed the Doppler of a low satellite goes 11 kHz between two words to the receiver."""
FIRST_MHZ, STEP_MHZ = 12_210.0, 10.0
"""Carrier of the first satellite, and from each to the next: inside of what the stock feed hears."""
LEVEL_DB = -38.0
"""What the receiver tells of a satellite at 1000 km in the middle of the beam."""
HOURS = 12.0
"""So far ahead carriers are laid: in a demo that runs longer nothing is heard any more."""
COARSE_S, FINE_S = 60.0, 10.0
"""Between two looks at where a satellite is up, and between two rows of a carrier."""
MARK = "DEMO LEO "
"""How the names of low satellites of the demo begin."""


def radio_flags(paths: Paths, dish: str) -> dict[str, object]:
    """Return the settings of the receiver beside the simulated dish with this id."""
    return {"radio.rigctld": _address(paths, dish), "radio.strength": True, "radio.lo_hz": LO_HZ}


def _address(paths: Paths, dish: str) -> str:
    options = {"dish": dish, "beacons": str(beacons_file(paths.catalogue)), "lo_hz": f"{LO_HZ:.0f}",
               "passband_hz": f"{PASSBAND_HZ:.0f}"}  # fmt: skip
    return f"sim:rig?{urlencode(options)}"


def beacons_file(catalogue: Path) -> Path:
    """Return where the carriers are kept: beside the catalogue."""
    return catalogue.parent / "beacons.json"


def write_downlinks(paths: Paths) -> None:
    """Write which frequency each of the low satellites sends on, as a person's own table has it."""
    from birdcage.sky.demo_plan import LOW

    paths.downlinks_file.parent.mkdir(parents=True, exist_ok=True)
    paths.downlinks_file.write_text(
        "\n".join(
            f'[[downlink]]\nsatellite = "{MARK}{number} {one.kind}"\nfreq_mhz = {_carrier_mhz(number):.1f}\n'
            f'mode = "carrier"\nalive = true\nsource = "DEMO: made up"\n'
            for number, one in enumerate(LOW, 1)
        ),
        encoding="utf-8",
    )


def _carrier_mhz(number: int) -> float:
    return FIRST_MHZ + STEP_MHZ * (number - 1)


def lay_beacons(catalogue: Path, now: datetime, observer: Observer | None) -> None:
    """Write the way of every low satellite of the demo's catalogue over the sky, with its level and Doppler.

    A tenth of a second: not for the app's own thread.
    """
    from birdcage.sky.catalogue import Catalogue

    if observer is None or not catalogue.exists():
        return
    with Catalogue(catalogue) as opened:
        low = {one.elements.name: one.elements for one in opened.entries() if one.elements.name.startswith(MARK)}
    begin_s, beacons = now.timestamp(), []
    for name, elements in low.items():
        frequency_hz = _carrier_mhz(int(name.removeprefix(MARK).split()[0])) * 1e6
        rows = _rows(elements, frequency_hz, begin_s, observer)
        beacons.append({"name": name, "frequency_hz": frequency_hz, "rows": rows})
    file = beacons_file(catalogue)
    aside = file.with_suffix(".new")
    try:
        aside.write_text(json.dumps({"beacons": beacons}), encoding="utf-8")
        aside.replace(file)
    except FileNotFoundError:
        return  # the demo has ended meanwhile, and its folder is gone


def _rows(one: ElementSet, frequency_hz: float, begin_s: float, observer: Observer) -> list[list[float]]:
    import numpy as np
    from birdcage.sky.doppler import doppler_hz
    from birdcage.sky.propagate import track
    from birdcage.tracking.planning.refraction import lift_deg

    coarse = begin_s + np.arange(-COARSE_S, HOURS * 3600.0, COARSE_S)
    up = track(one, observer, coarse).el_deg > -1.0
    near = up.copy()
    near[1:] |= up[:-1]
    near[:-1] |= up[1:]
    times = (coarse[near][:, None] + np.arange(0.0, COARSE_S, FINE_S)).ravel()
    if not len(times):
        return []
    way = track(one, observer, times)
    el_deg = way.el_deg + lift_deg(way.el_deg)
    level_db = LEVEL_DB - 20.0 * np.log10(way.range_km / 1000.0)
    return [
        [round(at_s, 3), round(az, 3), round(el, 3), round(level, 2), round(doppler_hz(frequency_hz, rate), 1)]
        for at_s, az, el, level, rate in zip(
            *(each.tolist() for each in (times, way.az_deg, el_deg, level_db, way.range_rate_km_s)), strict=True
        )
        if el > 0.0
    ]
