"""What can be chosen about a simulated Carryout G2 beside what its kin have, too (`birdcage.sim.trk.knobs`).

Each field is an option of the address: `sim:g2?second_move=queue&seed=3`. Provenance tags as there.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.trk.knobs import TrkSettings


@dataclass(frozen=True, slots=True)
class G2Settings(TrkSettings):
    """The knobs of one simulated G2. Angles in degrees, times in seconds of dish time."""

    firmware: ClassVar[str] = "g2"
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **TrkSettings.choices,
        "di2conf": ("raw", "timeout"),
        "di2cs_bare": ("timeout", "parameter"),
        "latlon_unit": ("deg", "cdeg"),
        "ss_reply": ("integer", "axes"),
        "g_reply": ("none", "angles"),
        "position_unit": ("deg", "cdeg", "steps"),
        "scan_rssi": ("adc", "tuner"),
        "azscan_rssi": ("tuner", "adc"),
        "sweep_key": ("ignore", "abort"),
        "xponder_style": ("plain", "labelled", "blank"),
        "sleep": ("none", "silent", "wake"),
        "nvs_rows": ("known", "all"),
        "nvs_hex": ("either", "prefix", "decimal"),
        "unhomed_scan": ("deadlock", "error"),
    }

    # The menus DVB, PEAK, A3981, GPIO, EE, LATLON and DIPSWITCH.
    transponder: int = 15
    """The transponder tuned after power-on: 15, whose 1178 MHz is the one that the notes name
    (docs/reference/g2-signal.md, *Tuner*): assumed."""
    lock_counts: float = 30.0
    """Counts of `rssi` above the empty sky from which the tuner locks (assumed)."""
    lock_polarity: bool = True
    """Whether it locks only at the LNB voltage of the transponder: odd 13 V, even 18 V (noted: these are
    *visible* then)."""
    snr_counts: float = 15.0
    """Counts above the empty sky for each dB of SNR; without lock it says 0 (assumed)."""
    lnb_13v_counts: float = 0.0
    """What 13 V adds to the level of the empty sky in `rssi`: it differs between polarities, by how much in DVB no one
    measured (open)."""
    tuner_read_s: float = 0.05
    """Time of one look of the tuner in `table`, `tablex`, `diag`, `range`, `srch` and the menu PEAK (assumed)."""
    table_timeout_ms: int = 50
    """What `tabto` says after power-on (assumed)."""
    tuner_timeout_ms: int = 500
    """What `to` says after power-on (assumed)."""
    srch_moves: bool = True
    """Whether `srch` sets the dish's own search going, which NVS 20 TRUE forbids, or the tuner alone searches
    (assumed)."""

    switch_port: int = 0
    """A DiSEqC 2.x switch on the cable: the port, 1 to 4, that it stands at after power-on; 0 for no switch
    (noted)."""
    di2conf: str = "raw"
    """What `di2conf` says with no switch: `3 21180544 238 <4.5`, or RxReplyTimeout (docs/reference/g2-signal.md,
    *DiSEqC*)."""
    di2cs_bare: str = "timeout"
    """What `di2cs` without a port says: RxReplyTimeout, or that it needs one (docs/reference/g2-signal.md,
    *DiSEqC*)."""

    even_floor: float = 489.0
    """Counts of the empty sky in `rssits` at 18 V (noted)."""
    odd_floor: float = 235.0
    """Counts of the empty sky in `rssits` at 13 V (noted)."""
    peak_scale: float = 1.0
    """Counts of `rssits` for each count of `rssi` above the empty sky (assumed)."""
    peak_reach: float = 2.0
    """How far to either side, in degrees, `pw` and `pxy1` look for the peak (assumed)."""
    peak_step: float = 0.5
    """Their step in degrees (assumed)."""

    current_mode: str = "AUTO"
    """What `cm` of the motor drivers says: AUTO, HiZ or LoZ (noted)."""
    step_mode: str = "AUTO"
    """What their `sm` says (noted)."""
    step_size: int = 1
    """What their `ss` says: sixteenths of a full step (1/16 microstep, so 1, assumed: docs/reference/g2-commands.md,
    *A3981>*)."""
    ss_reply: str = "integer"
    """Whether `ss` prints that integer alone ("returns integer", noted) or one for each axis."""
    nvs_version: str = "1"
    """The NVS version that `id` of OS> prints (noted); the number is open. Empty for no such line (noted)."""
    stall_faults: bool = True
    """Whether a blocked axis shows as FAULT in `diag` until `reset` (assumed)."""

    pins_e: str = "0-7,12,24-28"
    """Pins of port E: 14 (noted: docs/reference/g2-commands.md, *GPIO>*); which, other than E0 to E5 and E24 to E28,
    is assumed."""
    pins_follow: bool = True
    """Whether D10 is the tuner's power and C18 the LNB at 18 V, both ways: likely, say the notes
    (docs/reference/g2-commands.md, *GPIO>*). That they follow is assumed."""
    eeprom_written: int = 32
    """Entries of the EEPROM, from 0 on, that read 0 from the factory; others fail until written (assumed)."""
    dip_raw: str = "ffffff01"
    """Pins of the DIP switches as `dipswitch` prints them: all up (noted)."""
    dip_code: int = 101
    """What the firmware makes of them: DISH 110, 119 and 129 W (noted). NVS 112 TRUE puts NVS 113 in its place
    (assumed)."""
    latlon_unit: str = "deg"
    """Whether `l` takes degrees or centidegrees; it keeps centidegrees (noted)."""
    latlon_first: float = -119.0
    """Slot in degrees east of the first pair of angles that `l` takes: one of those of DIP code 101 (assumed)."""
    latlon_second: float = -110.0
    """Slot of its second pair (assumed)."""

    # The menus MOT, STEP and ADC, where no source quotes what they do; and the sleep timer.
    g_reply: str = "none"
    """What `g` prints once it is there or was broken off: nothing, or both angles as `a` does (open)."""
    position_unit: str = "deg"
    """The unit of the second number of `sp` and `sw`: degrees, centidegrees or microsteps (open)."""
    sp_homes: bool = True
    """Whether an unhomed axis counts as homed once `sp` told it where it is (assumed)."""
    vms_blocks: bool = True
    """Whether `vms` keeps the shell busy until its time is over (open)."""
    motorboth_deg: float = 10.0
    """How far `motorboth` turns both motors, and back (assumed)."""
    pid_kp: float = 250.0
    pid_kv: float = 50.0
    pid_ki: float = 0.0
    """The gains of both axes in NVS 128 to 133. STEP> prints Kp=250 and Kv=50 (noted); their being saved, and Ki,
    are assumed."""
    els2a_most: int = 59652
    """The largest step count that `els2a` converts: times 36000 it still fits 32 bits (assumed)."""

    scan_span: float = 10.0
    """Degrees that a sweep covers when it is not told (assumed)."""
    scan_step_cdeg: int = 100
    """Centidegrees between two positions when it is not told (`Scan Delta:100`, noted)."""
    scan_read_s: float = 0.05
    """Time of one reading of a sweep (open)."""
    scan_rssi: str = "adc"
    """Whether the `RSSI:` of `scan` in ADC> counts as `rssi` of that menu does (`RSSI:<adc>`, noted) or as
    that of DVB>."""
    azscan_rssi: str = "tuner"
    """Whether the `RSSI:` of `azscan` and `azscanwxp` counts as `rssi` of DVB> does (519 to 547 in
    docs/reference/g2-motors.md, *Sweeps*) or as that of ADC>."""
    sweep_key: str = "ignore"
    """Whether a key breaks a sweep off (open): the shell reads only between commands (noted)."""
    azscan_rows: int = 2
    """How many sweeps `azscan` makes, to and fro, when it is given an elevation step (open)."""
    xponder_s: float = 0.1
    """Time to tune to the next transponder of `azscanwxp` (open)."""
    xponder_style: str = "plain"
    """How `azscanwxp` tells transponders apart: not at all (one line each, in order), by ` Xponder:<n>` at the end of
    the line, or by an empty line after each position (open)."""

    sleep: str = "none"
    """What comes after NVS 38 seconds without input: nothing; the console is silent until power-on; or the next byte
    wakes it and is lost (open)."""

    nvs_rows: str = "known"
    """Which rows NVS> has: those that a source names (noted), or all from 0 to 149. What the others are called, and
    what they hold, is made up: three of their lines have a form of their own (open)."""
    nvs_hex: str = "either"
    """How a row that prints `0x%08X` takes a value: with or without `0x`, with it alone, or as a decimal number up to
    its first letter, so that `0x7` is 0 (open)."""

    # The dish itself: how it homes, moves and tells.
    nvs20: bool = True
    """Saved value of NVS 20, *Disable Tracker Proc?* (written; factory default FALSE): 1, so it does not move by
    itself.

    With 0 it homes and searches for a satellite after every power-on; a dish that starts without `boot` has found one.
    A fresh dish out of its box is `boot=1&nvs20=0`: it boots, homes by itself and searches. One that has booted and
    was not able to home, its search on, is `boot=1&nvs20=0&home_fails=1`, or at once `unhomed=1&nvs20=0`: an unhomed
    dish does not search (assumed), and works once a person homes it.
    """
    unhomed_scan: str = "deadlock"
    """What the `scan` of the ADC menu does unhomed: hang for good (noted), or print the text of `unhomed_move`."""
    release_forgets: bool = True
    """Whether released motors count as not homed (assumed)."""
    release_sag: float = 3.0
    """How far the elevation sinks when the motors are released (assumed)."""
    rssi_read_s: float = 0.01
    """Time of one reading of `rssi <n>` (assumed)."""
    rssi_lead: str = "0 0"
    """The two integers that `rssi` prints before its named fields; their meaning is unknown (open)."""
    rssi_noise: float = 1.0
    """Standard deviation of one reading in counts (docs/reference/g2-signal.md, *Levels*)."""
    adc_floor: float = 235.0
    """Raw counts of the empty sky in the ADC menu (233 to 238, noted)."""
    adc_scale: float = 0.5
    """Raw counts of the ADC menu for each count of `rssi` (assumed)."""
    stream_s: float = 0.5
    """Time between two lines of a stream (assumed)."""
