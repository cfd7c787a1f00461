"""The plug drawn: which contact goes to which terminal of the adapter, with the cautions that belong to it."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.setup.wiring import ADAPTERS, BIAS, CAUTIONS, CONNECTORS, FOUR_WIRES, LINES, SYMPTOMS, Connector, Pin

from birdcage_tui.cell_text import wrap

Line = tuple[tuple[str, str], ...]
"""One row, as (ink, text) from the left."""
_WAYS = {"T": "◀──", "R": "──▶"}
"""From the computer to the dish, which is at the left, and back."""


def connectors_for(firmware: str | None) -> tuple[Connector, ...]:
    """Return the plugs to show: that of a known dish, or all."""
    own = tuple(each for each in CONNECTORS if firmware in each.firmwares)
    return own or CONNECTORS


def lines(connectors: Sequence[Connector], width: int) -> list[Line]:
    """Return the drawings, then cautions, what a wrong wire looks like, sources, adapters."""
    found: list[Line] = []
    for each in connectors:
        found += [*drawing(each, width), _blank()]
    for heading, texts in (
        ("Beware", CAUTIONS),
        ("What you see, and what it means", [f"{each.saw.value}: {each.cause}: {each.remedy}." for each in SYMPTOMS]),
        ("Notes", [note for each in connectors for note in (*each.notes, f"Source: {each.supported_by}")]),
        ("RS-422 and RS-485", [FOUR_WIRES, *LINES]),
        ("Adapters", [f"{each.name}: {each.used_with}. {each.notes}" for each in ADAPTERS]),
        ("Termination and bias", BIAS),
    ):
        found.append((("strong", heading),))
        for text in texts:
            found += _item(text, width)
        found.append(_blank())
    return found[:-1]


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


def _item(text: str, width: int) -> list[Line]:
    rows = _wrap(text, width - 2)
    return [(("dim", "· " if not index else "  "), ("text", row)) for index, row in enumerate(rows)]


def _wrap(text: str, width: int) -> list[str]:
    return wrap(text, max(width, 20)) or [""]


def _blank() -> Line:
    return (("text", ""),)
