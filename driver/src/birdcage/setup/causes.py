"""Why a port does not answer: from what was seen to what may be wrong, likeliest first. Pure.

What each observation speaks for is in `docs/wiring.md`, *Pins* (swapped pairs), in `docs/reference/consoles.md`,
*Silence* (other rates, deadlock), and in `birdcage.setup.wiring`, which draws the plugs.
"""

from __future__ import annotations

from birdcage.detection.probe import Saw
from birdcage.setup import wire_causes as wire
from birdcage.setup.case import Case, Cause, describe
from birdcage.station.known import Hindrance
from birdcage.station.state import LinkPhase

__all__ = ["Case", "Cause", "describe", "find_causes"]


def find_causes(case: Case) -> tuple[Cause, ...]:
    """Return what may be wrong, the likely ones first, else in the order in which to look; nothing while it is up."""
    if case.link.state is LinkPhase.UP:
        return ()
    found = [*_of_the_system(case), *_of_the_port(case)] if case.link.state is LinkPhase.LOST else _of_the_wire(case)
    return tuple(sorted(found, key=lambda cause: not cause.likely))


def _of_the_port(case: Case) -> list[Cause]:
    """The port itself cannot be opened."""
    if "://" in case.port:
        mend = "Check the address. Is the serial server on, and does it listen?"
        return [Cause("The server does not answer", case.link.detail, mend, likely=True)]
    here = [each.device for each in case.ports]
    if case.port in here or (case.system is not None and case.system.may_open is not None):
        return [
            Cause(
                "The port does not open", case.link.detail, "Unplug the adapter, plug it in again, and try once more.",
                likely=not _of_the_system(case),
            )
        ]  # fmt: skip
    others = f"There is {', '.join(here)}: choose that one." if here else "No serial port is plugged in."
    return [
        Cause("The adapter is out", case.link.detail, f"Plug it in, or try another cable. {others}", likely=True),
    ]


def _of_the_system(case: Case) -> list[Cause]:
    """What this machine holds against the port. A slow adapter answers all the same: it is no cause."""
    if case.system is None:
        return []
    titles = {
        "group": "Not permitted", "login": "Not permitted yet", "busy": "Another program uses it",
        "modemmanager": "ModemManager meddles", "brltty": "brltty takes the adapter",
    }  # fmt: skip
    return [
        Cause(titles[each.name], each.what, _mend(each), _meddles(each, case), command=each.command)
        for each in case.system.hindrances
        if each.name in titles
    ]


def _mend(hindrance: Hindrance) -> str:
    run = f"Run `{hindrance.command}`." if hindrance.command else ""
    return " ".join(part for part in (run, hindrance.then) if part)


def _meddles(hindrance: Hindrance, case: Case) -> bool:
    """Return whether this hindrance explains what was seen, and not only might."""
    match hindrance.name:
        case "modemmanager":
            return any("AT" in each.sample for each in case.findings if each.saw is Saw.TEXT)
        case "brltty":
            return case.link.state is LinkPhase.LOST and not case.ports
    return True


def _of_the_wire(case: Case) -> list[Cause]:
    """The port is open: what came over the wire speaks."""
    if case.rates(Saw.PROMPT):
        found = wire.prompt(case)
    elif case.rates(Saw.TEXT):
        found = wire.text(case)
    elif case.rates(Saw.GARBAGE):
        found = wire.garbage(case)
    elif case.rates(Saw.ECHO):
        found = wire.echo(case)
    else:
        found = wire.silence(case)
    system = _of_the_system(case)
    if case.rates(Saw.PROMPT):
        return [*found, *system]
    # A thing that is seen comes before one that is only thought of.
    return [*(each for each in system if each.likely), *found, *(each for each in system if not each.likely)]
