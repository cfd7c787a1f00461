"""What can be chosen about a simulated Carryout of 2003 beside what every dish has (`birdcage.sim.settings`).

No byte of this console was ever published. Two public programs (Carryout-Rotor, Carryout-Radio-Telescope) and their
READMEs tell what is sent, and which tokens of the answer they read; all else is free. Each field is an option of the
address: `sim:carryout?second_move=abort&record_s=0.5`. The words in brackets as in
`docs/reference/consoles.md`, *How facts are tagged*.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.settings import SimSettings


@dataclass(frozen=True, slots=True)
class CarryoutSettings(SimSettings):
    """The knobs of one simulated Carryout of 2003. Angles in degrees, times in seconds of dish time."""

    firmware: ClassVar[str] = "carryout"
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **SimSettings.choices,
        "prompts": ("named", "alike"),
        "second_move": ("retarget", "queue", "block", "refuse", "abort"),
        "prompt_when": ("at_rest", "at_once"),
        "records": ("rest", "key"),
        "record_end": ("line", "cr"),
        "g_axes": ("together", "turn"),
        "out_of_range": ("refuse", "clamp"),
        "az_outside": ("refuse", "turn"),
        "unhomed_move": ("error", "deadlock"),
        "wrap": ("360", "455"),
        "search_move": ("end", "refuse"),
        "nvs_applies": ("restart", "save", "write"),
    }

    az: float = 180.0
    """Cable angle at the start."""
    overshoot: float = 0.0
    """Scale of the overshoot; nothing is known of one here."""

    boot_home_s: float = 60.0
    """How long homing takes after power-up (assumed)."""
    boot_text: bool = True
    """Whether it prints a line now and then as it starts, as others of the family do (assumed)."""
    search: bool = True
    """Whether homing is followed by the TV search (written: "depending on DIP switch settings")."""
    search_s: float = 660.0
    """How long the search goes on: with homing 10 to 15 minutes (written)."""
    search_move: str = "end"
    """What `g` meets while the dish searches: it ends the search, or is refused (open)."""
    searching: bool = False
    """Start in the middle of the search."""
    os_kills: bool = False
    """Whether a process that `os` quits can be the search: its owner found no way to end it (written)."""

    prompts: str = "named"
    """Whether the menus have prompts of their own, or all the same one (open)."""
    prompt_alike: str = ">"
    """The prompt of every menu, with `prompts=alike` (open)."""
    motor_help: str = ""
    """What `?` of the motor menu lists beside `q`, with commas: open, as all that is
    written is "manual motor movements and settings"."""

    second_move: str = "retarget"
    """What `g`, or any byte, meets while the motors run (open).

    `retarget`, `queue`, `refuse`: lines are read, and a new `g` is taken at once, taken after the move, or refused.
    `block`: nothing is read before the move is over. `abort`: any byte ends the move, as `g` of a Trav'ler does
    (written). A working program sends `q` right behind every `g` (written), which `abort` would not let move.
    """
    prompt_when: str = "at_rest"
    """When the prompt comes where lines are read: once the move is over or a byte came, or at once (open)."""
    g_axes: str = "together"
    """Whether `g` moves both axes at once, or azimuth first (open)."""
    record: str = "az = {az}   el = {el}"
    """A live record. Certain are: a token `el`, the azimuth three tokens before it and the elevation two after it, as
    integers in 0.01 degrees, when split at single blanks (read). Two tokens lie between; here both are empty
    (open)."""
    record_s: float = 0.2
    """Time between records (open)."""
    record_end: str = "line"
    """How a record ends: as any line, or with `cr`, which lets a terminal show it in place (open)."""
    record_last: bool = True
    """Whether the last record tells where the motors came to rest (assumed)."""
    records: str = "rest"
    """Whether records last as long as the motion (written: "while motors are running"), or a byte ends them
    (open)."""
    el_min: float = 22.0
    """Lowest elevation that it takes (written)."""
    el_max: float = 73.0
    """Highest elevation that it takes: NVS 102 as it comes (written)."""
    out_of_range: str = "refuse"
    """Whether a target beyond the limits is refused (written: "won't accept"), or moved to the limit (open)."""
    refusal_text: str = "Target out of range."
    """What it says when it refuses one; empty for nothing (open)."""
    az_outside: str = "refuse"
    """Whether azimuths outside 0..360 are refused, or turned into it. No program sends one (open)."""
    busy_text: str = "Motors busy."
    """What it says to a move that it does not take now; empty for nothing (open)."""
    unhomed_move: str = "error"
    """What a move of a dish that is not homed meets: `unhomed_text`, or a deadlock (open)."""
    unhomed_text: str = "Not calibrated."
    """What it says to one (open)."""
    stall_text: str = ""
    """What it says when a motor stalls on its way; empty for nothing (open)."""
    wrap: str = "360"
    """Where the cable ends: "undocumented". 360: azimuth never crosses north. 455: it goes the nearer way (open)."""
    speed: float = 20.0
    """Greatest speed of both axes in deg/s: assumed, from a program that takes three steps of a degree
    each second."""
    accel: float = 40.0
    """Acceleration of both axes in deg/s² (assumed)."""

    tracking_row: int = 20
    """The row of the settings memory that disables tracking, and with it homing. That there is one is written;
    the number is a G2's (assumed)."""
    nvs_applies: str = "restart"
    """When a changed setting counts: from the next start as in the family, once saved, or at once (assumed)."""
