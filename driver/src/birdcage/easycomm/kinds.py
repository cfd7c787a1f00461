"""Which firmware answers, by its `VE`, and what is safe to send to it (`docs/reference/easycomm.md`, *Firmwares*)."""

from __future__ import annotations

from dataclasses import dataclass, replace

from birdcage.easycomm.facts import FACTS, RP2040_FACTS, STOCK_FACTS
from birdcage.easycomm.wire import AZIMUTH, SAFE_QUERY, SAFE_STOP
from birdcage.rotator.facts import Facts


@dataclass(frozen=True, slots=True)
class EasycommKind:
    """One of them."""

    facts: Facts
    query: str = SAFE_QUERY
    """What asks for the position, and moves nothing."""
    stop: str = SAFE_STOP
    names_both: bool = True
    """Whether a set has to name both axes: the stock firmware reads past the end of a line that names one."""
    decimals: int = 1
    """How many of an angle it is known to read."""
    homes: bool = False
    """Whether `RESET` finds a switch; else it is never sent."""
    lines: int = 1
    """How many lines may answer `query`, or `stop`: each line of the position may come twice."""
    stop_snaps: bool = False
    """Whether the targets in force after STOP are where the axes then stand."""


# `EL` and not `AZ`: with its first byte lost on the way, `AZ` is the RP2040's short word for `ZERO`.
RP2040 = EasycommKind(RP2040_FACTS, "EL", "STOP", names_both=False, decimals=2, stop_snaps=True)
STOCK = EasycommKind(STOCK_FACTS, decimals=2, homes=True)
OTHER = EasycommKind(
    replace(
        STOCK_FACTS, features={}, homing_s=None, never_homes=True, zero_at_power_up=(AZIMUTH,),
        stop_ladder=FACTS.stop_ladder, handling=FACTS.handling,
    ),
    lines=2,
)  # fmt: skip
"""Any other: it is asked and told only what all of them understand, and does not know by itself where it points."""


def kind_of(version: str) -> EasycommKind:
    """Return which firmware tells this version."""
    if version.startswith("SatNOGS-RP2040"):
        return RP2040
    return STOCK if version.startswith("SatNOGS-v") else OTHER
