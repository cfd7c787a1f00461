"""What can be chosen about a simulated Carryout G2: everything that the reference marks as inferred or unknown.

Provenance tags are those of the reference: [V] verbatim in a source, [P] parsed by a working script, [S1] stated by
the project's own notes, [I] inferred, [open] unknown: a guess that nothing may rely on. Each field is an option of
the address: `sim:g2?second_move=queue&seed=3`.
"""

from __future__ import annotations

import difflib
from dataclasses import dataclass, fields
from typing import Any
from urllib.parse import parse_qsl

CHOICES = {
    "second_move": ("retarget", "queue", "refuse", "block"),
    "root_q": ("error", "ignore", "kill"),
    "az_map": ("nearest", "home", "literal"),
    "az_print": ("wrapped", "cable"),
    "signed": ("relative", "absolute"),
    "out_of_range": ("error", "clamp"),
    "unhomed_move": ("error", "deadlock"),
    "stall": ("stop", "slip"),
    "unhomed_scan": ("deadlock", "error"),
    "line_end": ("crlf", "lf", "cr"),
    "lf_after_cr": ("ignore", "line"),
    "stream_key": ("swallow", "keep"),
    "wrong_baud": ("silent", "garbage"),
}
LINE_ENDS = {"crlf": b"\r\n", "lf": b"\n", "cr": b"\r"}


@dataclass(frozen=True, slots=True)
class Settings:
    """The knobs of one simulated dish. Angles in degrees, times in seconds of dish time."""

    seed: int = 1
    """Of every random figure: overshoot, noise, latency, faults, where an unhomed dish stands."""
    id: str = ""
    """Two ports opened with the same non-empty id in one process reach the same dish, one after the other."""
    unhomed: bool = False
    """Start with neither axis homed, as after power-on with NVS 20 TRUE (section 7.2, [S1])."""
    boot: bool = False
    """Start at power-on: play the boot log, and home unless NVS 20 is TRUE."""
    nvs20: bool = True
    """Saved value of NVS 20, *Disable Tracker Proc?* ([V]; factory default FALSE): 1, so it does not move by itself.

    With 0 it homes and searches for a satellite after every power-on; a dish that starts without `boot` has found one.
    A fresh dish out of its box is `boot=1&nvs20=0`: it boots, homes by itself and searches. One that has booted and
    was not able to home, its search on, is `boot=1&nvs20=0&home_fails=1`, or at once `unhomed=1&nvs20=0`: an unhomed
    dish does not search ([I]), and works once a person homes it.
    """
    home_fails: bool = False
    """Whether homing at power-on fails, as with a dish still strapped for transport; later homing works. [I]"""
    lat: float = 39.1
    """Latitude of the dish in degrees north; what it hears depends on it."""
    lon: float = -95.7
    """Longitude of the dish in degrees east."""
    heading: float = 0.0
    """True azimuth that the dish's own azimuth 0 points at; it is level."""

    second_move: str = "retarget"
    """What `a` does while that axis moves: retarget, queue, refuse (an error text) or block the shell. [open]"""
    root_q: str = "error"
    """What `q` does at the root: an unknown-command text, nothing, or killing the shell. [P] re-prompts, [S1] kills."""
    echo: bool = True
    """Whether typed characters come back ([V] in a terminal's log)."""
    line_end: str = "crlf"
    """What ends a line that the dish sends. [I]"""
    lf_after_cr: str = "ignore"
    """Whether the LF of a CRLF is an empty second line. [open]"""
    stream_key: str = "swallow"
    """Whether the `q` or Enter that ends a stream ([S1]: `q` or another command does) is gone, or read as input. [I]"""
    wrong_baud: str = "silent"
    """What a program at another rate than 115200 meets: silence ([S1] at 9600 to 57600), or garbage both ways. [I]"""
    latency_min: float = 0.005
    latency_max: float = 0.02
    """How long the shell takes to answer anything. [I]"""
    unknown_command: str = "Invalid command."
    """What it says to a word it does not know. [open]"""
    bad_parameter: str = "Invalid parameter."
    """What it says to a number it cannot use. [open]"""
    out_of_range: str = "error"
    """Whether a target beyond the limits is refused or moved to the limit. [open]"""
    out_of_range_text: str = "Angle out of range."
    """What it says when it refuses one. [open]"""
    busy_text: str = "Error: motor busy."
    """What it says when `second_move` is refuse. [open]"""
    unhomed_angle: str = "2147483647.00"
    """How `a` prints an axis that is not homed: INT_MAX [S1], its format [I]."""
    unhomed_move: str = "error"
    """What `a` does to an unhomed axis: `Step to Position EL angle error: 2147483647` [S1 text], or a deadlock."""
    unhomed_scan: str = "deadlock"
    """What the `scan` of the ADC menu does unhomed: hang for good ([S1]), or print the text of `unhomed_move`."""
    signed: str = "relative"
    """Whether `a 0 -0.5` and `a 0 +0.5` are relative moves ([S1]) or absolute angles (what section 2.8 assumes)."""

    az_map: str = "nearest"
    """The turn of the cable for an azimuth: the nearest that fits, that of home (-360 to 0), or as given. [I]"""
    az_print: str = "wrapped"
    """Whether `a` prints 0..360 or the cable's angle. [I]"""
    az_outside: bool = True
    """Whether azimuths outside 0..360 are taken. [open]"""
    az_speed: float = 0.0
    """Azimuth speed in deg/s instead of NVS 80; 0 for NVS."""
    el_speed: float = 0.0
    """Elevation speed in deg/s instead of NVS 85; 0 for NVS."""
    overshoot: float = 1.0
    """Scale of the overshoot of section 7.4 ([S1]); 0 for none."""
    backlash: float = 0.0
    """Play of both gears in degrees. [I]"""
    az: float = 0.0
    """Cable angle at the start (the home position is 0). [I]"""
    el: float = 45.0
    """Elevation at the start."""
    release_forgets: bool = True
    """Whether released motors count as not homed. [I]"""
    release_sag: float = 3.0
    """How far the elevation sinks when the motors are released. [I]"""
    stow_az: float = 0.0
    """Cable angle to which `stow` turns. [I]"""
    stow_el: float = 17.5
    """Elevation to which `stow` folds: the lower stop. [I]"""
    stow_blocks: bool = False
    """Whether `stow` keeps the shell busy until it is done. [open]"""
    stall: str = "stop"
    """Whether the firmware notices a blocked axis and stops, or goes on counting steps that are lost. [I]"""

    rssi_read_s: float = 0.01
    """Time of one reading of `rssi <n>`. [I]"""
    rssi_lead: str = "0 0"
    """The two integers that `rssi` prints before its named fields; their meaning is unknown. [open]"""
    rssi_floor: float = 400.0
    """Counts of the empty sky high up (section 7.6, one unit; another has 500)."""
    rssi_noise: float = 1.0
    """Standard deviation of one reading in counts (section 7.6)."""
    adc_floor: float = 235.0
    """Raw counts of the empty sky in the ADC menu (section 7.3: 233 to 238, [S1])."""
    adc_scale: float = 0.5
    """Raw counts of the ADC menu for each count of `rssi`. [I]"""
    stream_s: float = 0.5
    """Time between two lines of a stream. [I]"""
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


def option_names() -> list[str]:
    """Return the names of all options."""
    return [field.name for field in fields(Settings)]


def parse_query(query: str) -> Settings:
    """Read `second_move=queue&seed=3`.

    Raises:
        ValueError: an option or a value that does not exist; the message names those that do.

    """
    given = parse_qsl(query, keep_blank_values=True, strict_parsing=bool(query))
    return from_options(dict(given))


def from_options(options: dict[str, str]) -> Settings:
    """Make settings of option names and their texts.

    Raises:
        ValueError: as `parse_query`.

    """
    types = {field.name: str(field.type) for field in fields(Settings)}
    values: dict[str, Any] = {}
    for name, text in options.items():
        if name not in types:
            near = difflib.get_close_matches(name, types, n=3)
            hint = f"did you mean {' or '.join(near)}?" if near else f"there are {', '.join(option_names())}"
            raise ValueError(f"the simulated g2 has no option {name!r}: {hint}")
        values[name] = _value(name, types[name], text)
    return Settings(**values)


def _value(name: str, kind: str, text: str) -> bool | int | float | str:
    if name in CHOICES:
        if text not in CHOICES[name]:
            raise ValueError(f"{name}={text}: it is one of {', '.join(CHOICES[name])}")
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
