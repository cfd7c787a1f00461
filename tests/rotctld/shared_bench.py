"""A station with a simulated dish, shared by clients of the network protocol; one thread, a virtual clock."""

from __future__ import annotations

import pytest
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.rprt import RotctldError
from birdcage.rotctld.shared_dish import SharedDish

from tests.station.conftest import Bench

STARTS_S = {"g2": 3.0, "hal205": 12.0, "hal000": 12.0, "pro": 40.0, "carryout": 12.0}
"""How long each takes to answer, and to be looked at."""


def code_of(call, *args):
    """Return the code with which a call is refused."""
    with pytest.raises(RotctldError) as raised:
        call(*args)
    return raised.value.code


class SharedBench(Bench):
    """What the tests of the shared dish hold in their hands."""

    def __init__(self, firmware="g2", more="", station=None, **options):
        super().__init__(f"{firmware}?seed=1{'&' if more else ''}{more}", station or {}, firmware)
        self.shared = SharedDish(self.station, RotctldOptions(**options))
        self.started = STARTS_S[firmware]

    def join(self, *names):
        """Connect clients; the dish answers, and is looked at."""
        clients = [self.shared.client(name) for name in names]
        if self.state.link.since == 0.0 or not self.opened:
            self.connect(self.started)
            self.run(2.0)
        return clients[0] if len(clients) == 1 else clients

    def run(self, seconds):
        """Let time pass, with the server's turns in between."""
        for _ in range(max(1, round(seconds / 0.1))):
            self.step(0.1)
            self.shared.tick()

    def settle(self, seconds=60.0):
        """Let the dish come to rest."""
        end = self.clock.monotonic() + seconds
        self.run(0.3)
        while self.state.motion is not None and self.clock.monotonic() < end:
            self.run(0.2)
        assert self.state.motion is None, self.state.motion
        self.run(1.5)

    def wait_for(self, future, seconds=20.0):
        """Let time pass until a future is done."""
        end = self.clock.monotonic() + seconds
        while not future.done() and self.clock.monotonic() < end:
            self.run(0.1)
        assert future.done()

    def view(self, name):
        return next(view for view in self.shared.views() if view.name == name)

    def sent_moves(self):
        return self.moves_since(0.0)
