"""The table of docs/faults.md: what the ordeals yield, in words for a person outdoors."""

from __future__ import annotations

import re

from .fault import TIMED, Fault
from .matrix import CELLS, outcome
from .outcome import Outcome
from .verdict import worst_link

UNREADABLE = "“an answer cannot be read”"
SHORT = (
    (r"The dish did not answer", "“The dish did not answer the command”"),
    (r"The (?:dish|machine) is silent", "“The dish is silent”"),
    (r"The dish answered .* and did not move", "“The dish did not move”"),
    (r"What arrives on|The (?:dish|machine) talks on|The rotator t(?:ells|old)", UNREADABLE),
    (r"Only our own|The dish answered|.*do not fit together", UNREADABLE),
    (r"The dish refused", "“The dish refused the command”"),
    (r".* is gone:", "“The port is gone”"),
    (r".* is not there", "“The port is not there. Plug it in”"),
    (r"The dish stands still", "“The dish stands still, away from its target”"),
    (r"The (\w+) is stalled", r"“The \1 is stalled”"),
    (r"The dish has restarted", "“The dish has restarted”"),
    (r"The dish moves unasked", "“The dish moves unasked”"),
    (r"The dish is busy with the last move", "“The dish is busy with the last move”"),
    (r"The dish no longer knows where it points", "“The dish no longer knows where it points”"),
    (r"The dish lost its position", "“The dish lost its position”"),
    (r"not homed", "“not homed”"),
    (r"initializing", "“initializing”"),
    (r"moving unasked|The motion was cancelled", ""),
)
"""How each sentence of the state begins, and what is left of it in the table."""
STOPS = {"at once": "STOP goes out at once", "after a look": "STOP looks, then goes out", "nothing": "STOP looks"}
PROVED = {True: "confirmed", False: "not confirmed", None: "rest not known"}
HEADER = """\
# When things go wrong

What you see and what birdcage does when a wire, an adapter or a dish misbehaves. Each fault is inflicted on a simulated
dish, at rest and in mid-move, and this is what came of it: `scripts/fault_table.py` writes this page, and a test holds
it to what the program does. In every row nothing false was shown, nothing moved unasked, and after
STOP no line that moves the dish left the port for a minute, however often a client asked.

A Pathway X1 or X2 does not tell where it points: a position without a fault is modelled, and marked so. What such a
dish does not say is not seen: where it moves unasked, its *modelled position is wrong*. No STOP is known for either.
Each has the rows in which it differs; faults of its readings have none, as it has no readings.

*Holds*: nothing moves the dish until you release it. *Confirmed*: the dish was seen at rest after STOP.

What happened in the last weeks, what it means and what to do: `birdcage health` ([Commands](commands.md#at-the-dish)).

| Fault | Dish | What you see | What birdcage does | Afterwards |
|---|---|---|---|---|
"""


def short(sentence: str) -> str:
    """Return what is left of a sentence of the state."""
    for pattern, words in SHORT:
        if found := re.match(pattern, sentence):
            return found.expand(words)
    return f"“{re.sub(r'-?[0-9]+([.][0-9]+)?', '…', sentence)}”"


def sees(seen: Outcome) -> str:
    """Return what a person reads."""
    words = [each for each in dict.fromkeys(map(short, seen.sees)) if each]
    if seen.position_hidden:
        words.append("no position")
    if seen.misled:
        words.append("a modelled position that is wrong")
    return "; ".join(words) or "Nothing: the next answer comes"


def does(seen: Outcome, *, tells: bool) -> str:
    """Return what the station does."""
    words = [{"lost": "Looks for the port", "silent": "Asks again"}.get(worst_link(seen), "")]
    if seen.motion != "-":
        words.append("the move arrives" if seen.motion == "arrives" else "the move is given up")
    words += ["holds"] if seen.held else []
    by_means = {
        "no link": "STOP finds no port", "end of move": "STOP waits for the end of the move",
        "none": "no STOP is known that ends it",
    }  # fmt: skip
    usual = STOPS[seen.stop.sends] if tells else "STOP sends nothing"
    stop = by_means.get(seen.stop.means, usual)
    words.append(f"{stop}, {PROVED[seen.stop.confirmed]}")
    text = "; ".join(each for each in words if each)
    return text[0].upper() + text[1:]


def afterwards(seen: Outcome) -> str:
    """Return how all is well again."""
    words = [f"You: {', '.join(seen.deeds)}" if seen.deeds else "By itself"]
    words.append("then it moves as asked" if seen.next_good == "right" else f"then it does not move: {seen.next_good}")
    return "; ".join(words)


def key(fault: Fault, dialect: str, when: str) -> str:
    """Return how the row of a cell begins."""
    return f"| {fault.title}, {when} | {dialect} | "


def row(fault: Fault, dialect: str, when: str, seen: Outcome) -> str:
    """Return the row of a cell."""
    return f"{key(fault, dialect, when)}{sees(seen)} | {does(seen, tells=dialect not in TIMED)} | {afterwards(seen)} |"


def page() -> str:
    """Go through the whole matrix and return the page."""
    rows = [row(*cell, outcome(*cell)) for cell in CELLS]
    return HEADER + "\n".join(rows) + "\n"
