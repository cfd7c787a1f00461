"""Which firmware answers on a port, asked before a session begins: one bare Enter at each usual rate.

A Carryout G2 shows a prompt that its dialect declares, at its own rate (reference sections 7.2 and 7.3). The prompts of
the HAL family are unknown (section 4), so any other prompt, and any text at its rate, is taken for HAL 2.05. The
console proves it, or the session refuses to move: this is no more than a first guess.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage.base.clock import Clock
from birdcage.base.errors import LinkError
from birdcage.console.probe import BaudFinding, Saw, overhear, probe
from birdcage.link.link import Link
from birdcage.link.opening import has_speed, open_link
from birdcage.protocol.registry import FIRMWARE_REGISTRY
from birdcage.station.settings import OpenLink

OTHERS = "hal205"
"""What a console is taken for whose prompt no dialect declares."""

LOG_S = 5.5
"""How long a dish is listened to that answers at no rate: one that homes at power-up tells of it every few seconds."""


@dataclass(frozen=True, slots=True)
class Detection:
    """What was found on a port."""

    firmware: str | None
    """None where it cannot be told: silence, garbage, an echo, or no port."""
    sentence: str
    """What was seen, for a person."""
    findings: tuple[BaudFinding, ...] = ()


def detect_firmware(
    port: str, clock: Clock, *, baud: int | None = None, open_port: OpenLink | None = None,
    tell: Callable[[str], None] = lambda _sentence: None,
) -> Detection:  # fmt: skip
    """Listen at `baud`, or at the rates of the firmwares that are spoken here, and say which one answers.

    Sends one bare Enter at each rate and takes 0.7 s for it, a little more where a port opens slowly. A dish that
    answers at none may be starting: it is listened to for `LOG_S` more, at the rate at which any log tells which one
    it is. Nothing moves; a combined move of a Trav'ler that is under way ends by it. A port that does not open is no
    error: the session that begins next says what is wrong with it. `tell` hears which rate is listened at.
    """
    opening = open_port or _opening(clock)
    rates = (baud,) if baud is not None else _rates() if has_speed(port) else _rates()[:1]
    findings: list[BaudFinding] = []
    for rate in rates:
        tell(f"Listening for the dish on {port} at {rate} baud …" if has_speed(port) else f"Listening on {port} …")
        try:
            link = opening(port, rate)
            try:
                findings.append(probe(link, clock, rate, tokens=_tokens()))
            finally:
                link.close()
        except LinkError as error:
            return Detection(None, str(error), tuple(findings))
        firmware = firmware_of(findings[-1], rate_counts=has_speed(port))
        if firmware is not None:
            return Detection(firmware, f"{port} shows `{findings[-1].sample}`: {firmware}.", tuple(findings))
    others = FIRMWARE_REGISTRY[OTHERS].model.baud
    mute = any(each.baud == others and each.saw in (Saw.SILENCE, Saw.ECHO) for each in findings)
    if has_speed(port) and mute:
        tell(f"Nothing answers. Listening at {others} baud for the log of a dish that starts …")
        try:
            link = opening(port, others)
            try:
                findings.append(overhear(link, clock, others, tokens=_tokens(), listen_s=LOG_S))
            finally:
                link.close()
        except LinkError as error:
            return Detection(None, str(error), tuple(findings))
        firmware = firmware_of(findings[-1])
        if firmware is not None:
            return Detection(firmware, f"{port} shows `{findings[-1].sample}`: {firmware}.", tuple(findings))
    return Detection(None, f"{port} does not tell which firmware it is.", tuple(findings))


def heard_firmware(finding: BaudFinding, port: str) -> str | None:
    """Return the firmware that shows this on `port`; None where it could be any."""
    return firmware_of(finding, rate_counts=has_speed(port))


def firmware_of(finding: BaudFinding, *, rate_counts: bool = True) -> str | None:
    """Return the firmware that shows this; None where it could be any.

    `rate_counts`: whether the port takes its rate from us. Then a prompt that a dialect declares is that firmware's
    only at its own rate: one of the HAL family may show the same.
    """
    for name, each in FIRMWARE_REGISTRY.items():
        if rate_counts and finding.baud != each.model.baud:
            continue
        if name != OTHERS and any(token in finding.sample for token in each.dialect.prompts.values()):
            return name
        if finding.saw is Saw.TEXT and any(mark in finding.sample for mark in each.boot_marks):
            return name
    others = FIRMWARE_REGISTRY.get(OTHERS)
    if others is None:
        return None
    says_so = finding.saw is Saw.PROMPT or (finding.saw is Saw.TEXT and finding.baud == others.model.baud)
    return OTHERS if says_so else None


def _opening(clock: Clock) -> OpenLink:
    def opening(port: str, baud: int) -> Link:
        return open_link(port, baud=baud, clock=clock)

    return opening


def _rates() -> tuple[int, ...]:
    """Return the rate of each firmware once, the fastest first."""
    return tuple(sorted({each.model.baud for each in FIRMWARE_REGISTRY.values()}, reverse=True))


def _tokens() -> tuple[str, ...]:
    return tuple(token for each in FIRMWARE_REGISTRY.values() for token in each.dialect.prompts.values())
