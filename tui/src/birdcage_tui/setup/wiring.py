"""The plug drawn: which contact goes to which terminal of the adapter, with the cautions that belong to it."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.setup.wiring import (
    BIAS,
    CAUTIONS,
    FOUR_WIRES,
    LINES,
    Connector,
    Pin,
    Symptom,
    adapters,
    symptoms,
)

from birdcage_tui.drawing.cell_text import wrap

Line = tuple[tuple[str, str], ...]
"""One row, as (ink, text) from the left."""
BEGUN, CONTINUED = ("dim", "· "), ("dim", "  ")
"""Before the first row of an item, and before its others."""
_WAYS = {"T": "◀──", "R": "──▶"}
"""From the computer to the dish, which is at the left, and back."""


def lines(connectors: Sequence[Connector], width: int) -> list[Line]:
    """Return the drawings, then cautions, what a wrong wire looks like, sources, adapters."""
    found: list[Line] = []
    seen = symptoms()
    for each in connectors:
        found += [*drawing(each, width), _blank()]
    for heading, texts in (
        ("Beware", CAUTIONS),
        *[
            (f"You see {saw.value}", [_symptom(each) for each in seen if each.saw is saw])
            for saw in dict.fromkeys(each.saw for each in seen)
        ],
        *[(f"Notes: {each.dishes}", each.notes) for each in connectors],
        ("RS-422 and RS-485", [FOUR_WIRES, *LINES]),
        ("Adapters", [f"{each.name}, for {each.used_with}. {each.notes}" for each in adapters()]),
        ("Termination and bias", BIAS),
    ):
        found.append((("strong", heading),))
        for text in texts:
            found += _item(text, width)
        found.append(_blank())
    return found[:-1]


def whole_items(found: Sequence[Line], room: int) -> int:
    """Return how many of the first `room` lines hold whole items: none is cut in mid-sentence, no heading is bare."""
    end = min(room, len(found))
    while end and end < len(found) and found[end][:1] == (CONTINUED,):
        end -= 1
    while end and (not found[end - 1] or found[end - 1][0][0] == "strong" or found[end - 1] == _blank()):
        end -= 1
    return end


def drawing(connector: Connector, width: int) -> list[Line]:
    """Return one plug: its name, its line, its contacts."""
    head: list[Line] = [(("strong", connector.dishes), ("dim", f"   {connector.plug}"))]
    if len(connector.dishes) + 3 + len(connector.plug) > width:
        head = [(("strong", connector.dishes),), *[(("dim", line),) for line in _wrap(connector.plug, width)]]
    head += [(("text", line),) for line in _wrap(connector.line, width)]
    if not connector.pins:
        return head
    caption = _wrap(f"{connector.drawing.value.capitalize()}:", width)
    return [*head, *[(("dim", line),) for line in caption], *contacts(connector)]


def contacts(connector: Connector) -> list[Line]:
    """Return the contacts alone: where each goes, and which way its signal runs."""
    colours = any(pin.wire for pin in connector.pins)
    return [
        (("line", "  ┌───┐"), ("dim", f"{'   wire  ' if colours else '  '} signal         adapter")),
        *[_contact(pin, colours=colours) for pin in connector.pins],
        (("line", "  └───┘"),),
    ]


def _contact(pin: Pin, *, colours: bool) -> Line:
    signal = pin.signal.upper()
    way = next((way for letter, way in _WAYS.items() if signal.startswith(letter)), "───")
    used = bool(pin.terminal)
    ink = "text" if used else "dim"
    return (
        ("line", "  │ "),
        ("strong" if used else "dim", str(pin.number)),
        ("line", " ╪══ " if used else " │   "),
        ("dim", f"{pin.wire:6} " if colours else ""),
        (ink, f"{pin.signal:8} "),
        ("dim", f" {way}  " if used else ""),
        ("accent-strong", pin.terminal),
    )


def _symptom(symptom: Symptom) -> str:
    return f"{symptom.cause[:1].upper()}{symptom.cause[1:]}? {symptom.remedy[:1].upper()}{symptom.remedy[1:]}."


def _item(text: str, width: int) -> list[Line]:
    rows = _wrap(text, width - 2)
    return [(BEGUN if not index else CONTINUED, ("text", row)) for index, row in enumerate(rows)]


def _wrap(text: str, width: int) -> list[str]:
    return wrap(text, max(width, 20)) or [""]


def _blank() -> Line:
    return (("text", ""),)
