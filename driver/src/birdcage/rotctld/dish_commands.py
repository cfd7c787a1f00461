"""The commands that a dish does: where it is, where it shall go, how it is, and what Hamlib asks of a rotator."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from birdcage.base.text import clean
from birdcage.rotctld.arguments import direction, number
from birdcage.rotctld.client_context import ClientContext
from birdcage.rotctld.result import DONE, AwaitedResult, CommandResult, keyed, unkeyed
from birdcage.rotctld.rprt import RotctldError, Rprt

PROTOCOL_VERSION = 1
r"""Of `\dump_state`: what follows is `tag=value`."""
MODEL = 2
"""Hamlib's number of *NET rotctl*: what its clients take for us. No model of Hamlib's is one of our dishes."""
SPEEDS = range(1, 101)
"""Of `M` and `V SPEED`."""
UNCHANGED = -1


def get_pos(client: ClientContext, _: Sequence[str]) -> CommandResult:
    """Tell azimuth, 0 to 359.99, and elevation."""
    return _told(*client.rotor.position())


@lru_cache(maxsize=8)
def _told(az_deg: float, el_deg: float) -> CommandResult:
    """Return a position as it is told; clients ask much more often than a dish is read."""
    # Rounded first: 359.996 is 0.00, and no zero has a sign.
    return keyed(("Azimuth", "Elevation"), f"{round(az_deg, 2) % 360.0 + 0.0:.2f}", f"{round(el_deg, 2) + 0.0:.2f}")


def set_pos(client: ClientContext, arguments: Sequence[str]) -> CommandResult:
    """Take a wish; whether the dish can go there is the rotor's to judge."""
    az_deg, el_deg = map(number, arguments)
    client.rotor.set_position(az_deg, el_deg)
    return DONE


def stop(client: ClientContext, _: Sequence[str]) -> CommandResult:
    """End what this client has moved."""
    client.rotor.stop()
    return DONE


def park(client: ClientContext, _: Sequence[str]) -> CommandResult:
    """Go to the park position."""
    client.rotor.park()
    return DONE


def move(client: ClientContext, arguments: Sequence[str]) -> CommandResult:
    """Go on in a direction. -1 is the speed that this client has named last."""
    way, speed = direction(arguments[0]), int(arguments[1])
    if speed == UNCHANGED:
        speed = UNCHANGED if client.speed is None else client.speed
    else:
        client.speed = checked_speed(speed)
    client.rotor.move(way, speed)
    return DONE


def checked_speed(speed: int) -> int:
    """Return a speed of `M`; EINVAL where it is none."""
    if speed not in SPEEDS:
        raise RotctldError(Rprt.EINVAL, f"Speed {speed} is outside 1 to 100. Send 1 to 100, or -1: unchanged.")
    return speed


def reset(_: ClientContext, __: Sequence[str]) -> CommandResult:
    """Refuse: no network client restarts or homes a dish."""
    raise RotctldError(Rprt.ENAVAIL, "A reset from the network is refused. `birdcage home` homes the dish.")


def get_info(client: ClientContext, _: Sequence[str]) -> CommandResult:
    """Tell what this dish is called."""
    return keyed(("Info",), client.rotor.name())


def get_status(client: ClientContext, _: Sequence[str]) -> CommandResult:
    """Tell Hamlib's words that are true now, each with a blank behind it."""
    return keyed(("Status flags",), "".join(f"{word} " for word in client.rotor.status()))


def send_cmd(client: ClientContext, arguments: Sequence[str]) -> AwaitedResult:
    """Send a line to the dish's console; its lines come back, or `RPRT 0` where there are none."""
    return AwaitedResult(client.rotor.send(arguments[0]), lambda lines: unkeyed(*map(clean, lines)))


def pause(_: ClientContext, arguments: Sequence[str]) -> CommandResult:
    """Take it as done: who wants to wait can do so without us."""
    if int(arguments[0]) < 0:
        raise RotctldError(Rprt.EINVAL, f"A pause of {arguments[0]} s is below 0. Send 0 or more.")
    return DONE


def leave(client: ClientContext, _: Sequence[str]) -> CommandResult:
    """Hang up. It has no reply."""
    client.closed = True
    return DONE


def dump_state(client: ClientContext, _: Sequence[str]) -> CommandResult:
    """Tell a client made of Hamlib what it asks first: version, model, range."""
    client.has_dumped_state = True
    known = client.rotor.advertised()
    ranges = {
        ("min_az", "Minimum Azimuth"): known.min_az_deg, ("max_az", "Maximum Azimuth"): known.max_az_deg,
        ("min_el", "Minimum Elevation"): known.min_el_deg, ("max_el", "Maximum Elevation"): known.max_el_deg,
    }  # fmt: skip
    plain = [f"{PROTOCOL_VERSION}", f"{MODEL}", *(f"{tag}={value:.6f}" for (tag, _), value in ranges.items())]
    extended = [f"rotctld Protocol Ver: {PROTOCOL_VERSION}", f"Rotor Model: {MODEL}"]
    extended += [f"{key}: {value:.6f}" for (_, key), value in ranges.items()]
    rest = ("rot_type=AzEl", "done")
    return CommandResult((*plain, "south_zero=0", *rest), (*extended, "South Zero: 0", *rest))
