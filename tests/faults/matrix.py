"""Every cell of fault, dialect and moment."""

from __future__ import annotations

from birdcage.rotator import machines
from birdcage.sim.port import firmware_names

from .dish_faults import DISH_FAULTS
from .fault import DIALECTS, TIMED, Fault
from .fault_run import FaultRun
from .outcome import Outcome
from .wire_faults import WIRE_FAULTS

FAULTS = (*WIRE_FAULTS, *DISH_FAULTS)
SPOKEN = tuple(each for each in (*DIALECTS, *TIMED) if each in machines.names() and each in firmware_names())
"""The dialects that both the driver and the simulator speak."""
CELLS = tuple(
    (fault, dialect, when) for fault in FAULTS for dialect in SPOKEN
    for when in fault.moments if fault.meets(dialect, when)
)  # fmt: skip


def outcome(fault: Fault, dialect: str, when: str) -> Outcome:
    """Go through one cell."""
    return FaultRun(fault, dialect, when).run()
