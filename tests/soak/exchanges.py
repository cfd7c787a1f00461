"""Thousands of exchanges of a script's antenna with a simulated dish, over a wire whose faults change."""

from __future__ import annotations

import random
import re
from collections import Counter
from dataclasses import dataclass

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.config import AntennaConfig
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import BirdcageError
from birdcage.base.geometry import shortest_turn
from birdcage.link.link import Link
from birdcage.protocol.registry import get_protocol
from birdcage.sim.port import open_port

from .fault_mix import FaultMix


@dataclass(frozen=True, slots=True)
class Kind:
    """A dish, and how it prints what is read of it."""

    address: str
    motors: str
    menus: tuple[str, ...]
    rows: tuple[int, ...]
    angles: re.Pattern[str]
    lowest_deg: float
    highest_deg: float


SIGNAL = re.compile(r"Reads:(\d+)\s+RSSI\[avg:\s*(\d+)\s+cur:\s*(\d+)\]")
_ANGLES = {
    "g2": r"Angle\[0\] = (\S+)\s+Angle\[1\] = (\S+)\s",
    "hal205": r"AZ =\s*(\S+)\s+EL =\s*(\S+)\s+SK =\s*(\S+)\s",
}
EXACT = "root_q=kill&overshoot=0"
"""At rest an axis stands on the step that was ordered, and a `q` at the root is never forgiven."""
HAL = Kind(
    f"hal205?{EXACT}&below_floor=refuse", "motor", ("root", "motor", "ngsearch", "nvs"), (125, 127),
    re.compile(_ANGLES["hal205"]), 15.0, 90.0,
)  # fmt: skip
KINDS = {
    "g2": Kind(
        f"g2?{EXACT}&az=-200&az_speed=12&el_speed=4", "mot", ("root", "mot", "dvb", "nvs", "step", "os"),
        (20, 38, 41, 80, 101, 102), re.compile(_ANGLES["g2"]), 18.0, 65.0,
    ),
    "hal205": HAL,
    "hal205 alike": Kind(
        f"{HAL.address}&prompts=alike", HAL.motors, HAL.menus, HAL.rows, HAL.angles, HAL.lowest_deg, HAL.highest_deg
    ),
}  # fmt: skip


class Exchanges:
    """Does what a script may, and holds every answer against what the dish really printed and did.

    `wrong` gets a sentence for everything that may not be; `tally` counts what came of it all.
    """

    def __init__(self, kind: Kind, seed: int) -> None:
        self.kind, self.rng = kind, random.Random(seed)
        self.wrong: list[str] = []
        self.tally: Counter[str] = Counter()
        self.clock = VirtualClock()
        port = open_port(f"{kind.address}&seed={seed}", clock=self.clock)
        self.device = port.device
        self.fault_mix = FaultMix(random.Random(seed + 1)), FaultMix(random.Random(seed + 2))
        self.antenna = BirdcageAntenna(
            get_protocol(kind.address.partition("?")[0]), AntennaConfig(leapfrog_enabled=False)
        )
        self.antenna.attach(Link(port, self.clock), self.clock)
        self.protocol = self.antenna.protocol
        self._sent: dict[str, int] = {}
        self._ordered: dict[int, list[float]] = {0: [], 1: []}
        self._heard: dict[int, list[float]] = {0: [], 1: []}
        self._printed = bytearray()
        self._failing = 0
        self._written: Counter[str] = Counter()
        self._tap()
        self._tap_port(port)
        self.antenna.initialize()
        self.rows = {index: self.protocol.read_nvs(index) for index in kind.rows}
        for lane, fault_mix in zip(port.wire.lanes, self.fault_mix, strict=True):
            lane.set_plan(fault_mix)

    def _tap(self) -> None:
        """Look at what the dish prints, which moves it hears, and which its motors are given."""
        device, menu = self.device, self.device.firmware.menus[self.kind.motors]
        carry, run = device.wire.carry, menu.run

        def carrying(lane, now, data):
            if lane is device.wire.to_host:
                self._printed += data
            return carry(lane, now, data)

        def running(words):
            self._hear(words)
            return run(words)

        device.wire.carry, menu.run = carrying, running
        for index in (0, 1):
            self._tap_axis(index)

    def _tap_port(self, port) -> None:
        """Look at what leaves the program."""
        write = port.write

        def writing(data):
            self._written.update(line for line in data.decode("ascii").split("\r") if line.startswith("a "))
            write(data)

        port.write = writing

    def _tap_axis(self, index: int) -> None:
        axis, ordered = self.device.dish.axes[index], self._ordered[index]
        retarget = axis.retarget

        def retargeting(now_s, target_deg, **options):
            ordered.append(target_deg)
            retarget(now_s, target_deg, **options)

        axis.retarget = retargeting

    def _hear(self, words: list[str]) -> None:
        line = " ".join(words)
        if line in self._sent and not (self._sent[line] and self.fault_mix[0].altered):
            self._sent[line] += 1  # else the wire made it of another line
        if len(words) != 3 or words[0] != "a" or words[1] not in ("0", "1"):
            return
        try:
            wanted = float(words[2])
        except ValueError:
            return
        if words[1] == "0" or self.kind.lowest_deg <= wanted <= self.kind.highest_deg:
            self._heard[int(words[1])].append(wanted)

    def run(self, exchanges: int) -> None:
        """Have so many exchanges, and look now and then, on a clean line, where the dish has come to."""
        rng = self.rng
        for number in range(exchanges):
            if number % 100 == 99:
                self._come_to_rest(number)
            elif rng.random() < 0.15:
                for fault_mix in self.fault_mix:
                    fault_mix.change()
                self._failing = 0
            if rng.random() < 0.1:
                self.clock.advance(rng.choice((0.01, 0.5, 3.0, 20.0)))
            self._exchange(number)
        self._come_to_rest(exchanges)

    def _exchange(self, number: int) -> None:
        deed = self.rng.choices(
            (self._position, self._row, self._menu, self._move, self._signal), (45, 15, 12, 20, 8)
        )[0]  # fmt: skip
        for fault_mix in self.fault_mix:
            fault_mix.begin()
        self._printed.clear()
        try:
            wrong = deed()
        except BirdcageError as error:
            self.tally[f"{type(error).__name__} {error.reason}"] += 1
            self._failing += 1
            wrong = self._may_fail(error)
        else:
            self._failing = 0
            self.tally["done"] += 1
        if not self.device.truth().shell_alive:
            wrong = "the shell has died"
        if wrong:
            self.wrong.append(f"{number} {deed.__name__}: {wrong}")
        assert len(self.wrong) < 10, self.wrong

    def _may_fail(self, error: BirdcageError) -> str:
        """On a clean line the first exchange may still pay for what was before, and no other."""
        clear = all(fault_mix.spell in ("clear", "split") for fault_mix in self.fault_mix)
        return f"on a clean line: {error}" if clear and self._failing > 1 else ""

    # What is asked, and what must hold.

    def _judge(self, what: str, told, *, printed: bool, whole: bool) -> str:
        """A reading is one that the dish printed meanwhile, unless the wire altered just that in it.

        `whole`: any byte of the reply is a part of it, not its numerals only.
        """
        back = self.fault_mix[1]
        self.tally[what] += 1
        if printed:
            return ""
        if back.altered if whole else back.numeral:
            self.tally[f"{what} altered on the wire"] += 1
            return ""
        return f"{what} {told} was not printed: {bytes(self._printed)!r}"

    @property
    def _text(self) -> str:
        return self._printed.decode("latin-1")

    def _position(self) -> str:
        before = self.device.truth()
        position = self.antenna.get_position()
        told = [position.azimuth, position.elevation]
        told += [] if position.skew is None else [position.skew]
        # An angle that did not come through is told to be unknown, which is true.
        printed = [[float(text) for text in found][: len(told)] for found in self.kind.angles.findall(self._text)]
        wrong = self._judge("position", told, printed=told in printed, whole=False)
        after = self.device.truth()
        if not wrong and told in printed and not before.moving and not after.moving:
            off = max(abs(shortest_turn(after.az_deg, told[0])), abs(after.el_deg - told[1]))
            wrong = f"{told} where it rests at {after}" if off > 0.01 else ""
        return wrong

    def _row(self) -> str:
        index = self.rng.choice(self.kind.rows)
        row = self.protocol.read_nvs(index)
        return self._judge("row", row, printed=row == self.rows[index], whole=True)

    def _signal(self) -> str:
        if not self.protocol.model.has_rssi:
            return self._position()
        reads = self.rng.randint(1, 20)
        reading = self.protocol.get_rssi(reads)
        told = (reading.reads, reading.average, reading.current)
        printed = [tuple(int(text) for text in found) for found in SIGNAL.findall(self._text)]
        return self._judge("signal", told, printed=told in printed and told[0] == reads, whole=False)

    def _menu(self) -> str:
        menu = self.rng.choice(self.kind.menus)
        self.protocol.console.enter(menu)
        self.tally["menu"] += 1
        really = self.device.truth().menu
        return f"told to be in {menu}, is in {really}" if really != menu else ""

    def _move(self) -> str:
        """Every move is taken once, or reported as failed or unsure; none is ever taken twice."""
        az_deg, el_deg = self._fresh(100.0, 359.99, 0), self._fresh(self.kind.lowest_deg, self.kind.highest_deg, 1)
        lines = [f"a 0 {az_deg:.2f}", f"a 1 {el_deg:.2f}"]
        self._sent |= dict.fromkeys(lines, 0)
        self.antenna.move_to(az_deg, el_deg)
        self.tally["move"] += 1
        there, back = self.fault_mix
        lost = [line for line in lines if self._sent[line] != 1]
        if lost and there.altered and back.altered:
            self.tally["move altered on the wire, and its echo too"] += 1
            return ""
        if there.altered:
            answers = self.antenna.commands.answers
            unsure = {line for axis, line in enumerate(lines) if not answers[axis].sure and not self._sent[line]}
            self.tally["move not told to be taken"] += len(unsure)
            lost = [line for line in lost if line not in unsure]
        return f"told to be taken, and was not: {lost}" if lost else ""

    def _fresh(self, low_deg: float, high_deg: float, axis: int) -> float:
        while True:
            angle = self.rng.randint(round(low_deg * 100), round(high_deg * 100)) / 100
            if f"a {axis} {angle:.2f}" not in self._sent:
                return angle

    def _come_to_rest(self, number: int) -> None:
        """Every step that was ordered was gone, by the motors' own count and by the shafts."""
        for fault_mix in self.fault_mix:
            fault_mix.clear()
        self._failing = 0
        self.clock.advance(10.0)
        while self.device.truth().moving:
            self.clock.advance(10.0)
        now_s = self.device.machine.dish_s
        for index, axis in enumerate(self.device.dish.axes[:2]):
            heard, ordered = self._heard[index], self._ordered[index]
            off = [pair for pair in zip(heard, ordered, strict=False) if not _same(index, *pair)]
            if len(heard) != len(ordered) or off:
                self.wrong.append(
                    f"{number}: axis {index} heard {len(heard)} moves and was given {len(ordered)}: {off}"
                )
            count, shaft = axis.count(now_s)[0], axis.shaft(now_s)
            if abs(shaft - count) > axis.step_deg / 2 or (ordered and abs(count - ordered[-1]) > axis.step_deg):
                self.wrong.append(
                    f"{number}: axis {index} stands at {shaft}, counts {count}, was sent to {ordered[-1]}"
                )
            self.tally["order"] += len(ordered)
            heard.clear()
            del ordered[:-1]
            if ordered:
                heard.append(ordered[-1])
                self.tally["order"] -= 1
        for what, times in (("sent", self._written), ("taken", self._sent)):
            twice = [line for line in times if times[line] > 1]
            if twice:
                self.wrong.append(f"{number}: {what} more than once: {twice}")


def _same(index: int, heard_deg: float, ordered_deg: float) -> bool:
    off = shortest_turn(heard_deg, ordered_deg) if index == 0 else ordered_deg - heard_deg
    return abs(off) < 1e-6
