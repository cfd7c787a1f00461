"""What must hold in every cell, and what is particular to each: as sentences about what does not."""

from __future__ import annotations

from .fault import ANY, MOVING, TIMED, Fault
from .outcome import Outcome

WORST = ("lost", "silent")


def verdict(fault: Fault, dialect: str, when: str, seen: Outcome) -> tuple[str, ...]:
    """Return what is wrong with an outcome; nothing when all is as it must be."""
    return (*_common(fault, seen), *_particular(fault, dialect, when, seen))


def worst_link(seen: Outcome) -> str:
    """Return the worst state of the link that was told."""
    return next((state for state in WORST if state in seen.links), "-")


def _common(fault: Fault, seen: Outcome) -> list[str]:
    wrong = []
    if seen.false:
        wrong.append(f"told what was not so, {len(seen.false)} times: {seen.false[0]}")
    if "moved" in seen.alarms and not (fault.own_motion or fault.astray):
        wrong.append("told that it moves unasked, and it went where it was sent")
    if seen.unasked:
        wrong.append(f"moved unasked: {', '.join(seen.unasked)}")
    if seen.next_good != "right":
        wrong.append(f"afterwards: {seen.next_good}")
    if seen.came_back_s is None:
        wrong.append("it never came back")
    if seen.stop.escaped:
        wrong.append(f"sent while STOP held: {seen.stop.escaped}")
    if not seen.stop.held:
        wrong.append("STOP did not hold")
    if not (seen.stop.rests or fault.own_motion):
        wrong.append("the dish moves a minute after STOP")
    if seen.fault is None and seen.links == () and seen.position_hidden and seen.sees == ():
        wrong.append("the position was given up, and nothing says why")
    return wrong


def _particular(fault: Fault, dialect: str, when: str, seen: Outcome) -> list[str]:
    expect = fault.expected(dialect, when)
    default = "nothing" if dialect in TIMED else "at once" if when == MOVING and fault.port else ANY
    stop = expect.stop or default
    observed = {
        "link": (worst_link(seen), expect.link), "fault": (seen.fault or "-", expect.fault),
        "held": (seen.held or "-", expect.held), "motion": (seen.motion, expect.motion),
        "a modelled position that is wrong": (str(seen.misled), str(expect.misled)),
        "STOP's bytes": (seen.stop.sends, stop),
    }  # fmt: skip
    return [
        f"{what}: {was}, and not {should}"
        for what, (was, should) in observed.items()
        if was not in should.split("|")
    ]  # fmt: skip
