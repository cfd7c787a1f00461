"""What a raw line leaves behind: a remark in the transcript, a modelled motion, and what no longer holds."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.motion import DishMotion, start_motion
from birdcage.antenna.raw_limits import pointed
from birdcage.base.reason import Reason
from birdcage.rotator.values import MOTOR_AZIMUTH, Position
from birdcage.rotator.verdict import Grade, Verdict
from birdcage.station.events import TranscriptLine
from birdcage.station.mover import Mover
from birdcage.station.raw import RawMark
from birdcage.station.state import Activity, TvSearch
from birdcage.station.state_store import StateStore


class RawEffects:
    """Keeps state, gate and model true while somebody types past them."""

    def __init__(
        self, store: StateStore, antenna: BirdcageAntenna, mover: Mover, remark: Callable[[str], None],
        on_line: Callable[[str], None],
    ) -> None:  # fmt: skip
        self._store, self._antenna, self._mover, self._remark = store, antenna, mover, remark
        self._on_line = on_line
        self._homed: set[int] = set()
        self._homed_before: bool | None = None
        self.moved = False
        """Whether a line since the last `clear` may have moved the dish."""
        self.resurvey = False
        """Whether one may have changed what a survey reads."""

    def clear(self) -> None:
        """A new talk begins."""
        self.moved = self.resurvey = False
        self._homed.clear()

    def say(self, text: str) -> None:
        """Put a remark into the transcript, in plain ASCII, and tell it to listeners."""
        text = text.replace("°", " deg")
        self._remark(text)
        self._store.tell(TranscriptLine(*self._store.stamp(), "#", text))

    def announce(self, line: str, verdict: Verdict, holder: str) -> None:
        """Mark a raw line before its bytes go out."""
        about = [
            "confirmed" if verdict.grade > Grade.HARMLESS else "",
            "" if verdict.listed else "not in the hazard table",
            verdict.limit,
        ]
        self.say(RawMark(holder, line, verdict.grade, "; ".join(filter(None, about))).text)

    def modelled(self, verdict: Verdict) -> DishMotion | None:
        """Return the model of the motion that a line begins; None when where it leads cannot be foreseen.

        Another axis that is still on its way goes on in it.
        """
        sent = None if verdict.aim is None else verdict.aim.single
        if sent is None or verdict.limit or verdict.grade is not Grade.MOVES or self.resurvey:
            return None  # `resurvey`: at which speed it goes is not known any more
        antenna, gate, clock = self._antenna, self._antenna.gate, self._store.clock
        ((axis, angle),) = pointed(dict([sent]), antenna.model).items()
        under_way = antenna.motion
        start, velocity, now = gate.position, (0.0, 0.0), clock.monotonic()
        if under_way is not None:
            azimuth, elevation = (each.modelled(now, clock.rate) for each in (under_way.azimuth, under_way.elevation))
            start, velocity = Position(azimuth[0], elevation[0]), (azimuth[1], elevation[1])
        if start is None:
            return None
        if axis != MOTOR_AZIMUTH:
            begun = start_motion(antenna.model, start, 0.0, angle, now, velocity)
            return begun if under_way is None else DishMotion(under_way.azimuth, begun.elevation)
        turns, cable = gate.cable_turns(angle), gate.cable_deg
        if not turns or cable is None:
            return None  # which way it turns is not known, and nothing is read that would tell
        begun = start_motion(antenna.model, start, turns[0] - cable, start.elevation, now, velocity)
        return begun if under_way is None else DishMotion(begun.azimuth, under_way.elevation)

    def sent(self, verdict: Verdict) -> None:
        """A line has gone out: forget what it may change.

        An undocumented one is mostly a mistype, which the dish refuses: that has its time until `taken`.
        """
        self._homed_before = self._store.state.homed
        if verdict.listed:
            self._forget(verdict)
        elif verdict.grade >= Grade.MOVES:
            self._may_move()

    def taken(self, verdict: Verdict) -> None:
        """The dish has answered, and not with a refusal."""
        if not verdict.listed:
            self._forget(verdict)
        gate = self._antenna.gate
        for axis in verdict.homes:
            gate.found_reference(axis)
            self._homed.add(axis)
        axes = {gate.model.azimuth.index, gate.model.elevation.index}
        if verdict.homes and (self._homed_before or axes <= self._homed):
            self._store.change(homed=True)

    def hear(self, boot_lines: Iterable[str], verdict: Verdict) -> None:
        """Pass on boot text in an answer: a dish that restarts in the middle of it has forgotten everything."""
        if verdict.restarts:
            return  # as asked for
        for line in boot_lines:
            self._on_line(line)

    def _may_move(self) -> None:
        self.moved = True
        self._mover.forget_target()
        self._mover.activity(Activity.UNKNOWN, Reason.RAW_COMMAND.value, raw=True)

    def _forget(self, verdict: Verdict) -> None:
        forgets, gate = verdict.forgets, self._antenna.gate
        if verdict.grade >= Grade.MOVES:
            self._may_move()
        if "position" in forgets:
            cable_deg, remembers = gate.cable_deg, gate.remembers_cable
            gate.forget(Reason.RAW_COMMAND)
            if "turn" not in forgets:
                gate.cable_deg, gate.remembers_cable = cable_deg, remembers
            turn = gate.model.turn if gate.cable_deg is None else self._store.state.turn
            self._store.change(position_lost=Reason.RAW_COMMAND, turn=turn)
        if "homed" in forgets:
            if not verdict.homes:
                self._homed.clear()
            self._store.change(homed=None)
            if verdict.restarts:
                gate.released.clear()  # a dish that starts finds its references, or says that it has none
            elif not verdict.homes:
                gate.release()  # what it reports from now on may not be where it is
                self._store.change(position_lost=Reason.RAW_COMMAND)
        if "search" in forgets:
            self._store.change(search=TvSearch.UNKNOWN)
        self.resurvey = self.resurvey or bool(forgets & {"limits", "search", "settings"})
