"""A whole simulated dish: mechanics, console and wire, behind one lock."""

from __future__ import annotations

import threading
from collections import deque

from birdcage.base.clock import Clock
from birdcage.sim.dish import Dish, Truth
from birdcage.sim.g2.board import Board
from birdcage.sim.g2.boot import boot_log
from birdcage.sim.g2.console import menus
from birdcage.sim.g2.knobs import G2Settings
from birdcage.sim.g2.tracker import Tracker
from birdcage.sim.machine import Machine
from birdcage.sim.shell import Shell
from birdcage.sim.wire import Wire


class Device:
    """One dish. Every method may be called from any thread; each brings the dish up to date first."""

    def __init__(self, settings: G2Settings, clock: Clock) -> None:
        self.settings = settings
        self.lock = threading.RLock()
        self.machine = Machine(clock)
        self.wire = Wire(settings)
        self.dish = Dish(settings, self.truth)
        self.powered = True
        self.inbox: deque[tuple[float, bytes]] = deque()
        """What is on its way to the program, and when each piece arrives."""
        self.session = 0
        """Counts how often the adapter was pulled out: a port of an earlier session is dead for good."""
        self.board = Board(settings, self.machine, self.dish, self._restart)
        self.tracker = Tracker(self.board)
        self.shell = Shell(self.machine, settings, menus(self.board), self._send, self._echo)
        if settings.boot:
            self.shell.play(boot_log(self.board, self.tracker))

    def truth(self) -> Truth:
        """Return what the dish really does at this moment."""
        with self.lock:
            self.machine.run()
            return self.dish.look(
                self.machine.dish_s, shell_alive=self.shell.alive, powered=self.powered, menu=self.shell.menu
            )

    def receive(self, data: bytes) -> None:
        """Take bytes that the program sends."""
        with self.lock:
            self.machine.run()
            for time_s, piece in self.wire.carry(self.wire.to_dish, self.machine.now, data):
                self._deliver(time_s, piece)
            self.machine.run()

    def reboot(self) -> None:
        """Reset the processor in the middle of whatever it does: motion ends, RAM and homing are lost."""
        with self.lock:
            self.machine.run()
            self._restart()

    def power_off(self) -> None:
        """Cut the power: the shell falls silent and the motors let go."""
        with self.lock:
            self.machine.run()
            self._stop()
            self.powered = False
            self.shell.reset(alive=False)

    def power_on(self) -> None:
        """Give power: the boot log runs, and homing with it unless NVS 20 is TRUE."""
        with self.lock:
            self.machine.run()
            self.powered = True
            self._restart()

    def power_cycle(self, off_s: float = 2.0) -> None:
        """Cut the power for `off_s` seconds of dish time."""
        with self.lock:
            self.power_off()
            self.machine.at_dish(self.machine.dish_s + off_s, self.power_on)

    def deadlock(self) -> None:
        """Have the shell's task hang: it neither answers nor echoes until power-on. The motors keep on."""
        with self.lock:
            self.machine.run()
            self.shell.reset(alive=False)

    def stall(self, axis: int, *, blocked: bool = True) -> None:
        """Block or free an axis (0 azimuth, 1 elevation); setting `stall` says whether the firmware notices."""
        with self.lock:
            self.machine.run()
            motor = self.dish.axes[axis]
            was_moving = motor.moving(self.machine.dish_s)
            if not blocked:
                motor.unblock(self.machine.dish_s)
                return
            slips = self.settings.stall == "slip"
            motor.block(self.machine.dish_s, slips=slips)
            if was_moving and not slips and self.shell.alive:
                self.shell.say(f"{motor.data.name} MOTOR STALLED\n")

    def unplug(self) -> None:
        """Pull the adapter out: ports raise `ConnectionError`; the dish goes on by itself."""
        with self.lock:
            self.machine.run()
            self.wire.plugged = False
            self.session += 1
            self.inbox.clear()

    def plug(self) -> None:
        """Put the adapter back; a new port can be opened."""
        with self.lock:
            self.machine.run()
            self.wire.plugged = True

    def _deliver(self, time_s: float, data: bytes) -> None:
        if time_s <= self.machine.now:
            self.shell.feed(data)
        else:
            self.machine.at(time_s, lambda: self.shell.feed(data))

    def _send(self, data: bytes) -> None:
        if self.wire.plugged:
            self.inbox.extend(self.wire.carry(self.wire.to_host, self.machine.now, data))

    def _echo(self, data: bytes) -> None:
        if not self.wire.echo_loss:
            self._send(data)

    def _stop(self) -> None:
        self.tracker.stop()
        self.dish.power_on(self.machine.dish_s)

    def _restart(self) -> None:
        self._stop()
        self.board.power_on()
        self.shell.reset()
        self.shell.play(boot_log(self.board, self.tracker))
