"""The simulated rotctld as a twin for the contract, and a rotator that is open to it."""

from __future__ import annotations

from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.link.link import Link
from birdcage.rotator import machines
from birdcage.rotator.hooks import Hooks
from birdcage.sim.port import SimPort, open_device
from birdcage.testing import SeenCommand, Truth, Twin


class RotctlTwin(Twin):
    """`P` names both axes; one that is sent where it goes already is not set in motion by it."""

    address = "rotctl://server"

    def __init__(self, clock, options="seed=1"):
        self.clock = clock
        self.device = open_device(f"rotctl?{options}", clock=clock)
        self.dialled = []

    def dial(self, address, baud):
        self.dialled.append(address)
        try:
            return Link(SimPort(self.device, address, baud=baud or None), self.clock)
        except ConnectionError as error:
            raise LinkError(str(error), reason="missing") from error

    def lines(self):
        with self.device.lock:
            self.device.machine.run()
            return list(self.device.shell.received)

    def said(self):
        return [line for _at, line in self.lines()]

    def truth(self):
        truth = self.device.truth()
        return Truth(truth.cable_deg, truth.el_deg, truth.moving)

    def taken(self):
        settings, taken = self.device.settings, []
        goes = [settings.az, settings.el]
        for at, line in self.lines():
            word, *rest = line.split()
            if word == "P":
                to = [float(text) for text in rest]
                motors = {axis for axis in (0, 1) if goes[axis] is None or abs(to[axis] - goes[axis]) > 0.02}
                goes = to
                if motors:
                    taken.append(SeenCommand(at, frozenset(motors)))
            elif word in ("S", "K", "M"):
                goes = [None, None]
        return taken

    def received(self):
        return len(self.lines())

    def unplug(self):
        self.device.unplug()

    def plug(self):
        self.device.plug()

    def mute(self):
        self.device.wire.to_dish.silent = self.device.wire.to_host.silent = True

    def unmute(self):
        self.device.wire.to_dish.silent = self.device.wire.to_host.silent = False


def server(options="seed=1"):
    """Make a twin of a server with options, on the clock that it is given."""
    return lambda clock: RotctlTwin(clock, options)


def opened(options="seed=1", **hooks):
    """Open a machine to such a server; return it, its twin and their clock."""
    clock = VirtualClock()
    twin, rotator = RotctlTwin(clock, options), machines.make("rotctl")
    rotator.open(twin.address, None, clock, Hooks(dial=twin.dial, **hooks))
    return rotator, twin, clock
