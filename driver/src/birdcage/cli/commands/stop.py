"""`birdcage stop`."""

from __future__ import annotations

import signal
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from birdcage.base.reason import Reason
from birdcage.cli import exits
from birdcage.cli.options import Wanted, flags, global_options, wanted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from birdcage.base.paths import Paths
    from birdcage.detection.detecting import Detection
    from birdcage.station.control_client import Owner

BY = "birdcage stop"
PATIENCE_S = 15.0
"""How long a dish that does not answer is tried."""
TIMES_ASKED = 2
"""How often a port is asked who answers there before the firmware that was named is believed."""


@click.command("stop", epilog=exits.EPILOG)
@global_options()
@click.pass_context
def command(context: click.Context) -> None:
    """Stop the dish, and report what happened.

    Without --port, every birdcage program that has a port stops its dish, all at once. If no program has yours, the
    port is opened, and whatever dish answers there is stopped: no firmware needs to be named. With --port, that one
    dish is stopped. A dish that was stopped is HELD: no birdcage program moves it until you release it, there or with
    `birdcage release`.
    """
    dish = wanted()
    done = _ring(_every_one(dish))
    _tell(done)
    if not done or (dish.port_given and not _has_owner(dish)):
        alone = _stop_alone(dish)
        _tell(alone)
        done += alone
    if not all(stop["confirmed"] for stop in done):
        context.exit(exits.NOT_DONE)


def _every_one(dish: Wanted) -> list[Owner]:
    """Return the programs that are to stop their dishes: all there are, unless --port names one of them."""
    from birdcage.cli.owners import owners_of

    return owners_of(dish if dish.flags.get("dish.port") is not None else replace(dish, port_given=False))


def _has_owner(dish: Wanted) -> bool:
    from birdcage.cli.owners import owners_of

    return bool(owners_of(dish))


def _stop_alone(dish: Wanted) -> list[dict[str, Any]]:
    """Stop a dish that no program of ours drives."""
    from birdcage.base.errors import BirdcageError, LinkError

    try:
        stop = _stop_ourselves(dish)
        return [stop | {"held": _is_held(dish.paths, stop["port"])}]
    except BirdcageError as error:
        # One may have taken the port, or given it back, since we looked.
        done = _ring(_every_one(dish)) if isinstance(error, LinkError) and _has_owner(dish) else []
        if not done:
            if _is_held(dish.paths, dish.port):
                error.add_note("The dish is HELD all the same: `birdcage release` lets programs move it again.")
            raise
        return done


def _is_held(paths: Paths, port: str) -> bool:
    """See to it that no later program moves the dish, whether STOP got through or not; return whether that is so."""
    from birdcage.base.clock import RealClock
    from birdcage.base.errors import BirdcageError
    from birdcage.station.holding import find_held, hold

    try:
        if find_held(paths, port) is None:
            hold(paths, port, BY, RealClock().utc())
    except BirdcageError:
        return False  # a simulator inside this program, a port that is not there, a disk that takes nothing
    return True


def _ring(owners: Sequence[Owner]) -> list[dict[str, Any]]:
    """Have these programs stop their dishes, all at once, and return what each did; empty if none lives."""
    from birdcage.cli.exits import EndedBySignal
    from birdcage.cli.options import find_paths
    from birdcage.cli.owners import ring_all

    try:
        done = ring_all(owners, _ring_one)
    except KeyboardInterrupt:
        ended = EndedBySignal(signal.SIGINT)
        for owner in owners:
            ended.add_note(f"Process {owner.pid} was told to stop the dish. The result is unknown: look at the dish.")
        raise ended from None
    paths = find_paths()
    return [
        stop | {"port": owner.port, "pid": owner.pid, "held": _is_held(paths, owner.port)}
        for owner, stop in zip(owners, done, strict=True)
        if stop is not None
    ]


def _ring_one(owner: Owner) -> dict[str, Any] | None:
    from birdcage.base.errors import CommandRefused
    from birdcage.station.control_client import NoAnswer, OwnerGone, call_owner
    from birdcage.station.requests import Stop

    try:
        done: dict[str, Any] = call_owner(owner, Stop(BY), BY)
        return done
    except NoAnswer as error:
        sentence = f"{error}: cut the power of the dish."
    except CommandRefused as error:  # another version: that keeps no other program from being stopped
        sentence = f"{error} If the dish moves, stop it there, or cut its power."
    except OwnerGone:
        return None
    return {"by": BY, "means": "none", "confirmed": False, "sentence": sentence}


def _stop_ourselves(wanted: Wanted) -> dict[str, Any]:
    """Open the port, find out what answers, look where the dish is and whether it moves, and stop it."""
    from birdcage.base.errors import NoReply
    from birdcage.cli.say import say
    from birdcage.cli.which import take
    from birdcage.rotator.machines import MACHINES, names_in

    if wanted.firmware_given and wanted.firmware in names_in(MACHINES):
        return _stop_it(wanted)  # asking who answers begins with an Enter, which only a console is known to bear
    found = _find(wanted)
    named = wanted.firmware if wanted.firmware_given else ""
    tries = [take(wanted, found, each) for each in sorted(found.candidates, key=lambda each: each != named)]
    if not tries and (wanted.firmware_given or found.trouble is not None):
        tries = [wanted]  # what does not tell may be a shell that is busy: the one that was named waits for it
    for at, dish in enumerate(tries, 1):
        if wanted.firmware_given and dish.firmware != wanted.firmware:
            say(f"{found.sentence} {wanted.firmware} was named.")
        try:
            return _stop_it(dish)
        except NoReply as error:
            if error.reason != Reason.WRONG_FIRMWARE or at == len(tries):
                raise
    if not found.talks:
        raise NoReply(f"{found.sentence} No STOP has reached a dish. If it moves, cut its power.")
    return {
        "by": BY, "means": "enter", "confirmed": None, "port": wanted.port,
        "sentence": f"{found.sentence} A bare Enter was sent, which ends a combined move. If the dish moves, cut its "
        "power.",
    }  # fmt: skip


def _find(wanted: Wanted) -> Detection:
    """Ask the port until something answers; a shell that homes, say, is busy for a while.

    Twice where a firmware was named: it is waited for after that, and one answer may be lost.
    """
    from birdcage.base.clock import RealClock
    from birdcage.cli.which import ask_port

    clock = RealClock()
    until = clock.monotonic() + PATIENCE_S
    found = ask_port(wanted, clock, log=False)
    asked = 1
    while not found.is_told and clock.monotonic() < until and not (wanted.firmware_given and asked == TIMES_ASKED):
        found = ask_port(wanted, clock, log=False)
        asked += 1
    return found


def _stop_it(wanted: Wanted) -> dict[str, Any]:
    from birdcage.cli.dish import open_dish
    from birdcage.station.report import stop_report

    with open_dish(wanted, survey=False) as dish:
        dish.come_up(PATIENCE_S, patient=True)
        report = dish.stop(BY)
        port = dish.state.port
    if report is None:
        sentence = "STOP was sent. It is unknown whether the dish moves. If it does, cut its power."
        return {"by": BY, "means": "sent", "confirmed": None, "sentence": sentence, "port": port}
    return stop_report(report) | {"port": port}


def _tell(done: list[dict[str, Any]]) -> None:
    from birdcage.cli.say import tell, tell_json

    for stop in done:
        if flags().json:
            tell_json(stop)
            continue
        whose = f" ({stop['port']}, process {stop['pid']})" if "pid" in stop else ""
        held = " HELD until a person releases it: `birdcage release`." if stop["held"] else ""
        tell(f"{stop['sentence']}{held}{whose}")
