"""What can be chosen about any simulated dish: what docs/reference/ marks as assumed or open, and faults.

The words written, read, noted, measured, assumed and open say who stands for a value, as docs/reference/consoles.md,
*How facts are tagged*, has them. Nothing may rely on the last two. A firmware adds its own in a subclass. Each field is
an option of the address: `sim:g2?root_q=kill&seed=3`.
"""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, ClassVar, TypeVar
from urllib.parse import parse_qsl

LINE_ENDS = {"crlf": b"\r\n", "lf": b"\n", "cr": b"\r"}


@dataclass(frozen=True, slots=True)
class Options:
    """What an address may say of a simulated thing: each field of a subclass is an option."""

    firmware: ClassVar[str] = ""
    """What its messages call it."""
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    """The values that an option may have, where it is one of a few words."""


@dataclass(frozen=True, slots=True)
class SimSettings(Options):
    """The knobs that every simulated dish has. Angles in degrees, times in seconds of dish time."""

    firmware: ClassVar[str] = "dish"
    reflector_in: ClassVar[tuple[float, float]] = (12.0, 12.0)
    """Width and height of its reflector in inches: they make its beam."""
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "stall": ("stop", "slip"),
        "root_q": ("error", "ignore", "kill"),
        "line_end": ("crlf", "lf", "cr"),
        "lf_after_cr": ("ignore", "line"),
        "stream_key": ("swallow", "keep"),
        "wrong_baud": ("silent", "garbage"),
    }

    seed: int = 1
    """Of every random figure: overshoot, noise, latency, faults, where an unhomed dish stands."""
    id: str = ""
    """Two ports opened with the same non-empty id in one process reach the same dish, one after the other."""
    unhomed: bool = False
    """Start with no axis homed, as after power-up (noted: docs/reference/g2.md, *Power-up*)."""
    boot: bool = False
    """Start at power-on: play the boot log, and do by itself what the firmware then does."""
    home_fails: bool = False
    """Whether homing at power-on fails, as with a dish still strapped for transport; later homing works (assumed)."""
    lat: float = 39.1
    """Latitude of the dish in degrees north; what it hears depends on it."""
    lon: float = -95.7
    """Longitude of the dish in degrees east."""
    heading: float = 0.0
    """True azimuth that the dish's own azimuth 0 points at."""
    tilt_north: float = 0.0
    """How far its azimuth axis leans to the north; 0 with `tilt_east` for a level base."""
    tilt_east: float = 0.0
    """How far it leans to the east."""
    collimation: float = 0.0
    """How far the beam looks to the left of where the dish points."""
    trees: str = ""
    """A line of trees, true azimuth and elevation from left to right: `150:5,160:22,190:22`; empty for none."""
    az: float = 0.0
    """Cable angle at the start (the home position is 0; assumed)."""
    el: float = 45.0
    """Elevation at the start."""
    overshoot: float = 1.0
    """Scale of the overshoot (noted: docs/reference/g2-motors.md, *Overshoot*); 0 for none."""
    backlash: float = 0.0
    """Play of both gears in degrees (assumed)."""
    stall: str = "stop"
    """Whether the firmware notices a blocked axis and stops, or goes on counting steps that are lost (assumed)."""

    root_q: str = "error"
    """What `q` does at the root: an unknown-command text, nothing, or killing the shell. It re-prompts on
    four dishes (written), and is noted to kill."""
    unknown_command: str = "Invalid command."
    """What it says to a word it does not know (open)."""
    bad_parameter: str = "Invalid parameter."
    """What it says to a number it cannot use (open)."""
    echo: bool = True
    """Whether typed characters come back (written in a terminal's log)."""
    line_end: str = "crlf"
    """What ends a line that the dish sends (assumed)."""
    lf_after_cr: str = "ignore"
    """Whether the LF of a CRLF is an empty second line (open)."""
    stream_key: str = "swallow"
    """Whether the `q` or Enter that ends a stream (noted: `q` or another command does) is gone, or read as input
    (assumed)."""
    wrong_baud: str = "silent"
    """What a program at another rate than the dish's meets: silence (noted for a G2), or garbage both ways
    (assumed)."""
    latency_min: float = 0.005
    latency_max: float = 0.02
    """How long the shell takes to answer anything (assumed)."""
    stow_az: float = 0.0
    """Cable angle to which `stow` turns (assumed)."""
    stow_el: float = 17.5
    """Elevation to which `stow` folds: the lower stop of a G2 (assumed)."""
    stow_blocks: bool = False
    """Whether `stow` keeps the shell busy until it is done (open)."""
    rssi_floor: float = 400.0
    """Counts of the empty sky high up (docs/reference/g2-signal.md, *Levels*: one unit; another has 500)."""
    pace_baud: int = 0
    """Bytes cross the wire at this baud rate, 8N1; 0 for at once. In real seconds whatever the clock's rate."""
    drop: float = 0.0
    """Probability that a byte is lost, each way."""
    double: float = 0.0
    """Probability that a byte arrives twice, each way."""
    garble: float = 0.0
    """Probability that a byte is replaced by a random one, each way."""
    delay: float = 0.0
    """Longest delay of a byte in real seconds, each way; order is kept."""


AnySettings = TypeVar("AnySettings", bound=Options)


def option_names(kind: type[SimSettings]) -> list[str]:
    """Return the names of all options of one kind of dish."""
    return [field.name for field in fields(kind)]


def parse_query(query: str, kind: type[AnySettings]) -> AnySettings:
    """Read `second_move=queue&seed=3`.

    Raises:
        ValueError: an option or a value that does not exist; the message names those that do.

    """
    given = parse_qsl(query, keep_blank_values=True, strict_parsing=bool(query))
    return from_options(dict(given), kind)


def from_options(options: Mapping[str, str], kind: type[AnySettings]) -> AnySettings:
    """Make settings of option names and their texts.

    Raises:
        ValueError: as `parse_query`.

    """
    types = {field.name: str(field.type) for field in fields(kind)}
    values: dict[str, Any] = {}
    for name, text in options.items():
        if name not in types:
            near = difflib.get_close_matches(name, types, n=3)
            hint = f"did you mean {' or '.join(near)}?" if near else f"there are {', '.join(types)}"
            raise ValueError(f"the simulated {kind.firmware} has no option {name!r}: {hint}")
        values[name] = _value(name, types[name], text, kind.choices.get(name))
    return kind(**values)


def _value(name: str, kind: str, text: str, choices: tuple[str, ...] | None) -> bool | int | float | str:
    if choices is not None:
        if text not in choices:
            raise ValueError(f"{name}={text}: it is one of {', '.join(choices)}")
        return text
    if kind == "bool":
        words = {"1": True, "true": True, "yes": True, "0": False, "false": False, "no": False}
        if text.lower() not in words:
            raise ValueError(f"{name}={text}: it is 1 or 0")
        return words[text.lower()]
    try:
        return int(text) if kind == "int" else float(text) if kind == "float" else text
    except ValueError:
        raise ValueError(f"{name}={text}: it is a {'whole number' if kind == 'int' else 'number'}") from None
