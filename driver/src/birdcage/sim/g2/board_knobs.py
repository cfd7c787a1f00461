"""What can be chosen about a G2's tuner and about the chips around its processor.

Each field is an option of the address, as in `birdcage.sim.g2.knobs`. Provenance tags as in `birdcage.sim.settings`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.settings import Settings


@dataclass(frozen=True, slots=True)
class BoardSettings(Settings):
    """The knobs of the menus DVB, PEAK, A3981, GPIO, EE, LATLON and DIPSWITCH. Times in seconds of dish time."""

    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **Settings.choices,
        "di2conf": ("raw", "timeout"),
        "di2cs_bare": ("timeout", "parameter"),
        "latlon_unit": ("deg", "cdeg"),
        "ss_reply": ("integer", "axes"),
    }

    transponder: int = 15
    """The transponder tuned after power-on: 15, whose 1178 MHz is the one that document 001 names. [I]"""
    lock_counts: float = 30.0
    """Counts of `rssi` above the empty sky from which the tuner locks. [I]"""
    lock_polarity: bool = True
    """Whether it locks only at the LNB voltage of the transponder: odd 13 V, even 18 V ([S1] which are *visible*)."""
    snr_counts: float = 15.0
    """Counts above the empty sky for each dB of SNR; without lock it says 0. [I]"""
    lnb_13v_counts: float = 0.0
    """What 13 V adds to the level of the empty sky in `rssi`: it differs between polarities, by how much in DVB no one
    measured. [open]"""
    tuner_read_s: float = 0.05
    """Time of one look of the tuner in `table`, `tablex`, `diag`, `range`, `srch` and the menu PEAK. [I]"""
    table_timeout_ms: int = 50
    """What `tabto` says after power-on. [I]"""
    tuner_timeout_ms: int = 500
    """What `to` says after power-on. [I]"""
    srch_moves: bool = True
    """Whether `srch` sets the dish's own search going, which NVS 20 TRUE forbids, or the tuner alone searches. [I]"""

    switch_port: int = 0
    """A DiSEqC 2.x switch on the cable: the port, 1 to 4, that it stands at after power-on; 0 for no switch ([S1])."""
    di2conf: str = "raw"
    """What `di2conf` says with no switch: `3 21180544 238 <4.5` (section 7.3), or RxReplyTimeout (document 001)."""
    di2cs_bare: str = "timeout"
    """What `di2cs` without a port says: RxReplyTimeout (section 7.3), or that it needs one (document 001)."""

    even_floor: float = 489.0
    """Counts of the empty sky in `rssits` at 18 V (section 7.3, [S1])."""
    odd_floor: float = 235.0
    """Counts of the empty sky in `rssits` at 13 V (section 7.3, [S1])."""
    peak_scale: float = 1.0
    """Counts of `rssits` for each count of `rssi` above the empty sky. [I]"""
    peak_reach: float = 2.0
    """How far to either side, in degrees, `pw` and `pxy1` look for the peak. [I]"""
    peak_step: float = 0.5
    """Their step in degrees. [I]"""

    current_mode: str = "AUTO"
    """What `cm` of the motor drivers says: AUTO, HiZ or LoZ (section 7.3, [S1])."""
    step_mode: str = "AUTO"
    """What their `sm` says (section 7.3, [S1])."""
    step_size: int = 1
    """What their `ss` says: sixteenths of a full step (section 7.3: 1/16 microstep, so 1)."""
    ss_reply: str = "integer"
    """Whether `ss` prints that integer alone (section 7.3: "returns integer", [S1]) or one for each axis."""
    nvs_version: str = "1"
    """The NVS version that `id` of OS> prints ([S1]); the number is [open]. Empty for no such line ([B])."""
    stall_faults: bool = True
    """Whether a blocked axis shows as FAULT in `diag` until `reset`. [I]"""

    pins_e: str = "0-7,12,24-28"
    """Pins of port E: 14 (section 7.3); which, other than E0 to E5 and E24 to E28, is [I]."""
    pins_follow: bool = True
    """Whether D10 is the tuner's power and C18 the LNB at 18 V, both ways; document 001 calls it likely. [I]"""
    eeprom_written: int = 32
    """Entries of the EEPROM, from 0 on, that read 0 from the factory; others fail until written. [I]"""
    dip_raw: str = "ffffff01"
    """Pins of the DIP switches as `dipswitch` prints them: all up ([S1])."""
    dip_code: int = 101
    """What the firmware makes of them: DISH 110, 119 and 129 W ([S1]). NVS 112 TRUE puts NVS 113 in its place. [I]"""
    latlon_unit: str = "deg"
    """Whether `l` takes degrees or centidegrees; it keeps centidegrees ([S1])."""
    latlon_first: float = -119.0
    """Slot in degrees east of the first pair of angles that `l` takes: one of those of DIP code 101. [I]"""
    latlon_second: float = -110.0
    """Slot of its second pair. [I]"""
