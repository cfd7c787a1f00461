"""A pass over the station in a straight line: enough for a Doppler curve with the steep middle of a real one."""

from __future__ import annotations

import math

from birdcage.radio.tuning import Tuning

SPEED_KM_S = 7.4
DISTANCE_KM = 850.0
LIGHT_KM_S = 299_792.458


def passing(start_s, *, length_s=600.0, downlink_hz=1_701_300_000.0, lo_hz=0.0, name="METEOR-M2 4"):
    def shift_hz(at_s):
        along_km = SPEED_KM_S * (at_s - start_s - length_s / 2)
        return -downlink_hz * SPEED_KM_S * along_km / math.hypot(along_km, DISTANCE_KM) / LIGHT_KM_S

    return Tuning(name, downlink_hz, shift_hz, start_s, start_s + length_s, lo_hz)
