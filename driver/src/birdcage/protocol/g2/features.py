"""What a G2 tells and lets be set besides its position: all that its menus tell (docs/reference/g2-commands.md)."""

from __future__ import annotations

from birdcage.protocol.g2.features_hardware import hardware
from birdcage.protocol.g2.features_motors import motors
from birdcage.protocol.g2.features_receiver import RECEIVER
from birdcage.protocol.g2.features_settings import SETTINGS_ROWS
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature_table import FeatureTable


def features_of(azimuth: Axis, elevation: Axis) -> FeatureTable:
    """Return the table of a G2 with these axes, page by page; each command stands once, with all that it tells.

    Reading any of it changes nothing on the dish, but for what has a `read_hazard`. What needs an argument, switches
    something else or keeps the shell for long is a method of its menu (`G2Menus`).
    """
    return FeatureTable(*hardware(azimuth, elevation), *motors(azimuth, elevation), *RECEIVER, *SETTINGS_ROWS)
