r"""What Hamlib's clients may set or ask beside motion: levels, functions, parameters, configuration, capabilities.

No network client changes a setting here. The speed of `M` is the one level: what a client has named, for its own moves.
"""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.rotctld.arguments import ArgumentShape
from birdcage.rotctld.client_context import ClientContext
from birdcage.rotctld.dish_commands import MODEL, SPEEDS, checked_speed
from birdcage.rotctld.result import DONE, CommandResult, unkeyed
from birdcage.rotctld.rprt import RotctldError, Rprt

LISTED = "?"
"""In place of a name: tell all names."""
SPEED = "SPEED"
CONFIGURATION = (
    "rot_pathname", "write_delay", "post_write_delay", "timeout", "retry", "flushx", "min_az", "max_az", "min_el",
    "max_el", "south_zero", "serial_speed", "data_bits", "stop_bits", "serial_parity", "serial_handshake", "rts_state",
    "dtr_state",
)  # fmt: skip
"""Hamlib's names for what is configured of any rotator."""


def set_level(client: ClientContext, arguments: Sequence[str]) -> CommandResult:
    """Set the speed of this client's moves, for those that leave it unchanged."""
    if arguments[0] == LISTED:
        return unkeyed(f"{SPEED} ", acknowledged=True)
    if arguments[0] != SPEED or not ArgumentShape.INTEGER.fits(arguments[1]):
        raise _no(arguments, "V SPEED takes 1 to 100")
    client.speed = checked_speed(int(arguments[1]))
    return DONE


def get_level(client: ClientContext, arguments: Sequence[str]) -> CommandResult:
    """Tell that speed: 100, the whole of the dish's own, before this client has named one."""
    if arguments[0] == LISTED:
        return unkeyed(f"{SPEED} ")
    if arguments[0] != SPEED:
        raise _no(arguments, "the one level is SPEED")
    return unkeyed(f"{SPEEDS[-1] if client.speed is None else client.speed}")


def set_none(_: ClientContext, arguments: Sequence[str]) -> CommandResult:
    """List what may be set of functions or parameters: none."""
    if arguments[0] == LISTED:
        return unkeyed("", acknowledged=True)
    raise _no(arguments, "there is none of that name")


def get_none(_: ClientContext, arguments: Sequence[str]) -> CommandResult:
    """List what may be asked of functions or parameters: none."""
    if arguments[0] == LISTED:
        return unkeyed("")
    raise _no(arguments, "there is none of that name")


def set_conf(_: ClientContext, arguments: Sequence[str]) -> CommandResult:
    """Refuse: what Hamlib knows of is ENAVAIL, what it does not know is EINVAL."""
    if arguments[0] in CONFIGURATION:
        raise RotctldError(Rprt.ENAVAIL, f"{arguments[0]} can't be set over the network: it is in the settings.")
    raise _no(arguments, "Hamlib has no such setting")


def get_conf(client: ClientContext, arguments: Sequence[str]) -> CommandResult:
    """Tell the range that is advertised; the rest that Hamlib knows of is ENAVAIL."""
    known = client.rotor.advertised()
    values = {
        "min_az": known.min_az_deg, "max_az": known.max_az_deg, "min_el": known.min_el_deg, "max_el": known.max_el_deg,
    }  # fmt: skip
    name = arguments[0]
    if name in values:
        return unkeyed(f"{name}={values[name]:.6f}")
    if name == "south_zero":
        return unkeyed("south_zero=0")
    if name in CONFIGURATION:
        raise RotctldError(Rprt.ENAVAIL, f"{name} is not told over the network.")
    raise _no(arguments, "Hamlib has no such setting")


def dump_conf(_: ClientContext, __: Sequence[str]) -> CommandResult:
    """Do nothing: Hamlib's own daemon prints its list on its own screen."""
    return DONE


def dump_caps(client: ClientContext, _: Sequence[str]) -> CommandResult:
    """Tell what this rotator can do, in Hamlib's words."""
    known = client.rotor.advertised()
    can = {
        "set Conf:\t": "N", "get Conf:\t": "Y", "set Position:": "Y", "get Position:": "Y", "Stop:\t": "Y",
        "Park:\t": "Y", "Reset:\t": "N", "Move:\t": "Y", "get Info:\t": "Y", "get Status:\t": "Y", "set Func:": "N",
        "get Func:": "N", "set Level:": "Y", "get Level:": "Y", "set Param:": "N", "get Param:": "N",
    }  # fmt: skip
    first_to_last = "..".join((f"{SPEEDS[0]}", f"{SPEEDS[-1]}"))
    speed = f"{SPEED}({first_to_last}/1) "
    return unkeyed(
        f"Caps dump for model:\t{MODEL}",
        f"Model name:\t\t{client.rotor.name()}",
        "Mfg name:\t\tbirdcage",
        "Rot type:\t\tAz-El",
        "Get functions: ",
        "Set functions: ",
        f"Get level: {speed}",
        f"Set level: {speed}",
        "Get parameters: ",
        "Set parameters: ",
        f"Min Azimuth:\t\t{known.min_az_deg:.2f}",
        f"Max Azimuth:\t\t{known.max_az_deg:.2f}",
        f"Min Elevation:\t\t{known.min_el_deg:.2f}",
        f"Max Elevation:\t\t{known.max_el_deg:.2f}",
        *(f"Can {ability}\t{answer}" for ability, answer in can.items()),
        "",
        "Overall backend warnings: 0",
        acknowledged=True,
    )


def _no(arguments: Sequence[str], why: str) -> RotctldError:
    return RotctldError(Rprt.EINVAL, f"{' '.join(arguments)}: {why}.")
