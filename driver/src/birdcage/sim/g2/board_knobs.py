"""What can be chosen about a G2's tuner and about the chips around its processor.

Each field is an option of the address, as in `birdcage.sim.g2.knobs`. Provenance tags as in `birdcage.sim.settings`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.settings import SimSettings


@dataclass(frozen=True, slots=True)
class BoardSettings(SimSettings):
    """The knobs of the menus DVB, PEAK, A3981, GPIO, EE, LATLON and DIPSWITCH. Times in seconds of dish time."""

    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **SimSettings.choices,
        "di2conf": ("raw", "timeout"),
        "di2cs_bare": ("timeout", "parameter"),
        "latlon_unit": ("deg", "cdeg"),
        "ss_reply": ("integer", "axes"),
    }

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
