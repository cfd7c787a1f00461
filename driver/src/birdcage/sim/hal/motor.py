"""The motor menu: `a` reads and queues, `g` moves until a byte arrives (`docs/reference/travler.md`, *Moving*)."""

from __future__ import annotations

from birdcage.sim.hal.board import HalBoard, number
from birdcage.sim.hal.menu import HalMenu
from birdcage.sim.shell import Die, Listen, Pause, Script

EVERY_KEY = bytes(range(256))


class MotorMenu(HalMenu):
    """Angles in degrees. Motor 0 is azimuth, 1 elevation, 2 skew."""

    help_lines = ("a [<motor> <angle>]", "g <az> <el> <sk>", "q")

    def __init__(self, board: HalBoard) -> None:
        super().__init__(board, board.settings.prompt_motor)
        self.commands |= {"a": self._angle, "g": self._go}
        self._aborted = False

    def _angle(self, args: list[str]) -> Script:
        if not args:
            yield self._position()
            return
        wanted = number(args[1]) if len(args) == 2 else None
        if args[0] not in ("0", "1", "2") or wanted is None:
            yield from self.bad_parameter()
            return
        index = int(args[0])
        if not self.board.dish.axes[index].homed:
            yield from self._unhomed()
            return
        target = self.board.target(index, wanted)
        if target is None:
            yield f"{self.board.settings.out_of_range_text}\n"
            return
        self.board.order(index, target)
        if self.board.settings.ack:
            yield f"{self.board.settings.ack}\n"

    def _go(self, args: list[str]) -> Script:
        numbers = [number(arg) for arg in args]
        if len(numbers) != 3 or None in numbers:
            yield from self.bad_parameter()
            return
        board = self.board
        if not all(axis.homed for axis in board.dish.axes):
            yield from self._unhomed()
            return
        if board.settings.g_order == "az_sk_el":
            numbers[1:] = reversed(numbers[1:])
        targets = [board.target(index, wanted or 0.0) for index, wanted in enumerate(numbers)]
        if None in targets:
            yield f"{board.settings.out_of_range_text}\n"
            return
        if board.settings.g_text:
            yield f"{board.settings.g_text}\n"
        board.turn.held = True  # a search waits until this is done
        if board.settings.g_queue == "wait":
            yield from self._watch()
        if board.settings.g_queue == "drop" or not self._aborted:
            self._begin([target or 0.0 for target in targets])
            yield from self._watch()
        board.turn.held = False
        board.turn.go_on()

    def _begin(self, targets: list[float]) -> None:
        board, now = self.board, self.board.now_s
        az, el, skew = board.dish.axes
        if board.settings.g_axes == "turn":
            board.brake()
            for index in (0, 1):
                board.order(index, targets[index])
        else:
            board.drop()
            az.retarget(now, board.dish.cable_target(now, targets[0]))
            el.retarget(now, targets[1])
        skew.retarget(now, targets[2])
        for lane in board.lanes:
            lane.go_on()

    def _watch(self) -> Script:
        """Wait until nothing moves or waits; any byte brings all to rest."""
        board = self.board
        takes = EVERY_KEY if board.settings.abort_key == "swallow" else b""
        self._aborted = False
        while not self._aborted and any(lane.busy for lane in board.lanes):
            end_s = max(lane.end_s() for lane in board.lanes)
            self._aborted = bool((yield Listen(max(end_s - board.now_s, 0.01), takes=takes)))
        if self._aborted:
            board.brake()
            if board.settings.abort_prompt == "at_rest":
                yield Pause(max(lane.end_s() for lane in board.lanes) - board.now_s)

    def _position(self) -> str:
        board, now = self.board, self.board.now_s
        rows = [f"{axis.data.name} ={self._reported(index)}" for index, axis in enumerate(board.dish.axes)]
        rows.append(f"{board.settings.wrap_label}{board.dish.wrap(now):7.2f}")
        return (" " if board.settings.a_layout == "line" else "\n").join(rows) + "\n"

    def _reported(self, index: int) -> str:
        axis = self.board.dish.axes[index]
        if not axis.homed:
            return f" {self.board.settings.unhomed_angle}"
        centideg = round(axis.count(self.board.now_s)[0] * 100)
        if index == 0 and self.board.settings.az_print == "wrapped":
            centideg %= 36000
        return f"{centideg / 100:7.2f}"

    def _unhomed(self) -> Script:
        if self.board.settings.unhomed_move == "deadlock":
            yield Die()
        yield f"{self.board.settings.unhomed_text}\n"
