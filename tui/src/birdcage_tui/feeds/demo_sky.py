"""The demo's sky: made-up orbits over its place, laid once into a catalogue that is thrown away afterwards."""

from __future__ import annotations

import threading
from datetime import datetime
from pathlib import Path

from birdcage.sky.observer import Observer

FAVOURITES = ("LEO 1 ", "LEO 2 ", "LEO 5 ", "LEO 6 ", "LEO 10 ", "LEO 12 ")
_laying = threading.Lock()


def lay_demo_sky(path: Path, now: datetime, observer: Observer | None) -> None:
    """Fill the catalogue unless that was done: whoever needs it first lays it, on its own thread."""
    from birdcage.sky.catalogue import Catalogue
    from birdcage.sky.demo_orbits import demo_orbits

    if observer is None:
        return
    with _laying:
        if path.exists():
            return
        elements = demo_orbits(now, observer)
        with Catalogue(path) as catalogue:
            catalogue.add(elements, group="demo", fetched=now)
            for one in elements:
                if any(mark in f"{one.name} " for mark in FAVOURITES):
                    catalogue.set_favourite(one.norad_id)
