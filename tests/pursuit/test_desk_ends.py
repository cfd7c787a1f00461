"""A desk with a thread of its own, which ends in order whenever that is."""

from __future__ import annotations

import threading

from birdcage.base.clock import RealClock
from birdcage.pursuit.desk import PursuitDesk
from birdcage.pursuit.desk_setup import DeskSetup


def test_one_that_is_closed_as_it_starts_ends_in_order(bench, begin_slowly):
    setup = DeskSetup(bench.paths.catalogue, lambda: bench.settings, bench.paths, bench.observer)
    desk = PursuitDesk(bench.station, RealClock(), setup, lambda _now: None)
    assert begin_slowly(desk.start, lambda: desk.close(5.0)) == []
    assert not any(thread.name == "pursuit" for thread in threading.enumerate())
    assert desk.crash is None
