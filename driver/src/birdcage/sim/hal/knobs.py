"""What can be chosen about a simulated Trav'ler beside what every dish has (`birdcage.sim.settings`).

No byte of this console was ever captured: texts and layouts are free. Each field is an option of the address:
`sim:hal205?prompts=alike&wrap=360`. The words in brackets as in `docs/reference/travler.md`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.hal.memory import PRO_ROWS, ROWS, SAFE_MINIMUM, SEARCH_MINIMUM, HalSetting
from birdcage.sim.settings import SimSettings


@dataclass(frozen=True, slots=True)
class HalSettings(SimSettings):
    """The knobs of one simulated Trav'ler. Angles in degrees, times in seconds of dish time."""

    firmware: ClassVar[str] = "hal205"
    reflector_in: ClassVar[tuple[float, float]] = (33.0, 23.0)
    nvs_rows: ClassVar[Mapping[int, HalSetting]] = ROWS
    floor_row: ClassVar[int] = SAFE_MINIMUM
    """Which of them holds the lowest elevation of its moves."""
    page_rows: ClassVar[int] = 0
    """How many rows `d` shows at a time; 0 for all."""
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **SimSettings.choices,
        "prompts": ("named", "alike"),
        "boot_line": ("nolnb", "nogps", "none"),
        "a_layout": ("line", "lines"),
        "az_print": ("wrapped", "cable"),
        "wrap": ("455", "360", "0"),
        "below_floor": ("unreliable", "refuse", "clamp"),
        "out_of_range": ("error", "clamp"),
        "unhomed_move": ("error", "deadlock"),
        "g_order": ("az_el_sk", "az_sk_el"),
        "g_axes": ("together", "turn"),
        "g_queue": ("drop", "wait"),
        "abort_key": ("swallow", "keep"),
        "abort_prompt": ("at_once", "at_rest"),
    }

    az: float = 180.0
    """Cable angle at the start, 0 to 455."""
    el: float = 45.0
    """Elevation at the start."""
    sk: float = 90.0
    """Skew at the start (assumed)."""
    overshoot: float = 0.0
    """Scale of the overshoot; nothing is known of one here."""
    stow_el: float = 0.0
    """Elevation to which `stow` folds: flat (written); the figure (assumed)."""

    searching: bool = False
    """Start in the middle of the TV search. Without it, and without `boot`, the search has been stopped long ago."""
    search_finds: bool = True
    """Whether the search may end at a satellite; else it sweeps until it is stopped (assumed)."""
    search_speed: float = 20.0
    """Azimuth rate of the search in deg/s (assumed)."""
    search_text: str = ""
    """Printed at the beginning of every sweep, if anything is (open)."""
    found_text: str = ""
    """Printed when the search ends at a satellite, if anything is (open)."""
    search_stopped_text: str = "Search stopped."
    """What `s` of the search menu answers (open)."""
    boot_home_s: float = 120.0
    """How long homing takes after power-up: shorter than the 10 to 15 minutes of a Carryout (noted); the figure
    (assumed)."""
    boot_line: str = "nolnb"
    """The line that ends homing: `No LNB Voltage` (noted), `NoGPS` (read), or none, as with a GPS (written)."""

    head: str = "HAL 2.05.003"
    """The first line of its boot log (assumed)."""
    prompts: str = "named"
    """Whether the menus have prompts of their own, or all the same one (open)."""
    prompt_root: str = "TRK>"
    prompt_motor: str = "MOT>"
    prompt_ngsearch: str = "NGSEARCH>"
    prompt_nvs: str = "NVS>"
    prompt_alike: str = ">"
    """The prompts: that of the motor menu (assumed), the others (open)."""

    a_layout: str = "line"
    """Whether `a` prints all in one line (noted), or a line for each axis (assumed). The tokens are (read)."""
    az_print: str = "wrapped"
    """Whether `a` prints azimuth as 0..360 (written), or as the cable's angle (assumed)."""
    wrap_label: str = "WRAP ="
    """What stands before the wrap position in the answer to `a` (that it is there: written; its text: assumed)."""
    ack: str = "OK"
    """What `a <id> <deg>` answers; empty for nothing (assumed)."""
    g_text: str = ""
    """What `g` prints as it begins; empty for nothing (open)."""
    wrap: str = "455"
    """Where the cable ends: usually 360 or 455 (written). 0: the wrap position goes from 455 to 0 once north was
    crossed, and the next move goes back a whole turn (that it happens: written; when: assumed)."""
    below_floor: str = "unreliable"
    """What a target below NVS 127 does: end somewhere above it (noted: "unreliable"), a refusal, or the floor
    (assumed)."""
    el_max: float = 90.0
    """Highest elevation that it takes (noted)."""
    el_stop: float = 93.0
    """Where its mechanics end at the top: beyond 90 (written); the figure (assumed)."""
    out_of_range: str = "error"
    """Whether other targets beyond the limits are refused or moved to the limit (open)."""
    out_of_range_text: str = "Angle out of range."
    """What it says when it refuses one (open)."""
    az_outside: bool = True
    """Whether azimuths outside 0..360 are taken: the public scripts send -0.5 (written). Their effect is (open)."""
    unhomed_angle: str = "2147483647.00"
    """How `a` prints an axis that is not homed; known of a G2 only (open)."""
    unhomed_move: str = "error"
    """What a move of an unhomed axis meets: `unhomed_text`, or a deadlock (open)."""
    unhomed_text: str = "Motor not calibrated."
    """What it says to one (open)."""
    stall_text: bool = True
    """Whether stalls and failed homing are told on the console, or only on the indoor unit's display (assumed)."""

    g_order: str = "az_el_sk"
    """The order of the numbers of `g`; some firmware's help has az, sk, el (written)."""
    g_axes: str = "together"
    """Whether `g` moves azimuth and elevation at once (written: "combined") or in turn (assumed)."""
    g_queue: str = "drop"
    """Whether `g` drops the moves of `a` under way and queued (written: "immediate"), or waits for them (assumed)."""
    abort_key: str = "swallow"
    """Whether the byte that aborts `g` is gone, or read as input (assumed)."""
    abort_prompt: str = "at_once"
    """When the prompt comes after an abort: at once, or when the motors have come to rest (assumed)."""
    speed: float = 0.0
    """Greatest speed of azimuth and elevation in deg/s, instead of the measured times; 0 for those (assumed)."""
    accel: float = 40.0
    """Acceleration of all axes in deg/s², and so how soon an aborted `g` comes to rest (assumed)."""


@dataclass(frozen=True, slots=True)
class Hal000Settings(HalSettings):
    """The knobs of one with HAL 0.0.00: what differs from HAL 2.05."""

    firmware: ClassVar[str] = "hal000"
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {**HalSettings.choices, "boot_line": ("nogps", "none")}

    boot_line: str = "nogps"
    """The line that ends homing: `NoGPS` (read), or none, as with a GPS (written)."""
    head: str = "HAL 0.0.00"
    a_layout: str = "lines"
    """Whether `a` prints a line for each axis, or all in one (both assumed)."""
    prompt_os: str = "OS>"
    """The prompt of the menu of tasks (open)."""
    search_stopped_text: str = "Task killed."
    """What `kill Search` answers (open)."""
    no_task_text: str = "No such task."
    """What `kill` says of a task that does not run (open)."""


@dataclass(frozen=True, slots=True)
class ProSettings(Hal000Settings):
    """The knobs of a Trav'ler Pro: what differs from HAL 0.0.00, and its indoor unit with the tunnel."""

    firmware: ClassVar[str] = "pro"
    nvs_rows: ClassVar[Mapping[int, HalSetting]] = PRO_ROWS
    floor_row: ClassVar[int] = SEARCH_MINIMUM
    page_rows: ClassVar[int] = 3
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **Hal000Settings.choices,
        "boot_line": ("none",),
        "odu_q": ("error", "ignore", "kill", "leave"),
        "too_high": ("lock_up", "stall"),
    }

    boot_line: str = "none"
    head: str = "IDU ready"
    prompt_root: str = "IDU>"
    prompt_odu: str = "ODU>"
    """The prompt of the outdoor unit, behind the tunnel (open)."""
    odu_q: str = "error"
    """What `q` does in the outdoor unit's own menu: its program sends it there and goes on (written), so an error or
    nothing; that it kills the shell or leads back through the tunnel is possible (open)."""
    homes: bool = True
    """Whether it homes at power-up: not all of them do (written). Without, it knows where it stands (assumed)."""
    el_stop: float = 75.3
    """Where its elevation stalls: past 75 (written); the figure (assumed)."""
    too_high: str = "lock_up"
    """What follows a stall up there: silence until a power cycle ("may lock up": written), or nothing more."""
    gap_s: float = 0.9
    """A line that begins sooner after one to the indoor unit is lost, one that follows `odu`, too; its program waits
    1 s (written). 0 for none."""
    odu_gap_s: float = 0.0
    """The same behind the tunnel: its program sends Enter, `q`, Enter, `mot` there without a pause (written)."""
    motor_gap_s: float = 0.0
    """The same in the motor menu, where its program waits for nothing (written)."""
