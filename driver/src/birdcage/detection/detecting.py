"""Which firmware answers on a port, asked before a session begins: a bare Enter at each usual rate, and a `?`.

What a console shows must speak for a firmware; that it shows none of another's proves nothing. The session proves it
once more, or refuses to move.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage.base.clock import Clock
from birdcage.base.errors import LinkError
from birdcage.base.machine_port import machine_at
from birdcage.detection.clues import (
    CERTAIN,
    Clue,
    clues_of,
    depends_on_rate,
    firmwares_of,
    known_tokens,
    without_rate,
)
from birdcage.detection.machine_probe import ask, questions
from birdcage.detection.named_machine import meet_machine
from birdcage.detection.probe import BaudFinding, Saw, overhear, probe
from birdcage.detection.spoken import marked
from birdcage.link.link import Link
from birdcage.link.opening import has_speed, open_link
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.machines import facts_of

OpenLink = Callable[[str, int], Link]

_VOWELS = frozenset("aeioAEIO")

LOG_S = 5.5
"""How long a dish is listened to that shows no prompt: one that homes at power-up tells of it every few seconds."""


@dataclass(frozen=True, slots=True)
class Detection:
    """What was found on a port."""

    port: str
    firmware: str | None
    """None if it cannot be told."""
    sentence: str
    """What was seen, for a person."""
    findings: tuple[BaudFinding, ...] = ()
    """What each rate showed, in the order in which they were tried."""
    clues: tuple[Clue, ...] = ()
    """What spoke for which firmware."""
    candidates: tuple[str, ...] = ()
    """The firmwares that the clues speak for; more than one cannot be told apart."""
    baud: int | None = None
    """The rate at which it answers, where the port takes one from us."""
    trouble: LinkError | None = None
    """Why the port could not be opened."""

    @property
    def is_told(self) -> bool:
        """Whether asking again would tell no more: a prompt answered, whosever it is, or the port can't be had."""
        return self.trouble is not None or bool(self.clues) or any(each.saw is Saw.PROMPT for each in self.findings)

    @property
    def talks(self) -> bool:
        """Whether something legible answers, whatever it is."""
        return any(each.saw in (Saw.PROMPT, Saw.TEXT) for each in self.findings)


def detect_firmware(
    port: str, clock: Clock, *, baud: int | None = None, first: int | None = None, log_s: float = LOG_S,
    open_port: OpenLink | None = None, tell: Callable[[str], None] = lambda _sentence: None,
) -> Detection:  # fmt: skip
    """Ask at `baud`, or at the rates of the firmwares that are spoken here (`first` before the others), which it is.

    Sends one bare Enter at each rate, which takes 0.7 s where nothing answers, and `?` where a prompt does. A dish
    that shows none may be starting: its log is listened to for `log_s` more, at the rate at which any text came or
    else at that of the dish that starts longest. Nothing moves; a combined move of a Trav'ler that is under way ends
    by the first byte. Where all of that is silent, whole machines are asked, each by a question that moves nothing
    (`LineProbe`). `tell` hears which rate is tried. A port that does not open is told in `trouble`.

    A port that names its machine by its scheme (`base.machine_port`) is asked in that machine's language instead.
    """
    named = machine_at(port)
    if named is not None:
        tell(f"Asking for the {named} on {port} …")
        return _meet(named, port, clock, open_port)
    opening, timed = open_port or _opening(clock), has_speed(port)
    rates = (baud,) if baud is not None else _rates(first) if timed else _rates(first)[:1]
    findings: list[BaudFinding] = []
    try:
        for rate in rates:
            tell(f"Listening for the dish on {port} at {rate} baud …" if timed else f"Listening on {port} …")
            link = opening(port, rate)
            try:
                findings.append(probe(link, clock, rate, tokens=known_tokens()))
            finally:
                link.close()
            clues = clues_of(findings[-1], rate_counts=timed)
            if timed and baud is None and depends_on_rate(firmwares_of(clues)):
                tell(f"Asking {port} at another rate: some of what it may be answers at any …")
                clues = without_rate(clues, answers=_answers_elsewhere(opening, port, clock, rate))
            if clues or findings[-1].saw is Saw.PROMPT:
                return _told(port, findings, clues, timed=timed)
        heard = _rate_of_log(findings)
        if log_s > 0 and heard is not None:
            tell(f"No prompt. Listening at {heard} baud for the log of a dish that starts …")
            link = opening(port, heard)
            try:
                findings.append(
                    overhear(
                        link,
                        clock,
                        heard,
                        tokens=known_tokens(),
                        listen_s=log_s,
                        told=lambda text: bool(clues_of(_of_log(heard, text), rate_counts=timed)),
                    )
                )
            finally:
                link.close()
        if all(each.saw is Saw.SILENCE for each in findings):
            for (question, own_rate), names in questions().items():
                rate = baud or own_rate or rates[0]
                tell(f"Silent so far. Asking for a {' or a '.join(map(_name, names))} …")
                link = opening(port, rate)
                try:
                    findings.append(ask(link, clock, rate, question))
                finally:
                    link.close()
                if findings[-1].saw is not Saw.SILENCE:
                    break
    except LinkError as error:
        return Detection(port, None, str(error), tuple(findings), trouble=error)
    return _told(port, findings, clues_of(findings[-1], rate_counts=timed), timed=timed)


def _meet(firmware: str, port: str, clock: Clock, open_port: OpenLink | None) -> Detection:
    try:
        met = meet_machine(firmware, port, clock, Hooks(dial=open_port))
    except LinkError as error:
        return Detection(port, None, str(error), trouble=error)
    if met.silence:
        return Detection(port, None, f"{port} names a {met.name} ({firmware}), and none answers. {met.silence}")
    clue = Clue(firmware, "it answers in the language that its address names", CERTAIN)
    told = f" {met.told[:1].upper()}{met.told[1:]}." if met.told else ""
    sentence = f"{port} is a {met.name} ({firmware}): {clue.words}.{told}"
    return Detection(port, firmware, sentence, (), (clue,), (firmware,))


def heard_firmware(finding: BaudFinding, port: str) -> str | None:
    """Return the firmware that shows this on `port`; None if none does for certain, or more than one might."""
    firmwares = firmwares_of(clues_of(finding, rate_counts=has_speed(port)))
    return firmwares[0] if len(firmwares) == 1 else None


def _told(port: str, findings: list[BaudFinding], clues: tuple[Clue, ...], *, timed: bool) -> Detection:
    candidates = firmwares_of(clues)
    last = findings[-1]
    baud = last.baud if timed and clues else None
    if len(candidates) == 1:
        name = _name(candidates[0])
        why = "; ".join(clue.words for clue in clues if clue.firmware == candidates[0])
        sentence = f"{port} is {'an' if name[0] in _VOWELS else 'a'} {name} ({candidates[0]}): {why}."
        return Detection(port, candidates[0], sentence, tuple(findings), clues, candidates, baud)
    if candidates:
        shown_by: dict[str, list[str]] = {}
        for clue in clues:
            shown_by.setdefault(clue.words, []).append(clue.firmware)
        seen = "; ".join(f"{words} ({', '.join(firmwares)})" for words, firmwares in shown_by.items())
        sentence = f"{port} may be any of {', '.join(candidates)}: {seen}. Say which with --firmware."
        return Detection(port, None, sentence, tuple(findings), clues, candidates, baud)
    return Detection(port, None, _untold(port, findings), tuple(findings))


def _name(firmware: str) -> str:
    spoken = marked()
    return spoken[firmware].model.name if firmware in spoken else facts_of(firmware).name


def _untold(port: str, findings: list[BaudFinding]) -> str:
    """Say what was seen where nothing speaks for a firmware."""
    talking = next((each for each in reversed(findings) if each.saw in (Saw.PROMPT, Saw.TEXT)), None)
    if talking is not None and talking.saw is Saw.PROMPT:
        lists = f", and `?` lists {', '.join(sorted(talking.listed)[:8])}" if talking.listed else ""
        return (
            f"What answers on {port} shows `{talking.prompt or talking.sample}`{lists}: no known firmware does. If "
            "it is a dish, set its firmware with --firmware."
        )
    if talking is not None:
        return (
            f"What talks on {port} at {talking.baud} baud (`{talking.sample}`) shows no prompt that birdcage knows. "
            "It is another device, or a dish that is starting."
        )
    rates = " and ".join(str(rate) for rate in dict.fromkeys(each.baud for each in findings))
    if any(each.saw is Saw.ECHO for each in findings):
        return f"{port} gives back our own Enter at {rates} baud, and nothing else: no dish answers."
    if any(each.saw is Saw.GARBAGE for each in findings):
        return (
            f"What comes from {port} cannot be read at {rates} baud. Try another rate, or swap the two wires of the "
            "receiving pair."
        )
    return f"{port} is silent at {rates} baud: no dish answers. Its power may be off, or it is homing."


def _rate_of_log(findings: list[BaudFinding]) -> int | None:
    """Return the rate at which to listen for a log; None if noise says that nothing would be read."""
    for each in findings:
        if each.saw is Saw.TEXT:
            return each.baud
    longest = max(marked().values(), key=lambda protocol: protocol.model.boot_s).model.baud
    quiet = any(each.baud == longest and each.saw in (Saw.SILENCE, Saw.ECHO) for each in findings)
    return longest if quiet else None


def _answers_elsewhere(opening: OpenLink, port: str, clock: Clock, rate: int) -> bool:
    """Return whether a prompt answers at another rate than this one, too. Asked twice: one Enter may be lost."""
    other = next(each for each in _rates(None) if each != rate)
    for _ in range(2):
        link = opening(port, other)
        try:
            if probe(link, clock, other, tokens=known_tokens()).saw is Saw.PROMPT:
                return True
        finally:
            link.close()
    return False


def _of_log(baud: int, text: str) -> BaudFinding:
    return BaudFinding(baud, Saw.TEXT, "", len(text), 0.0, text=text)


def _opening(clock: Clock) -> OpenLink:
    def opening(port: str, baud: int) -> Link:
        return open_link(port, baud=baud, clock=clock)

    return opening


def _rates(first: int | None) -> tuple[int, ...]:
    """Return the rate of each firmware once: `first`, then the fastest first."""
    rates = sorted({each.model.baud for each in marked().values()}, reverse=True)
    return tuple(dict.fromkeys((*(() if first is None else (first,)), *rates)))
