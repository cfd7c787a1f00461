"""A simulated G2 and its station, on threads and a real clock: for programs that are not ours."""

from __future__ import annotations

import time

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.station.build import open_session
from birdcage.station.state import Activity

LOOK_S = 0.02
"""Between two looks at what another program, or the dish, does in its own time."""


class RealDish:
    """`session` runs; whoever serves it waits here for what becomes of it."""

    def __init__(self):
        self.session = open_session(
            port="sim:g2?seed=1", firmware="g2", baud=None, settings=load(None), paths=Paths.default(),
            clock=RealClock(), survey=False,
        )  # fmt: skip
        self.session.start()

    @property
    def state(self):
        return self.session.station.state

    def wait_for(self, good, within_s=30.0):
        end = time.monotonic() + within_s
        while not good(self.state):
            assert time.monotonic() < end, self.state
            time.sleep(LOOK_S)

    def wait_at(self, az_deg, el_deg):
        def there(state):
            here = state.position
            return state.activity is Activity.IDLE and (here.az_deg, here.el_deg) == pytest.approx(
                (az_deg, el_deg), abs=0.1
            )

        self.wait_for(there)
