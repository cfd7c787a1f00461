"""What the bytes on an open port speak for, observation by observation."""

from __future__ import annotations

from dataclasses import replace

from birdcage.detection.probe import BaudFinding, Saw
from birdcage.setup.case import Case, Cause

RATES_NAMED = 3
"""Rates that are listed one by one; of more, their number is told."""
DRAWING = "`birdcage wiring` draws the plug."


def _power_cycle(case: Case) -> str:
    return f"Switch the dish's power off, wait ten seconds, switch it on, and give it {case.patience} to start."


def prompt(case: Case) -> list[Cause]:
    """A prompt came: at another rate, or at this one since."""
    present, found = case.findings[0], _first(case, Saw.PROMPT)
    if found.baud != present.baud:
        return [
            _use(found, f"At {found.baud} baud it shows its prompt `{found.sample}`, at {present.baud} it does not.")
        ]
    return [
        Cause(
            "It answers now", f"A prompt came at {found.baud} baud: `{found.sample}`. The dish was starting or busy.",
            "Wait some seconds. If it stays silent, choose the firmware that shows this prompt.", likely=True,
        )
    ]  # fmt: skip


def text(case: Case) -> list[Cause]:
    """Readable text came, and no prompt."""
    present, found = case.findings[0], _first(case, Saw.TEXT)
    quoted = f"At {found.baud} baud came text: `{found.sample}`."
    causes = [] if found.baud == present.baud else [_use(found, quoted)]
    starting = "No prompt yet. A dish that starts prints its boot text, homes, and only then answers."
    return [
        *causes,
        Cause("The dish is starting", f"{quoted} {starting}", f"Wait up to {case.patience}.", likely=not causes),
        Cause(
            "Something else is on this port", f"{quoted} A modem or a GPS receiver talks like that too.",
            "Compare the text. `birdcage ports` lists the other ports.", likely=False,
        ),
    ]  # fmt: skip


def garbage(case: Case) -> list[Cause]:
    """Bytes came that are no text."""
    seen = f"Bytes that cannot be read at {_at(case.rates(Saw.GARBAGE))}."
    own, present = case.firmware_baud, case.findings[0].baud
    at_own_rate = own is not None and own in case.rates(Saw.GARBAGE)
    elsewhere = own is not None and own != present and not at_own_rate
    return [
        Cause(
            "Wrong baud rate",
            f"{seen} {f'This firmware speaks at {own}.' if own else 'Which rate this dish speaks is not known.'}",
            _mend(case, own) if own is not None and elsewhere else "Try the other rates.",
            likely=not at_own_rate, use_baud=own if elsewhere and case.sets_rate else None,
        ),
        Cause(
            "The receiving pair is swapped",
            f"{seen} {'This firmware speaks at this rate; ' if at_own_rate else 'At the right rate '}"
            "Swapped RX+ and RX- look like this: every bit is inverted.",
            f"Swap the two wires of the receiving pair, those from the dish. {DRAWING}",
            likely=at_own_rate and not case.answered_before,
        ),
        Cause(
            "The level is not 5 V", f"{seen} A converter set to another TTL level reads edges wrongly.",
            "If the converter has a switch or jumper for its level, set it to 5 V.", likely=False,
        ),
        Cause(
            "The receiving pair is open", f"{seen} A receiver with an open pair may read noise as bytes.",
            f"Check the plug and both wires of the receiving pair. {DRAWING}", likely=False,
        ),
    ]  # fmt: skip


def echo(case: Case) -> list[Cause]:
    """Nothing but our own byte came back."""
    rates = case.rates(Saw.ECHO)
    seen = f"Only our own Enter came back at {_at(rates)}."
    everywhere = len(case.findings) > 1 and len(rates) == len(case.findings)
    one_of_many = len(case.findings) > 1 and len(rates) == 1
    itself = "An adapter with two wires (half duplex) does that"
    taken = "At one rate alone: something there takes it." if one_of_many else "A dish may echo what it does not do."
    return [
        Cause(
            "The adapter hears itself",
            f"{seen} {itself}{', at each rate alike; no dish does.' if everywhere else '.'}",
            f"Use a 4-wire RS-422 adapter, or switch its echo off, and connect both pairs. {DRAWING}",
            likely=not one_of_many,
        ),
        Cause(
            "The dish's shell is deadlocked",
            f"{seen} {taken}",
            f"No command can end that. {_power_cycle(case)}",
            likely=one_of_many or case.answered_before,
        ),
    ]


def silence(case: Case) -> list[Cause]:
    """Nothing came, or the port was not listened to yet."""
    seen = f"Silence at {_at(case.rates(Saw.SILENCE))}." if case.findings else case.seen
    before = case.answered_before
    starting = Cause(
        "The dish is starting",
        "Its boot text came." if case.restarted else f"{seen} After power-up it is silent while it homes.",
        f"Wait up to {case.patience}." + ("" if case.restarted else " Then listen again."),
        likely=case.restarted or not before,
    )
    causes = [
        _wrong_rate(case, seen),
        Cause(
            "The dish has no power", seen, "Is its power on? Look at its lamp or its motor.",
            likely=True,
        ),
        Cause(
            "The cable is out", f"{seen} The adapter is there. birdcage can't see the wires behind it.",
            "Check both ends: the plug at the dish, and the terminals of the adapter.", likely=True,
        ),
        starting,
        Cause(
            "The sending pair is swapped",
            f"{seen} With TX+ and TX- swapped the dish understands nothing and stays silent."
            + (" It has answered before, so its wires were right." if before else ""),
            f"Swap the two wires of the sending pair, those to the dish. {DRAWING}", likely=not before,
        ),
        Cause(
            "The dish's shell is deadlocked",
            f"{seen} " + ("It has answered before. " if before else "")
            + "Some commands end its shell for good: a scan while it is not homed, perhaps a `q` at its root menu.",
            f"No command can end that. {_power_cycle(case)}", likely=before,
        ),
    ]  # fmt: skip
    if not case.restarted:
        return causes
    return [starting, *(replace(each, likely=False) for each in causes if each is not starting)]


def _wrong_rate(case: Case, seen: str) -> Cause:
    tried, own = {each.baud for each in case.findings}, case.firmware_baud
    title = "Wrong baud rate"
    if own is not None and own in tried:
        why = f"{seen} This firmware speaks at {own}, which was tried. Another one may not."
        return Cause(title, why, "Choose another firmware if this dish is another one.", likely=False)
    if own is not None and tried:
        why = f"{seen} This firmware speaks at {own}, and a dish may be silent at any other rate."
        return Cause(title, why, _mend(case, own), likely=True, use_baud=own if case.sets_rate else None)
    why = f"{seen} A dish may be silent at any rate but its own."
    return Cause(title, why, "Listen at the other rates.", likely=len(tried) < 2 and not case.answered_before)


def _mend(case: Case, baud: int) -> str:
    return f"Use {baud} baud." if case.sets_rate else f"Set {baud} baud at the serial server."


def _use(found: BaudFinding, why: str) -> Cause:
    return Cause("Wrong baud rate", why, f"Use {found.baud} baud.", likely=True, use_baud=found.baud)


def _first(case: Case, saw: Saw) -> BaudFinding:
    return next(each for each in case.findings if each.saw is saw)


def _at(rates: tuple[int, ...]) -> str:
    if len(rates) > RATES_NAMED:
        return f"{len(rates)} baud rates"
    return f"{', '.join(map(str, rates))} baud"
