"""The wiring as plain text of a given width: a small drawing of each plug, then cautions and symptoms."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from birdcage.setup.wiring import (
    BIAS,
    CAUTIONS,
    FOUR_WIRES,
    LINES,
    Connector,
    Drawing,
    Pin,
    adapters,
    symptoms,
)

NARROWEST = 40
"""Columns below which the drawings do not fit; the text is as wide as that, then."""
MORE = "Adapters, RS-422 and RS-485, bias and termination: `birdcage wiring adapters`."


def wiring_lines(connectors: Sequence[Connector], width: int = 80) -> list[str]:
    """Return all of it: these plugs, the cautions, what a wrong wire looks like. Plain ASCII."""
    width = max(width, NARROWEST)
    lines: list[str] = []
    for each in connectors:
        lines += [*connector_lines(each, width), ""]
    if any(each.pins for each in connectors):
        lines += ["CAUTIONS", *(line for text in CAUTIONS for line in _item(text, width)), "", *symptom_lines(width)]
        lines += ["", *textwrap.wrap(MORE, width)]
    return lines[:-1] if lines[-1:] == [""] else lines


def adapter_lines(width: int = 80) -> list[str]:
    """Return which adapters work, what tells the two kinds of line apart, bias and termination. Plain ASCII."""
    width = max(width, NARROWEST)
    lines = ["RS-422 AND RS-485", *textwrap.wrap(FOUR_WIRES, width)]
    for text in LINES:
        lines += _item(text, width)
    lines += ["", "ADAPTERS"]
    for each in adapters():
        lines += _item(f"{each.name}: {each.used_with}. {each.notes}", width)
    lines += ["", "TERMINATION AND BIAS"]
    for text in BIAS:
        lines += _item(text, width)
    return lines


def connector_lines(connector: Connector, width: int = 80) -> list[str]:
    """Return one plug: what it is, its drawing, who says so."""
    width = max(width, NARROWEST)
    lines = [f"{connector.dishes.upper()}"]
    for text in (connector.plug, connector.line):
        lines += textwrap.wrap(text, width - 2, initial_indent="  ", subsequent_indent="  ")
    lines.append("")
    if connector.pins:
        seen = f"Seen with the {connector.drawing.value}. The arrow leads to the terminal of a 4-wire RS-422 adapter:"
        lines += textwrap.wrap(seen, width, break_on_hyphens=False)
    lines += [f"  {line}" for line in drawing_lines(connector)]
    lines.append("")
    lines += _item(f"Source: {connector.supported_by}", width)
    for note in connector.notes:
        lines += _item(note, width)
    return lines


def drawing_lines(connector: Connector) -> list[str]:
    """Return the drawing of a plug with its contacts, at most 38 columns wide."""
    match connector.drawing:
        case Drawing.CLIP_AWAY:
            return _sideways(connector.pins)
        case Drawing.TIP_UP:
            return _upright(connector.pins)
        case Drawing.USB:
            return ["+-----------+", "| ========= |  USB A, rear", "+-----------+"]


def _sideways(pins: Sequence[Pin]) -> list[str]:
    rows = [f"| {pin.number} ==|  {pin.wire:7}{pin.signal:9}{_to(pin)}".rstrip() for pin in pins]
    return ["+------+", *rows, "+------+"]


def _upright(pins: Sequence[Pin]) -> list[str]:
    numbers = " ".join(str(pin.number) for pin in pins)
    bars = " ".join("|" for _ in pins)
    plug = [f"+-{'-' * len(numbers)}-+", f"| {bars} |", f"| {numbers} |", f"+---+{' ' * (len(numbers) - 6)}+---+"]
    plug.append(f"    |{'cable'.center(len(numbers) - 6)}|")
    return [*plug, "", *(f"{pin.number}  {pin.signal:9}{_to(pin)}".rstrip() for pin in pins)]


def _to(pin: Pin) -> str:
    return f"-> {pin.terminal}" if pin.terminal else ""


def symptom_lines(width: int = 80) -> list[str]:
    """Return what a wrong wire looks like from the computer."""
    lines = ["WHAT YOU SEE, AND WHAT IT MEANS"]
    for each in symptoms():
        lines += _item(f"{each.saw.value}: {each.cause} -> {each.remedy} ({each.supported_by})", width)
    return lines


def _item(text: str, width: int) -> list[str]:
    return textwrap.wrap(text, width, initial_indent="- ", subsequent_indent="  ", break_on_hyphens=False)
