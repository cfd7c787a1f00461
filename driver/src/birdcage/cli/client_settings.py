"""What to tell Gpredict and SatNOGS of this server, in the form of their own settings."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.errors import ConfigError, MotionRefused
from birdcage.base.reason import Reason
from birdcage.cli.attached_command import attach_to_owner
from birdcage.station.facts_file import FactsFile
from birdcage.station.known import list_firmwares, model_of
from birdcage.station.reach_limits import reach_limits, reach_limits_of

if TYPE_CHECKING:
    from birdcage.base.config import RotctldSettings
    from birdcage.cli.options import Wanted
    from birdcage.sky.reach_limits import ReachLimits
    from birdcage.station.network_state import NetworkState
    from birdcage.station.state import StationState

BRIDGE = "172.17.0.1"
"""This computer, as a container sees it on Docker's default bridge."""
BRIDGE_NETWORK = "172.17.0.0/16"
THRESHOLD_DEG = 1
"""Gpredict's default of 5 and SatNOGS' of 4 leave the dish that far off (docs/tracking.md)."""
CYCLE_MS = 1000
GPREDICT = """\
[Rotator]
Host={host}
Port={port}
AzType={az_type}
MinAz={min_az:g}
MaxAz={max_az:g}
MinEl={min_el:g}
MaxEl={max_el:g}
AzStopPos={stop:g}
Cycle={cycle_ms}
Threshold={threshold:g}"""
SATNOGS = """\
SATNOGS_ROT_MODEL=ROT_MODEL_NETROTCTL
SATNOGS_ROT_PORT={host}:{port}
# Degrees that the dish may be off before it is moved; whole numbers only.
SATNOGS_ROT_THRESHOLD={threshold}
# A flip is the same direction the other way round: birdcage plans the keyhole itself.
SATNOGS_ROT_FLIP=False
#
# In a container, localhost is the container itself. On Docker's default bridge this computer is {bridge}:
#   SATNOGS_ROT_PORT={bridge}:{port}
# Listen there, and let the containers in:
#   birdcage serve --host {bridge} --listen-port {port} --allow {network}
# If the container still can't connect, this computer's firewall blocks it. Allow TCP port {port} from {network}.
# With network_mode: host the container shares this computer's localhost, and none of that is needed."""


@dataclass(frozen=True, slots=True)
class ListeningPlace:
    """Where clients on this computer find the server."""

    host: str
    port: int


def where_it_listens(settings: RotctldSettings, network: NetworkState | None, *, given: bool) -> ListeningPlace:
    """Return it: that of the server that runs, unless the command line says otherwise (`given`); else as set.

    ConfigError for port 0: any free one is another one each time.
    """
    host, port = settings.host, settings.port
    if network is not None and not given:
        host, port = network.host, network.port
    if not port:
        raise ConfigError("Port 0 is any free port, so clients can't be told. Name one with --listen-port.")
    return ListeningPlace("localhost" if _is_here(host) else host, port)


def _is_here(host: str) -> bool:
    """Return whether a program on this computer finds a server that listens at `host` under `localhost`."""
    try:
        return host == "127.0.0.1" or ip_address(host).is_unspecified
    except ValueError:  # a name
        return not host


def gpredict_file(place: ListeningPlace, limits: ReachLimits) -> str:
    """Return a `.rot` file with the limits of this dish: Gpredict then asks for no more than it reaches.

    The highest elevation stays below the 180 degrees from which on Gpredict flips whole passes.
    """
    az_type, low, high = _azimuths(limits)
    return GPREDICT.format(
        host=place.host, port=place.port, az_type=az_type, min_az=low, max_az=high,
        min_el=_inward(limits.el_floor_deg, math.ceil), max_el=_inward(limits.el_ceiling_deg, math.floor),
        stop=-180.0 if az_type else 0.0, cycle_ms=CYCLE_MS, threshold=THRESHOLD_DEG,
    )  # fmt: skip


def gpredict_folder() -> Path:
    """Return where Gpredict keeps its rotators: its own choice on each system (`compat.c` of 2.3)."""
    if sys.platform == "darwin":
        return Path.home() / "Library/Application Support/Gpredict/hwconf"
    if os.name == "nt":
        return Path.home() / "Gpredict/hwconf"
    return Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config") / "Gpredict/hwconf"


def satnogs_variables(place: ListeningPlace) -> str:
    """Return the environment of satnogs-client, with what changes in a container as comments."""
    return SATNOGS.format(
        host=place.host, port=place.port, threshold=THRESHOLD_DEG, bridge=BRIDGE, network=BRIDGE_NETWORK
    )


def state_of_owner(wanted: Wanted) -> StationState | None:
    """Return the state of the station that has the port, None where none has it."""
    station = attach_to_owner(wanted, "birdcage serve")
    if station is None:
        return None
    try:
        return station.state
    finally:
        station.close()


def limits_of_dish(wanted: Wanted, state: StationState | None) -> ReachLimits:
    """Return the limits as a running station knows them, else by facts and settings. Nothing is asked of the dish.

    ConfigError without a firmware, or where the settings that limit motion can't be read. MotionRefused for a machine
    that follows nothing.
    """
    if state is not None and state.dish is not None:
        limits, model = reach_limits_of(state, wanted.settings), state.dish
    else:
        if wanted.settings.motion_problem is not None:
            raise ConfigError("The limits of the dish are unknown before that is fixed.")
        file = FactsFile.of(wanted.paths.state, wanted.port, wanted.firmware if wanted.firmware_given else None)
        firmware = wanted.firmware if wanted.firmware_given else None if file is None else file.firmware
        if firmware is None:
            raise ConfigError("Name the firmware with --firmware. `birdcage detect` tells which it is.")
        found = model_of(firmware, wanted.settings)
        if found is None:
            known = ", ".join(list_firmwares())
            raise ConfigError(f"Firmware {firmware} is unknown to this version. It speaks {known}.")
        model = found
        limits = reach_limits(wanted.settings, model)
    if model.no_following:
        raise MotionRefused(model.no_following, reason=Reason.UNSUPPORTED)
    return limits


def _azimuths(limits: ReachLimits) -> tuple[int, float, float]:
    """Return Gpredict's kind of azimuth (0: 0 to 360, 1: -180 to 180), and the true azimuths that are reached.

    A dish that turns less than once round gets the kind in which its range is one piece; else the whole circle.
    """
    low, high = limits.cable_min_deg, limits.cable_max_deg
    if low is None or high is None or high - low >= 360.0:
        return 0, 0.0, 360.0
    begins = (low + limits.az_offset_deg) % 360.0
    ends = begins + high - low
    for az_type, turn in ((0, 0.0), (1, 360.0)):
        if ends - turn <= 360.0 - turn / 2.0 and begins - turn >= -turn / 2.0:
            return az_type, _inward(begins - turn, math.ceil), _inward(ends - turn, math.floor)
    return 0, 0.0, 360.0


def _inward(degrees: float, towards: Callable[[float], int]) -> float:
    """Return an end of a range in hundredths, rounded to the side where the dish can go."""
    return towards(round(degrees * 100.0, 4)) / 100.0
