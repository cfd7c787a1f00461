"""How many steps of the setup are done, without an engine: nothing is asked, and nothing is kept."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.config import Settings
from birdcage.base.paths import Paths
from birdcage.setup.context import SetupContext
from birdcage.setup.engine import STEPS
from birdcage.setup.step import Mark
from birdcage.station.access import FaceSession
from birdcage.station.known import list_ports, look_at_system


@dataclass(frozen=True, slots=True)
class StepTally:
    """Done of so many steps. Those that were skipped, or are for later, are not done."""

    done: int
    of: int


def count_steps(session: FaceSession, settings: Settings, paths: Paths) -> StepTally:
    """Count the steps that the dish shows to be done, or the file keeps as done where the dish does not tell.

    Any thread: it reads one state of the station.
    """
    bench = SetupContext(
        session, settings, paths, environ={}, flags={}, holder="", ports=list_ports, system=look_at_system
    )  # fmt: skip
    marks = [kind(bench).mark for kind in STEPS]
    return StepTally(marks.count(Mark.DONE), len(marks))
