"""The switches of the stand-in dish: all that sources leave open about a G2's console, and all that a wire does."""

from __future__ import annotations

from dataclasses import dataclass, field

MENUS = (
    "root", "mot", "dvb", "nvs", "os", "a3981", "adc", "dipswitch", "eeprom", "gpio", "latlon", "peak", "step",
)  # fmt: skip
NAMES = {menu: menu.upper() for menu in MENUS} | {"root": "TRK", "eeprom": "EE"}
PROMPTS = {
    "plain": {menu: f"{name}>" for menu, name in NAMES.items()},
    "spaced": {menu: f"{name}> " for menu, name in NAMES.items()},
    "lower": {menu: f"{name}>".lower() for menu, name in NAMES.items()},
    "none": dict.fromkeys(MENUS, ""),
    "alike": dict.fromkeys(MENUS, ">"),
    "hash": {menu: f"{name}# " for menu, name in NAMES.items()},
    "renamed": {menu: f"{name}-12>" for menu, name in NAMES.items()} | {"root": "ACU-12>"},
}
UNHOMED = {
    "int": "2147483647",
    "decimals": "2147483647.00",
    "hundredths": "21474836.47",
    "negative": "-2147483648",
}
"""What an axis prints that was not homed. Sources say INT_MAX, and not in which form."""
LOG_LINES = (
    "GPS: no fix, 0 satellites",
    "dvb: blind scan 18000-24000 ksps, rolloff 0.35",
    "AGC 1873",
    "temp 31.5 C",
    "wrap check -180.00",
)


@dataclass(frozen=True)
class Habits:
    """One dish and one wire. As it stands: what sources say, and the tamest of what they leave open."""

    seed: int = 1

    # how it prints
    eol: str = "\r\n"
    echo: str = "on"
    """`on`, `off`, `upper`, `lower`."""
    echo_while_busy: bool = False
    """Whether what is typed while the shell works is echoed at once; else when the shell comes to it."""
    prompts: str = "plain"
    """A key of PROMPTS."""
    colour: bool = False
    """Prompts and numbers in ANSI colours, each prompt behind an erased line."""
    decimals: int = 2
    unhomed_as: str = "int"
    """A key of UNHOMED, or the text itself."""
    unknown_text: str = "Unknown command"
    range_text: str = "Angle out of range."
    move_answer: str = "angle"
    """`angle`, `empty`, `np` (as a Pathway X2), or the text that each move is answered with."""
    shows_turn: bool = False
    """Whether `a` prints azimuths outside 0 to 360."""

    # how it is reached
    baud: int = 115200
    latency_s: float = 0.002
    """Between a line's end and its answer."""
    jitter_s: float = 0.0
    """Up to so much more, each time another."""
    wire_s: float = 0.0
    """How late every byte is, either way."""
    pieces: bool = False
    """Whether what it says arrives in pieces of a few bytes, with gaps."""
    chatter_s: float = 0.0
    """How often a log line comes unasked, in mean; 0 for never."""
    chatter_in_reply: float = 0.0
    """How likely a log line comes in the midst of a reply, between two of its lines."""
    half_duplex: bool = False
    """Whether what is sent while it speaks is lost."""
    loss: float = 0.0
    """How likely a byte is lost, either way."""

    # how it moves
    az_speed: float = 65.0
    el_speed: float = 45.0
    accel: float = 400.0
    overshoot_deg: float = 0.0
    """How far beyond its target it comes to rest, in the direction of travel."""
    az_deg: float = 180.0
    el_deg: float = 45.0
    homed: bool = True
    homing_s: tuple[float, float] = (8.0, 2.0)
    second_same: str = "retarget"
    """What a move does while its own axis turns: `retarget`, `queue` (answered at once), `block` (answered when the
    axis rests), `refuse`, `ignore` (answered as if taken), `abort` (both axes halt, then it is carried out)."""
    second_other: str = "retarget"
    """The same while the other axis turns, where `retarget` is to move both."""
    query_blocks: bool = False
    """Whether `a` waits for the end of a motion as well."""
    busy_text: str = "Motor busy"
    """What it says where it refuses a second move."""
    takes_moves: bool = True
    """Whether a move that is answered is carried out at all."""

    # what it does by itself
    root_q: str = "prompt"
    """`prompt`, `unknown`, `dies`."""
    tracker: bool = False
    """Whether the tracker runs (NVS 20 FALSE): it homes at power-up, and then searches."""
    boot_s: float = 12.0
    sleep_s: float = 0.0
    """After how much quiet it sleeps (NVS 38); 0 for never."""
    asleep: str = "swallows"
    """`swallows` the line that wakes it, wakes `late` (two seconds), or is `deaf` until a power cycle."""
    nvs: dict[int, str] = field(default_factory=dict)
    """Rows that differ from the table."""
