"""What a G2 tells and lets be set besides its position: all that its menus tell (docs/reference/g2-commands.md)."""

from __future__ import annotations

from birdcage.protocol.g2.features_hardware import hardware
from birdcage.protocol.g2.features_motors import motors
from birdcage.protocol.g2.features_receiver import RECEIVER
from birdcage.protocol.g2.features_settings import SETTINGS_ROWS
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature import FeaturePage
from birdcage.rotator.feature_table import FeatureTable

CONSOLE_ONLY = {
    FeaturePage.MOTORS.value: (
        "Only in the console (F5): MOT> sd, motorboth and vms, which move the motors by themselves. MOT> w, which "
        "switches the protection of the cable off. MOT> sp and sw: no source tells their unit. STEP> p and v, which "
        "move beyond every limit."
    ),
    FeaturePage.RECEIVER.value: (
        "Only in the console (F5): DVB> e, srch, man, pwr and def change the tuner in ways that no source explains."
    ),
    FeaturePage.HARDWARE.value: "Only in the console (F5): GPIO> w and EE> inv and def, which can do lasting harm.",
}
"""What the faces leave to the raw console (docs/reference/g2-commands.md)."""


def features_of(azimuth: Axis, elevation: Axis) -> FeatureTable:
    """Return the table of a G2 with these axes, page by page; each command stands once, with all that it tells.

    Reading any of it changes nothing on the dish, but for what has a `read_hazard`. What needs an argument, switches
    something else or keeps the shell for long is a method of its menu (`G2Menus`).
    """
    return FeatureTable(*hardware(azimuth, elevation), *motors(azimuth, elevation), *RECEIVER, *SETTINGS_ROWS)
