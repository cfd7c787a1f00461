"""The demo's dish: where it stands, and what is known of it from the start."""

from __future__ import annotations

from birdcage.base.paths import Paths
from birdcage.station.turn_memory import DishAsLeft, leave

from birdcage_tui.shown.options import SitePlace

DEMO_FIRMWARE = "g2"
"""What the demo drives unless told otherwise, and what is spoken at first where nothing has told what the dish is."""
DEMO_PLACE = SitePlace(39.1, -95.7, "EM29, demo")
DEMO_CABLE_DEG, DEMO_EL_DEG = -211.0, 38.0
"""Where the demo's dish stands at first: a second of turning away from the pass that is under way then, which
is the same at any time of day (`birdcage.sky.demo_plan`), and far enough for its signal to rise."""
DEMO_DELAY_S = 0.5
"""How late its answers may be. It is in this program: nothing is under way from another one, and no wire is slow."""
DEMO_PARK = (180.0, 40.0)
"""True azimuth and elevation to which it goes after a pass."""


def demo_port(firmware: str, dish: str = "") -> str:
    """Return the simulated dish of the demo; by its id `dish` the receiver beside it finds it."""
    here = f"sim:{firmware}?lat={DEMO_PLACE.latitude_deg}&lon={DEMO_PLACE.longitude_deg}"
    # Other dishes count their azimuth from elsewhere, or have a cable that ends elsewhere: they stand as they come.
    stands = f"&az={DEMO_CABLE_DEG}&el={DEMO_EL_DEG}" if firmware == DEMO_FIRMWARE else ""
    return here + stands + (f"&id={dish}" if dish else "")


def name_demo(_port: str, number: int = 1) -> str:
    """Return the name under which a dish of the demo is remembered, in a folder that is gone afterwards."""
    return "demo" if number == 1 else f"demo {number}"


def remember_demo(paths: Paths, firmware: str, number: int = 1) -> None:
    """Let the demo begin as at the dish of somebody who has used it before: with a cable that was counted."""
    if firmware == DEMO_FIRMWARE:
        left = DishAsLeft(DEMO_CABLE_DEG, DEMO_CABLE_DEG % 360.0, DEMO_EL_DEG)
        leave(paths.state, name_demo("", number), firmware, left)
