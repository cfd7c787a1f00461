"""Which wire goes where, as data (reference section 1.1): plugs, adapters, cautions, symptoms.

TX is from the computer to the dish, RX from the dish to the computer; TA, TB, RA and RB are the terminals of an RS-422
adapter, A being plus. docs/wiring.md names the sources.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from birdcage.station.finding import Saw


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
    """`g2`, `travler`, `carryout`, `pro`: what `birdcage wiring` takes."""
    dishes: str
    plug: str
    drawing: Drawing
    line: str
    """The kind of line and its speed."""
    pins: tuple[Pin, ...]
    supported_by: str
    """Where the order of the pins comes from."""
    notes: tuple[str, ...]
    firmwares: tuple[str, ...] = ()
    """What runs behind this plug, as `--firmware` has it."""


@dataclass(frozen=True, slots=True)
class Adapter:
    """What stands between the computer and the plug."""

    name: str
    used_with: str
    """With which dish it was used."""
    notes: str


@dataclass(frozen=True, slots=True)
class Symptom:
    """What a fault of the wires looks like from the computer."""

    saw: Saw
    cause: str
    remedy: str
    supported_by: str


RJ_25 = (
    Pin(1, "GND", "GND"),
    Pin(2, "T/R-", "TB"),
    Pin(3, "T/R+", "TA"),
    Pin(4, "RXD-", "RB"),
    Pin(5, "RXD+", "RA"),
    Pin(6, "not used", ""),
)
"""The contacts of both dishes that have such a plug."""
OF_RJ_25 = "The READMEs of Gabe Emerson KL1FI for both dishes (Travler_Rotor, Carryout-Rotor), which agree."
BOTH_PAIRS = "Connect both pairs, T/R and RXD, to a 4-wire adapter."

CONNECTORS = (
    Connector(
        "g2",
        "Carryout G2",
        "RJ-12 (6P6C)",
        Drawing.CLIP_AWAY,
        "RS-422, two pairs, 115200 baud 8N1",
        (
            Pin(1, "GND", "GND", "white"),
            Pin(2, "TX-", "TB", "black"),
            Pin(3, "TX+", "TA", "red"),
            Pin(4, "RX-", "RB", "green"),
            Pin(5, "RX+", "RA", "yellow"),
            Pin(6, "not used", "", "blue"),
        ),
        "The drawing of Chris Davidson, who runs a G2 with it (winegard-sky-scan, docs/wiring_guide.png). The Trav'ler "
        "has the same order.",
        (
            "Supply: read its label. The voltage is not documented.",
            "At 9600, 19200, 38400 and 57600 baud a G2 is silent.",
        ),
        ("g2",),
    ),
    Connector(
        "travler",
        "Trav'ler (LG-2112)",
        'RJ-25 (6P6C), the port "Factory Only" of the indoor unit',
        Drawing.TIP_UP,
        "RS-485/422, two pairs, 57600 baud 8N1",
        RJ_25,
        OF_RJ_25,
        (
            "Supply: 12 V DC (RP-SK87) or about 50 V DC. Read its label.",
            BOTH_PAIRS,
        ),
        ("hal205",),
    ),
    Connector(
        "carryout",
        "Carryout of 2003",
        "RJ-25 (6P6C), on the control board under the radome",
        Drawing.TIP_UP,
        "RS-485/422, two pairs, 57600 baud 8N1",
        RJ_25,
        OF_RJ_25,
        (
            "Supply: 12 V DC, at least 1 A. Read its label.",
            BOTH_PAIRS,
            "It has no limit switches: at power-up its motors run into their end stops, and grind loudly.",
            "Homing and TV search take 10 to 15 minutes from power-up. No known command ends them.",
            "Leave its tracking enabled (menu nvs): without it the dish does not home either.",
            "No known command stops it: keep the 12 V switch in reach. birdcage does not drive it yet.",
        ),
        ("carryout",),
    ),
    Connector(
        "pro",
        "Trav'ler Pro (SK2DISH)",
        "USB A, at the rear of the indoor unit; cable USB A to A",
        Drawing.USB,
        "USB CDC (/dev/ttyACM0); the baud rate does not count",
        (),
        "The README of Gabe Emerson KL1FI (Travler-Pro-Rotor).",
        (
            "The rear socket only.",
            "No adapter, no pairs to swap: what a wrong wire does elsewhere does not happen here.",
            "birdcage never opens such a port at 1200 baud: many boards restart into their loader at that rate.",
        ),
    ),
)

CAUTIONS = (
    "Level: if the converter can be set to several TTL levels, set 5 V.",
    "TX is from the computer to the dish, RX from the dish to the computer.",
    "Count contacts, not colours: cables differ. A meter tells which contact is which.",
    "A is plus here, and B minus. Not every adapter agrees: either pair may need its two wires swapped.",
    "Switch the dish off before you change a wire.",
)

FOUR_WIRES = "Use an adapter with four signal wires: RS-422, or RS-485 with four wires (full duplex)."

LINES = (
    "RS-485 with two wires: both sides talk in turn on one pair. Such an adapter hears its own echo: do not use it.",
    "RS-422: a pair each way, one sender on each. The dishes here need this.",
    "RS-485 with four wires: wired like RS-422. Between one computer and one dish they are the same.",
)
"""What tells the two kinds of line apart."""

ADAPTERS = (
    Adapter("DSD TECH SH-U11, USB to RS-422 (FTDI FT232R)", "Carryout G2",
            "Five wires, ground included. FTDI chips carry a serial number: birdcage finds the port again by it."),
    Adapter("USB to RS-232, then DTECH RS-232 to RS-485/422", "Trav'ler, Carryout of 2003",
            "Connect the T/R pair and the RXD pair. If it has several TTL levels, set 5 V."),
    Adapter("ESP32 with DIYables RS-422 module (MAX490)", "Carryout G2",
            "A bridge to Wi-Fi. The module speaks 5 V, the ESP32 takes 3.3 V: divide what goes into RX2. "
            "docs/wiring.md tells how."),
)  # fmt: skip

BIAS = (
    "Termination: 120 ohm across a pair at its receiving end; the MAX490 module has it. Up to 3 m that is enough.",
    "Bias: without fail-safe, as in a MAX490, a receiver reads noise as bytes while no side drives the pair.",
    "On long lines and near motors pull its RX+ to 5 V and its RX- to ground, 560 ohm each.",
)

SYMPTOMS = (
    Symptom(
        Saw.SILENCE, "no power at the dish, plug out, shell deadlocked, or the dish is still starting",
        "check power and plug; switch off and on; wait three minutes (a Trav'ler or Carryout of 2003: fifteen)",
        "several owners",
    ),
    Symptom(Saw.SILENCE, "TX+ and TX- are swapped", "swap the two wires of the TX pair", "an earlier project, on a G2"),
    Symptom(Saw.SILENCE, "wrong baud rate", "listen at the other rates", "an earlier project, on a G2"),
    Symptom(
        Saw.GARBAGE, "at the right rate: RX+ and RX- are swapped", "swap the two wires of the RX pair",
        "an earlier project, on a G2",
    ),
    Symptom(Saw.GARBAGE, "wrong baud rate", "listen at the other rates", "as on any serial line"),
    Symptom(
        Saw.ECHO, "the adapter hears itself: two wires, half duplex", "use a 4-wire RS-422 adapter",
        "both READMEs wire four",
    ),
)  # fmt: skip


def connector(key: str) -> Connector:
    """Return the plug called `key`; KeyError names those that there are."""
    for each in CONNECTORS:
        if each.key == key:
            return each
    raise KeyError(f"no plug {key!r} here; known: {', '.join(each.key for each in CONNECTORS)}")
