"""How a machine is wired to a computer, as data: every machine tells its plugs in its `Facts`, Setup draws them.

TX is from the computer to the dish, RX from the dish to the computer; TA, TB, RA and RB are the terminals of an RS-422
adapter, A being plus.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Drawing(Enum):
    """How the plug is drawn."""

    CLIP_AWAY = "clip pointed away from you, contacts listed from top to bottom"
    TIP_UP = "pin side towards you, tip up, contacts from left to right"
    USB = "a USB A socket"


@dataclass(frozen=True, slots=True)
class Pin:
    """One contact."""

    number: int
    signal: str
    """As the source names it: `TX-`, `T/R-`, `GND`."""
    terminal: str
    """Where it goes at a 4-wire RS-422 adapter: `TB`; empty if nowhere."""
    wire: str = ""
    """The colour in the source's drawing; cables differ."""


@dataclass(frozen=True, slots=True)
class Connector:
    """One kind of plug, and what is known of it."""

    key: str
    """What `birdcage wiring` takes."""
    dishes: str
    plug: str
    drawing: Drawing
    line: str
    """The kind of line and its speed."""
    pins: tuple[Pin, ...]
    supported_by: str
    """Where the order of the pins comes from."""
    notes: tuple[str, ...]
    starts_in_min: int = 3
    """How long such a dish is silent at most after power-up."""


@dataclass(frozen=True, slots=True)
class Adapter:
    """What stands between the computer and the plug."""

    name: str
    used_with: str
    """With which dish it was used."""
    notes: str
