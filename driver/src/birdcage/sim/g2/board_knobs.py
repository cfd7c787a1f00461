"""What can be chosen about a G2's tuner and about the chips around its processor.

Each field is an option of the address, as in `birdcage.sim.g2.knobs`. Provenance tags as in `birdcage.sim.settings`.
"""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.sim.settings import Settings


@dataclass(frozen=True, slots=True)
class BoardSettings(Settings):
    """The knobs of the tuner, the receiver's pins and the motor drivers. Times in seconds of dish time."""

    transponder: int = 15
    """The transponder tuned after power-on: 15, whose 1178 MHz is the one that document 001 names. [I]"""
    lock_counts: float = 30.0
    """Counts of `rssi` above the empty sky from which the tuner locks. [I]"""
    lock_polarity: bool = True
    """Whether it locks only at the LNB voltage of the transponder: odd 13 V, even 18 V ([S1] which are *visible*)."""
    snr_counts: float = 15.0
    """Counts above the empty sky for each dB of SNR; without lock it says 0. [I]"""
    lnb_13v_counts: float = 0.0
    """What 13 V adds to the level of the empty sky in `rssi`: it differs between polarities, by how much in DVB nobody
    measured. [open]"""
