"""A whole simulated dish: mechanics, console and wire, behind one lock."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

from birdcage.base.clock import Clock
from birdcage.sim.dish import DishTruth
from birdcage.sim.firmware import Firmware, FirmwareHost, MakeShell, Shell, console_shell
from birdcage.sim.machine import Machine
from birdcage.sim.settings import SimSettings
from birdcage.sim.stance import Stance
from birdcage.sim.wire import SimWire


class Device:
    """One dish. Every method may be called from any thread; each brings the dish up to date first."""

    def __init__(
        self,
        settings: SimSettings,
        clock: Clock,
        build: Callable[[FirmwareHost], Firmware],
        make_shell: MakeShell = console_shell,
    ) -> None:
        self.settings = settings
        self.lock = threading.RLock()
        self.machine = Machine(clock)
        self.powered = True
        self.inbox: deque[tuple[float, bytes]] = deque()
        """What is on its way to the program, and when each piece arrives."""
        self.session = 0
        """Counts how often the adapter was pulled out: a port of an earlier session is dead for good."""
        self.firmware = build(self)
        self.board = self.firmware.board
        self.dish = self.firmware.dish
        self.stance = Stance(settings)
        self.wire = SimWire(settings, self.firmware.baud)
        self.shell: Shell = make_shell(self.machine, settings, self.firmware, self._send, self._echo)
        if settings.boot:
            self.shell.play(self.firmware.boot())
        else:
            self.firmware.resume()

    def truth(self) -> DishTruth:
        """Return what the dish really does at this moment."""
        with self.lock:
            self.machine.run()
            return self.dish.look(
                self.machine.dish_s, self.stance, shell_alive=self.shell.alive, powered=self.powered,
                menu=self.shell.menu,
            )  # fmt: skip

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
            self.restart()

    def restart(self) -> None:
        """Start over at this very instant: for a firmware, whose script has brought the dish up to date."""
        self._stop()
        self._start()

    def brown_out(self, *, quiet: bool = False) -> None:
        """Restart the processor as a dip of its supply does: homing is forgotten, and nothing homes by itself.

        `quiet`: without the boot log.
        """
        with self.lock:
            self.machine.run()
            self._stop()
            self._start(home=False, quiet=quiet)

    def power_off(self) -> None:
        """Cut the power: the shell falls silent and the motors let go."""
        with self.lock:
            self.machine.run()
            self._stop()
            self.powered = False
            self.shell.reset(alive=False)

    def power_on(self) -> None:
        """Give power: the boot log runs, and homing with it where the firmware homes by itself."""
        with self.lock:
            self.machine.run()
            self.powered = True
            self.restart()

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
        """Block or free an axis (0 azimuth, 1 elevation, 2 skew); setting `stall`: whether the firmware notices."""
        with self.lock:
            self.machine.run()
            motor = self.dish.axes[axis]
            was_moving = motor.moving(self.machine.dish_s)
            if not blocked:
                motor.unblock(self.machine.dish_s)
                return
            slips = self.settings.stall == "slip"
            motor.block(self.machine.dish_s, slips=slips)
            if was_moving and not slips:
                self.firmware.stalled(motor)

    def wander(self, axis: int = 0, by_deg: float = 20.0) -> None:
        """Have a motor run unasked; the other way where its range ends first."""
        with self.lock:
            self.machine.run()
            motor, now = self.dish.axes[axis], self.machine.dish_s
            goal = motor.count(now)[0] + by_deg
            if not motor.data.low_deg <= goal <= motor.data.high_deg:
                goal -= 2 * by_deg
            motor.retarget(now, min(max(goal, motor.data.low_deg), motor.data.high_deg))

    def say(self, text: str) -> None:
        """Print something unsolicited, if the shell lives."""
        with self.lock:
            self.machine.run()
            if self.shell.alive:
                self.shell.say(text)

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
        self.firmware.halt()
        self.dish.power_on(self.machine.dish_s)

    def _start(self, *, home: bool = True, quiet: bool = False) -> None:
        log = self.firmware.boot(home=home)
        self.shell.reset()
        if not quiet:
            self.shell.play(log)
