"""The twins of our own dishes: simulated ones."""

from __future__ import annotations

from birdcage.base.errors import LinkError
from birdcage.link.link import Link
from birdcage.sim.port import SimPort, open_device
from birdcage.testing import SeenCommand, Truth, Twin


class SimTwin(Twin):
    """A dish of `birdcage.sim` at an address; `moves` tells which axes a line of its console names."""

    def __init__(self, clock, address, moves):
        self.clock, self._moves = clock, moves
        self.device = open_device(address, clock=clock)

    def dial(self, address, baud):
        try:
            return Link(SimPort(self.device, address, baud=baud), self.clock)
        except ConnectionError as error:
            raise LinkError(str(error), reason="missing") from error

    def truth(self):
        truth = self.device.truth()
        return Truth(truth.az_deg, truth.el_deg, truth.moving)

    def taken(self):
        with self.device.lock:
            self.device.machine.run()
            lines = [(at, self._moves(line)) for at, line in self.device.shell.received]
        return [SeenCommand(at, frozenset(motors)) for at, motors in lines if motors]

    def received(self):
        with self.device.lock:
            self.device.machine.run()
            return len(self.device.shell.received)

    def unplug(self):
        self.device.unplug()

    def plug(self):
        self.device.plug()

    def _silence(self, silent):
        self.device.wire.to_dish.silent = self.device.wire.to_host.silent = silent

    def mute(self):
        self._silence(True)

    def unmute(self):
        self._silence(False)

    def is_wrecked(self):
        return not self.device.truth().shell_alive


def moved_by(line):
    """Which axes a line sets in motion, on either of our dishes."""
    words = line.split()
    if len(words) >= 3 and words[0] == "a":
        return {int(words[1])}
    if words[:1] == ["g"]:
        return {0, 1}
    return {0, 1} if words[:1] in (["h"], ["stow"], ["home"]) else set()


def sim(address):
    return lambda clock: SimTwin(clock, address, moved_by)
