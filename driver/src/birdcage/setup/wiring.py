"""Which wire goes where, as data: the plugs and adapters of all machines, cautions, symptoms.

TX is from the computer to the dish, RX from the dish to the computer; TA, TB, RA and RB are the terminals of an RS-422
adapter, A being plus. docs/wiring.md names the sources.
"""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.detection.probe import Saw
from birdcage.rotator.wiring import Adapter, Connector, Drawing, Pin
from birdcage.station.known import list_models, model_of

__all__ = [
    "BIAS", "CAUTIONS", "FOUR_WIRES", "LINES", "Adapter", "Connector", "Drawing", "Pin", "Symptom", "adapters",
    "connector", "connectors", "connectors_of", "spoken_behind", "symptoms",
]  # fmt: skip


@dataclass(frozen=True, slots=True)
class Symptom:
    """What a fault of the wires looks like from the computer."""

    saw: Saw
    cause: str
    remedy: str
    supported_by: str


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

BIAS = (
    "Termination: 120 ohm across a pair at its receiving end; the MAX490 module has it. Up to 3 m that is enough.",
    "Bias: without fail-safe, as in a MAX490, a receiver reads noise as bytes while no side drives the pair.",
    "On long lines and near motors pull its RX+ to 5 V and its RX- to ground, 560 ohm each.",
)

_SYMPTOMS = (
    Symptom(Saw.SILENCE, "TX+ and TX- are swapped", "swap the two wires of the TX pair", "an earlier project"),
    Symptom(Saw.SILENCE, "wrong baud rate", "listen at the other rates", "an earlier project"),
    Symptom(
        Saw.GARBAGE, "at the right rate: RX+ and RX- are swapped", "swap the two wires of the RX pair",
        "an earlier project",
    ),
    Symptom(Saw.GARBAGE, "wrong baud rate", "listen at the other rates", "as on any serial line"),
    Symptom(
        Saw.ECHO, "the adapter hears itself: two wires, half duplex", "use a 4-wire RS-422 adapter",
        "both READMEs wire four",
    ),
)  # fmt: skip

_PATIENCE_MIN = 3
"""How long a dish that was switched on is waited for, unless it is known to take longer."""


def connectors() -> tuple[Connector, ...]:
    """Return the plugs of all machines that are known."""
    return tuple(dict.fromkeys(each for facts in list_models() for each in facts.connectors))


def connectors_of(firmware: str | None) -> tuple[Connector, ...]:
    """Return those of one machine, none where it is on no serial line; all where it has none, or is not known."""
    facts = model_of(firmware)
    if facts is not None and not facts.baud:
        return facts.connectors
    return (facts.connectors if facts is not None else ()) or connectors()


def connector(key: str) -> Connector:
    """Return the plug called `key`; KeyError names those that there are."""
    known = connectors()
    for each in known:
        if each.key == key:
            return each
    raise KeyError(f"no plug {key!r} here; known: {', '.join(each.key for each in known)}")


def spoken_behind(plug: Connector) -> tuple[str, ...]:
    """Return what runs behind a plug, as `--firmware` has it."""
    return tuple(facts.firmware for facts in list_models() if plug in facts.connectors)


def adapters() -> tuple[Adapter, ...]:
    """Return the adapters that were used with any machine."""
    return tuple(dict.fromkeys(each for facts in list_models() for each in facts.adapters))


def symptoms() -> tuple[Symptom, ...]:
    """Return what each fault of the wires looks like."""
    slow = [plug for plug in connectors() if plug.starts_in_min > _PATIENCE_MIN]
    names = " or ".join(plug.dishes for plug in slow)
    longer = f" ({names}: {max(plug.starts_in_min for plug in slow)})" if slow else ""
    return (
        Symptom(
            Saw.SILENCE,
            "no power at the dish, plug out, shell deadlocked, or the dish is still starting",
            f"check power and plug; switch off and on; wait three minutes{longer}",
            "several owners",
        ),
        *_SYMPTOMS,
    )
