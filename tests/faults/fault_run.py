"""Runs one fault at one moment on one dialect, and says what came of it."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import dataclass, field

from birdcage.base.errors import BirdcageError, NoReply, Stopped
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.rotator.facts import SearchSwitch
from birdcage.station.requests import AcknowledgeFault, Goto, Home, Release, SetSearch
from birdcage.station.state import Activity, FaultReason, LinkPhase

from .fault import FAR, MOVING, START, Fault
from .outcome import Outcome, Stopping, readable
from .stage import Stage

BACK_S = 90.0
"""How long the link may take to come back once the fault has gone."""
HOLDS_S = 60.0
ASKS_S = 1.0
"""How often a client asks for a motion while STOP holds."""
STOP_AFTER_S = 0.3


@dataclass
class FaultRun:
    """One fault, one dialect, one moment."""

    fault: Fault
    dialect: str
    when: str
    sees: list[str] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    held: list[str] = field(default_factory=list)
    hidden: bool = False
    watching: bool = True
    """Whether what is seen belongs to the fault, and not to what a person does about it afterwards."""
    ended: float = float("inf")
    """When the motion that was asked for was over."""

    def run(self) -> Outcome:
        """Go through it twice: once without touching anything, once with STOP in the middle of it."""
        stage, future = self._begin()
        struck = stage.now
        self._suffer(stage, self.fault.lasts_s[self.when])
        self.fault.heal(stage)
        back_s = self._come_back(stage)
        unasked = self._unasked(stage, struck, future)
        motion = self._fate(stage, future)
        misled = bool(stage.recorder.misled)
        deeds, good = self._go_on(stage)
        false = list(stage.recorder.false)
        stopping, false_there = self._stopped()
        return Outcome(
            sees=tuple(self.sees), links=tuple(self.links), fault=next(iter(self.faults), None),
            alarms=tuple(self.faults), held=next(iter(self.held), None), motion=motion, position_hidden=self.hidden,
            came_back_s=back_s,
            deeds=deeds, next_good=good, false=(*false, *(f"STOP: {each}" for each in false_there)), unasked=unasked,
            misled=misled, stop=stopping,
        )  # fmt: skip

    def _begin(self) -> tuple[Stage, Future | None]:
        """Bring a dish to the moment, and inflict the fault."""
        stage = Stage(self.dialect, self.fault.options.get(self.dialect, ""))
        stage.connect()
        arrived = stage.do(Goto(*START[self.dialect], "you"))
        assert not isinstance(arrived, Exception), arrived
        stage.step(3.0)
        assert stage.state.position is not None
        assert stage.recorder.false == []
        stage.recorder.places.clear()
        future = None
        if self.when == MOVING:
            if self.fault.before:
                self.fault.inflict(stage)
            future = stage.station.submit(self.fault.motion(stage))
            future.add_done_callback(lambda _future: setattr(self, "ended", stage.now))
            if self.fault.before:
                self._suffer(stage, self.fault.strikes_s)
                return stage, future
            stage.step(self.fault.strikes_s)
            assert stage.truth.moving, "it strikes in mid-move"
        self.fault.inflict(stage)
        return stage, future

    def _suffer(self, stage: Stage, seconds: float) -> None:
        end = stage.now + seconds
        while stage.now < end - 1e-9:
            stage.step(min(0.1, end - stage.now))
            self._watch(stage)
            self.fault.again(stage)

    def _watch(self, stage: Stage) -> None:
        """Read what a person would."""
        state = stage.state
        link = state.link.state
        if not self.watching:
            return
        if link is not LinkPhase.UP:
            self._note(self.links, link.value)
            if link is not LinkPhase.OPENING:
                self._note(self.sees, state.link.detail)
        if state.fault is not None:
            self._note(self.faults, state.fault.reason)
            self._note(self.sees, f"{state.fault.what} {state.fault.remedy}")
        if state.held is not None:
            self._note(self.held, state.held.reason)
        if state.activity in (Activity.INITIALIZING, Activity.MOVING_UNASKED):
            self._note(self.sees, f"{state.activity.value}: {state.activity_text}".rstrip(": "))
        if state.homed is False:
            self._note(self.sees, "not homed")
        if state.position is None or state.position_lost is not None:
            self.hidden = True

    def _note(self, seen: list[str], what: str) -> None:
        if what and what not in seen:
            seen.append(what)

    def _come_back(self, stage: Stage, *, homed: bool = False) -> float | None:
        healed = stage.now

        def well() -> bool:
            self._watch(stage)
            state = stage.state
            read = state.position is not None and state.position_lost is None
            untold = not stage.tells and state.position_lost is Reason.UNTOLD
            known = read or untold or (state.homed is False and not homed)
            quiet = state.activity in (Activity.IDLE, Activity.MOVING_UNASKED)
            return state.link.state is LinkPhase.UP and quiet and known and state.surveyed

        return stage.now - healed if stage.until(well, BACK_S) else None

    def _unasked(self, stage: Stage, struck: float, future) -> tuple[str, ...]:
        over = struck if future is None else self.ended
        lines = [
            f"{readable(each.data)} after {each.at - struck:.1f} s"
            for each in stage.written
            if each.moves and each.at > over
        ]
        if not (self.fault.own_motion or self.fault.astray):
            lines += self._strayed(stage)
        return tuple(lines)

    def _strayed(self, stage: Stage) -> list[str]:
        start_az, start_el = START[self.dialect]
        far_az, far_el = FAR[self.dialect] if self.when == MOVING else START[self.dialect]
        way, beyond = shortest_turn(start_az, far_az), 0.3 if stage.has_menus else 1.0  # a control loop swings past
        for az, el in stage.recorder.places:
            turn = shortest_turn(start_az, az)
            along = min(0.0, way) - beyond < turn < max(0.0, way) + beyond
            if not (along and start_el - beyond < el < far_el + beyond):
                return [f"went to {az:.1f}/{el:.1f}"]
        return []

    def _fate(self, stage: Stage, future) -> str:
        if future is None:
            return "-"
        stage.until(future.done, 120.0)
        if not future.done():
            return "never ended"
        error = future.exception(0)
        self._note(self.sees, str(error or ""))
        return "arrives" if error is None else error.reason if isinstance(error, BirdcageError) else repr(error)

    def _go_on(self, stage: Stage) -> tuple[tuple[str, ...], str]:
        """Do what a person would, then ask for a motion and see whether all is right again."""
        deeds: list[str] = []
        self.watching = False
        self._make_ready(stage, deeds)
        if stage.must_be_synced:
            stage.sync()
            deeds.append("sync")
        # One that does not tell does not say that it is homed: the fault asks for it.
        if stage.state.homed is False or (not stage.tells and FaultReason.REBOOT in self.faults):
            homed = stage.do(Home("you"))
            deeds.append("home")
            if isinstance(homed, BirdcageError):
                deeds[-1] = "power cycle"
                stage.device.power_cycle()
                stage.step(10.0)
                self._come_back(stage, homed=True)
                self._make_ready(stage, deeds)
        az, el = 150.0, 40.0
        arrived = stage.do(Goto(az, el, "you"))
        if isinstance(arrived, NoReply | Stopped):  # what the fault has left on the line may have cost the answer
            deeds += [] if stage.tells else ["wait"]
            stage.until(lambda: stage.is_up and not stage.may_move, BACK_S)
            self._make_ready(stage, deeds)
            deeds.append("ask again")
            arrived = stage.do(Goto(az, el, "you"))
        if isinstance(arrived, Exception):
            return tuple(deeds), f"{type(arrived).__name__}: {arrived}"
        stage.step(3.0)
        truth, state = stage.truth, stage.state
        off = max(abs(shortest_turn(truth.az_deg, az)), abs(truth.el_deg - el))
        if off > 0.1:
            return tuple(deeds), f"{off:.2f}° beside the target"
        wrong = [
            what
            for what, so in (
                ("no link", state.link.state is not LinkPhase.UP),
                ("held", state.held is not None),
                ("fault", state.fault is not None),
                ("not idle", state.activity is not Activity.IDLE),
                ("no position", state.position is None or state.position_lost is not None),
            )
            if so
        ]
        return tuple(deeds), ", ".join(wrong) or "right"

    def _make_ready(self, stage: Stage, deeds: list[str]) -> None:
        """Acknowledge, release, and end the TV search that a restart has begun."""
        restarted = stage.state.fault is not None and stage.state.fault.reason == "reboot"
        if stage.state.fault is not None:
            stage.do(AcknowledgeFault("you"))
            deeds.append("acknowledge")
        if stage.state.held is not None:
            stage.do(Release("you"))
            deeds.append("release")
        searches = stage.state.dish.search_switch is SearchSwitch.UNTIL_POWER_UP and stage.state.homed
        if searches and (restarted or stage.truth.moving):
            ended = stage.do(SetSearch("you", disabled=True))
            deeds.append(f"end the search{f' ({ended})' if isinstance(ended, Exception) else ''}")
            stage.step(3.0)
            if stage.state.fault is not None:
                stage.do(AcknowledgeFault("you"))
            if stage.state.held is not None:
                stage.do(Release("you"))

    def _stopped(self) -> tuple[Stopping, list[str]]:
        """Press STOP in the middle of it, and have a client ask for motion for a minute."""
        stage, _future = self._begin()
        self._endure(stage, STOP_AFTER_S)
        pressed, sent = stage.now, len(stage.written)
        at_call = readable(stage.stop())
        healed = False
        while stage.now < pressed + HOLDS_S:
            stage.station.submit(Goto(*FAR[self.dialect], "Gpredict"))
            self._endure(stage, ASKS_S, again=not healed)
            if not healed and stage.now >= pressed + self.fault.lasts_s[self.when] - STOP_AFTER_S:
                self.fault.heal(stage)
                healed = True
        report = stage.state.last_stop
        after = stage.written[sent:]
        own = [each for each in after if each.stopping]
        sends = "at once" if at_call else "after a look" if own else "nothing"
        escaped = [each for each in after if each.moves and not each.stopping]
        stopping = Stopping(
            sends=sends, at_call=at_call, means=report.means, reported=report.sentence, confirmed=report.confirmed,
            escaped=tuple(readable(each.data) for each in escaped), rests=not stage.truth.moving,
            held=stage.state.held is not None,
        )  # fmt: skip
        return stopping, stage.recorder.false

    def _endure(self, stage: Stage, seconds: float, *, again: bool = True) -> None:
        end = stage.now + seconds
        while stage.now < end - 1e-9:
            stage.step(min(0.1, end - stage.now))
            if again:
                self.fault.again(stage)
