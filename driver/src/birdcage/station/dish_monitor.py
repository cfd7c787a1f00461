"""What the station does while idle: polls what is watched, and notices what should not be."""

from __future__ import annotations

from birdcage.antenna.gate import UNTOLD
from birdcage.antenna.reckoning import FRESH_S, apart_deg
from birdcage.antenna.rest import APART_S, STILL_DEG
from birdcage.base.errors import BirdcageError, CommandRefused, Stopped
from birdcage.base.held import CLOCK_STEP, HeldReason
from birdcage.base.reason import Reason
from birdcage.base.trouble import MotorTrouble
from birdcage.rotator import values
from birdcage.rotator.facts import SearchSwitch
from birdcage.station.boot_log import BootLogKeeper
from birdcage.station.events import DishRestarted, End, FaultRaised, TranscriptLine
from birdcage.station.feature_watch import FeatureWatch
from birdcage.station.parts import Parts
from birdcage.station.stalls import MotorFault, blocked, motor_fault
from birdcage.station.starting import Starting
from birdcage.station.state import Activity, Fault, FaultReason, LinkPhase, Pointing, TvSearch

CLOCK_STEP_S = 2.0
UNASKED_DEG = 0.3
"""At rest a reading repeats to a hundredth; this much is motion."""
UNASKED_POLL_S = 0.2
RESTING = (Activity.IDLE, Activity.UNKNOWN, Activity.MOVING_UNASKED)
"""While a dish does one of these, only the monitor looks where it is."""
THEN_HOME = "Wait until it is quiet, then acknowledge and home it."
THEN_SYNC = "Acknowledge, then sync it."
AGAIN = "Acknowledge, then home it. If it homes at power-up, switch it off and on."
LESS_THAN_A_FAILED_HOMING = (FaultReason.REBOOT, FaultReason.UNHOMED)
"""Faults that say less than that an axis failed to home, which takes their place."""


class DishMonitor:
    """Idle work: polls, and the alarms for unasked motion, reboots, suspends and clock steps."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._store, self._antenna, self._control = parts, parts.store, parts.antenna, parts.control
        self._mover, self._reader, self._stopper, self._watches = (
            parts.mover,
            parts.reader,
            parts.stopper,
            parts.watches,
        )
        self._features = FeatureWatch(parts)
        self._offset_s = self._clock_offset_s()
        self._look_again_at: float | None = None
        self._unsettled = False
        """Whether the dish must be seen at rest, in the motor menu, before anything else is read."""
        self.paused = False
        """Set while somebody talks to the dish: nothing is asked for then."""
        self._met = False
        """Whether the dish has answered this station before: else its boot text is the beginning, not a restart."""
        self._failed_to_home = False
        """Whether an axis has failed to home in the start that is under way: that says more than the restart."""
        self._doubted: Pointing | None = None
        """Where the dish rested before a reading that says otherwise, until a second one agrees with either."""
        self._rested: Pointing | None = None
        """Where the dish was first seen at rest since it last moved: it may also creep from one reading to the next."""
        self._starting, self.boot_log = Starting(parts.store, parts.antenna, parts.mover), BootLogKeeper(parts.store)
        parts.signals.stalled.connect(self._stalled)
        parts.signals.astray.connect(self._moves_unasked)
        parts.signals.forgotten.connect(self._forgotten)
        parts.signals.speed_stuck.connect(self._speed_stuck)

    def due(self, now: float) -> float | None:
        """Return when there is something to look at, `now` for at once; in motion, what may be read all the same."""
        if self.paused:
            return None
        features = self._features.due(now)
        if self._store.state.activity not in RESTING:
            return features
        if self._reader.wants_survey and not self._unsettled:
            return now
        if self._watches.excursion is not None:
            return features  # in another menu until the reads are done: the position waits
        times = (self._look_again_at, self._position_due(), features)
        return min((time for time in times if time is not None), default=None)

    def _position_due(self) -> float | None:
        if self._store.state.activity is Activity.UNKNOWN and not self._antenna.strategy.reads_position:
            return self._antenna.reckoning.moves_until  # then it is over by its time, though nothing tells
        # Whoever waits to leave this menu needs an answer from it first.
        due = self._watches.position_due(for_any=not self._reader.may_leave)
        return None if due is None else self._antenna.rotator.next_look(due)

    def tick(self) -> None:
        """Look at whatever is due."""
        now = self._store.clock.monotonic()
        if self._store.state.activity not in RESTING:
            self._features.tick()
        elif self._reader.wants_survey and not self._unsettled:
            self._reader.survey()
        elif self._watches.excursion is not None:
            self._features.tick()
        elif self._is_due(self._position_due(), now) or self._is_due(self._look_again_at, now):
            self._read_position()
        elif self._is_due(self._features.due(now), now):
            self._features.tick()

    @staticmethod
    def _is_due(time: float | None, now: float) -> bool:
        return time is not None and time <= now

    def heard_position(self, told: values.Look) -> None:
        """Hear unasked where the dish is: at rest that is a look like any other. In motion its mover looks."""
        if not self._antenna.strategy.reads_position:
            self._heard_on_its_way(told)
            return
        state = self._store.state
        if state.link.state is LinkPhase.UP and state.activity in RESTING and not self.paused:
            self._read_position(told)

    def _heard_on_its_way(self, look: values.Look) -> None:
        """Hear where a dish is that says so while it moves, perhaps unasked."""
        if self._store.state.link.state is not LinkPhase.UP:
            return
        antenna, now, before = self._antenna, self._store.clock.monotonic(), self._store.state.position
        told = antenna.rotator.position(look)
        heard, stands = antenna.reckoning.hear(told, now), antenna.gate.position
        if antenna.motion is not None:
            self._reader.told(heard)
            return
        if stands is not None and apart_deg(told, stands) <= UNASKED_DEG:
            return  # the last word of a move that is over
        antenna.gate.forget(UNTOLD)
        here = self._reader.told(heard)
        self._look_again_at = now + FRESH_S  # then nothing is known of it any more
        twice = before is not None and not before.modelled and self._reader.apart_deg(before, here) > UNASKED_DEG
        if twice and self._store.state.activity is Activity.IDLE and not self.paused:
            self._moves_unasked()

    def _read_position(self, told: values.Look | None = None) -> None:
        before, stops = self._store.state.position, self._stopper.count
        self._reader.meet_untold()
        after = self._reader.position(heard=told)
        self._watches.position_was_read(self._store.clock.monotonic())
        self._look_again_at = None
        if self._stopper.count == stops:
            self._judge(before, after)  # else STOP came in the middle of it, and looks for itself

    def _judge(self, before: Pointing | None, after: Pointing | None) -> None:
        """At rest, two readings must agree; else the dish moves unasked."""
        if after is None:
            self._unsettled = False
            return
        if before is None:
            self.look_again()  # one reading says nothing about motion
            return
        activity, doubted, self._doubted = self._store.state.activity, self._doubted, None
        if activity is not Activity.IDLE and after.at - before.at < APART_S:
            self.look_again()  # a dish that moves is seen twice at the same place, so soon
            return
        # After a motion that is not followed, or out of sight, a slow dish must not pass for one at rest.
        least_deg = STILL_DEG if self._unsettled or activity is not Activity.IDLE else UNASKED_DEG
        if self._reader.apart_deg(doubted or before, after) <= least_deg:
            if activity is Activity.IDLE and self._has_crept(doubted or before, after):
                self._moves_unasked()
                return
            self._antenna.moving.end()
            self._unsettled = False
            self._mover.activity(Activity.IDLE, "")
            return
        self.look_again()
        if activity is Activity.UNKNOWN and not self._store.state.raw_motion:
            if self._searches_when_met:
                # No fault: it did so before anybody was here. Most likely it searches, as it does from power-up on.
                self._mover.activity(Activity.MOVING_UNASKED, "")
            elif self._antenna.motion is None and not self._unsettled:
                self._moves_unasked()
        elif activity is Activity.IDLE and doubted is None:
            self._doubted = before  # a digit may have been lost on the wire: only a second reading is proof
        elif activity is Activity.IDLE:
            self._moves_unasked()

    def _has_crept(self, before: Pointing, after: Pointing) -> bool:
        """Return whether a dish of which each reading agrees with the last one is elsewhere than where it rested."""
        rested, since = self._rested, self._store.state.activity_since
        if rested is None or rested.at < since:
            rested = self._rested = before if before.at >= since else after
        return self._reader.apart_deg(rested, after) > UNASKED_DEG

    def _moves_unasked(self) -> None:
        self._mover.activity(Activity.MOVING_UNASKED, "")
        self._mover.forget_target()
        self.look_again()
        if self._store.state.fault is not None and self._store.state.search is TvSearch.RUNNING:
            return  # it was told that the dish has restarted, and that it searches then
        self.raise_fault(
            FaultReason.MOVED, "The dish moves unasked",
            "Its own TV search, another program, a hand or the wind may move it.",
            "Keep clear. Press Space to stop it. If it goes on, cut its power.",
        )  # fmt: skip

    @property
    def _searches_when_met(self) -> bool:
        return self._antenna.rotator.facts.search_switch is SearchSwitch.UNTIL_POWER_UP

    def met(self) -> None:
        """The dish answers: see whether it moves."""
        self._met = True
        self._starting.answers()
        self.boot_log.ended()
        if self._antenna.moving.motor_runs:  # it was left running as the line was lost: nothing else ends that
            self._stopper.call("birdcage", HeldReason.LINK)
            self._stopper.take_calls()
        if self._store.state.activity is Activity.INITIALIZING:
            self._mover.activity(Activity.UNKNOWN, "")
        self.look_again()

    def look_afresh(self, *, unsettled: bool) -> None:
        """Somebody else had the console: read the position at once; `unsettled`, until the dish is seen at rest."""
        self._unsettled = self._unsettled or unsettled
        self._look_again_at = self._antenna.rotator.next_look(self._store.clock.monotonic())

    def look_again(self) -> None:
        """Read the position twice in short order, to see whether the dish moves."""
        self._look_again_at = self._antenna.rotator.next_look(self._store.clock.monotonic() + UNASKED_POLL_S)

    def _stalled(self, axis: str, sentence: str) -> None:
        self._mover.activity(Activity.IDLE, "")
        self._raise_stall(blocked(axis, sentence, self._antenna.model))
        if self._antenna.model.drives_on:  # else it jumps as soon as somebody frees it
            self._stopper.call("birdcage", HeldReason.FAULT)
            self._stopper.take_calls()

    def _raise_stall(self, found: MotorFault) -> None:
        self.raise_fault(
            FaultReason.STALL, found.what, found.meaning, found.remedy, axis=found.axis, homing=found.homing
        )

    def _speed_stuck(self, sentence: str) -> None:
        """A speed that was changed for a while could not be put back."""
        self.raise_fault(
            FaultReason.SPEED, "The dish did not restore its speed", f"The dish moves slower than planned. {sentence}",
            "Set its speed, or switch it off and on to restore its own.",
        )  # fmt: skip

    def _forgotten(self) -> None:
        """Homing, or a sync, was lost without boot text: as after a dip of the supply."""
        synced = bool(self._antenna.rotator.facts.must_be_synced)
        self._antenna.moving.forget()
        self._reader.forget_survey()
        self.interrupted(HeldReason.FAULT)
        self.raise_fault(
            FaultReason.UNHOMED, "The dish no longer knows where it points",
            "It was synced a moment ago. Its zero was changed, its power dipped, or it restarted silently." if synced
            else "It was homed a moment ago. Its power dipped, or it restarted silently.",
            f"Check its power and cable. {THEN_SYNC if synced else AGAIN}",
        )  # fmt: skip

    def raise_fault(
        self, reason: FaultReason, what: str, meaning: str, remedy: str, *, axis: str = "", homing: bool = False
    ) -> None:  # fmt: skip
        """Stop asking for motion, and say so until a person acknowledges."""
        at, utc = self._store.stamp()
        stood = self._store.state.position if self._store.state.position_lost is None else None
        az_deg, el_deg = (None, None) if stood is None else (stood.az_deg, stood.el_deg)
        fault = Fault(reason, what, meaning, remedy, utc, axis, homing, az_deg, el_deg)
        self._store.change(fault=fault)
        self._store.tell(FaultRaised(at, utc, fault))
        self._control.hold("birdcage", HeldReason.FAULT)

    def on_line(self, line: str) -> None:
        """Hear an unsolicited line."""
        raw = self._antenna.raw
        self._store.tell(TranscriptLine(*self._store.stamp(), "<", line, raw is not None and raw.is_prompt(line)))
        self.boot_log.hear(line)
        self._starting.hear(line, met=self._met)

    def troubled(self, trouble: MotorTrouble) -> None:
        """Hear unasked that an axis does not turn, or did not find its reference."""
        self._store.tell(TranscriptLine(*self._store.stamp(), "<", trouble.said))
        self.boot_log.hear(trouble.said)
        if self._met:
            self.hear_trouble(trouble)
            return
        self._hear_failed_homing(trouble)
        self._starting.hear(trouble.said, met=self._met)

    def restarted(self, line: str) -> None:
        """Hear a line that tells that the dish has just started: it has forgotten everything."""
        self._store.tell(TranscriptLine(*self._store.stamp(), "<", line))
        self.boot_log.marked(line)
        fault = self._store.state.fault
        if self._starting.begins_by(line.strip()):
            self._store.tell(DishRestarted(*self._store.stamp(), line.strip(), self._met))
        self._starting.ended()
        self._parts.signals.restarted()
        if not self._met:
            self._mover.activity(Activity.INITIALIZING, line.strip())
        elif fault is None or fault.reason is not FaultReason.REBOOT:
            self.forget(Reason.REBOOT)
            self.interrupted(HeldReason.FAULT)
            self._starting.ended()
            if fault is None or not self._failed_to_home:
                told = self._antenna.rotator.facts.must_be_synced
                self.raise_fault(
                    FaultReason.REBOOT, f"The dish has restarted: {line.strip()!r}",
                    told or "It homes by itself or must be homed, and may start its TV search.",
                    f"Check its power and cable. {THEN_SYNC if told else THEN_HOME}",
                )  # fmt: skip
        self._failed_to_home = False

    def hear_trouble(self, trouble: MotorTrouble) -> None:
        """End what moves, and raise the fault."""
        found = motor_fault(trouble, self._antenna.rotator.facts)
        fault, motion = self._store.state.fault, self._antenna.motion
        self._mover.fail(End.FAULT, found.what, Stopped(found.what, reason=Reason.STALL))
        if motion is not None and motion.silent:
            self._stopper.call("birdcage", HeldReason.FAULT)  # the other axis is still on its way
            self._stopper.take_calls()
        else:
            self._antenna.moving.end()  # STOP must not send it to its target once more
            self._mover.activity(Activity.UNKNOWN, "")
            self._unsettled = True  # the other axis may still be on its way, as it was asked to
            self.look_again()
        if found.homing:
            self._hear_failed_homing(trouble)
        elif fault is None:
            self._raise_stall(found)

    def _hear_failed_homing(self, trouble: MotorTrouble) -> None:
        """Of a dish that starts, and was not met yet, only a failed homing counts."""
        found, fault = motor_fault(trouble, self._antenna.rotator.facts), self._store.state.fault
        if not found.homing:
            return
        self._failed_to_home = True
        if fault is None or fault.reason in LESS_THAN_A_FAILED_HOMING:
            self._raise_stall(found)

    def hear_refusal(self, error: BirdcageError) -> bool:
        """Return whether what the dish answered instead of its reply was that an axis is in trouble."""
        trouble = error.trouble if isinstance(error, CommandRefused) else None
        if trouble is not None:
            self.hear_trouble(trouble)
        return trouble is not None

    def forget(self, reason: Reason) -> None:
        """Drop what is known of the position."""
        # A dish that starts finds its references, or says that it has none.
        self._antenna.gate.released.clear()
        self._antenna.moving.motor_runs = False
        self._antenna.moving.forget()
        self._reader.forget_survey()
        self._reader.forget(reason)
        self._store.change(homed=None)

    def expect_another_dish(self) -> None:
        """What answers next may be another dish: drop what is known of this one."""
        self._met, self._doubted = False, None
        self._mover.forget_target()
        self._control.expect_another_dish()
        self.forget(Reason.LINK)

    def interrupted(self, reason: HeldReason) -> None:
        """The dish was out of sight: what moved is given up, and nothing moves by itself afterwards."""
        state = self._store.state
        moving = self._mover.is_moving or state.activity in (Activity.FOLLOWING, Activity.MOTOR_RUN)
        holder = state.holder
        self._parts.signals.interrupted(reason)
        self._mover.fail(
            End.STOPPED,
            f"interrupted: {reason}",
            Stopped(f"The motion was cancelled: {reason}.", reason=Reason(reason.value)),
        )
        self._watches.end_excursion()
        self._antenna.strategy.lose_track(self._store.clock)
        if moving:
            self._store.change(motion=None)  # a pursuit's, too: where it leads now is not known
            self._mover.activity(Activity.UNKNOWN, "")
            self.look_again()
        if moving or holder is not None:
            self._control.hold("birdcage", reason)

    def check_clock(self) -> None:
        """Notice a suspend or a step of the clock: stop what moves, hold, and read the position again."""
        offset_s = self._clock_offset_s()
        # From one look to the next: a clock that is slewed slowly does not step.
        step_s, self._offset_s = offset_s - self._offset_s, offset_s
        if abs(step_s) <= CLOCK_STEP_S:
            return
        detail = f"{CLOCK_STEP} of {step_s:+.0f} s"
        self._parts.signals.interrupted(HeldReason.CLOCK)
        self._reader.forget(Reason.CLOCK)
        self.look_again()
        self._mover.fail(End.STOPPED, "the clock stepped", Stopped("The clock stepped: the motion was cancelled."))
        if self._antenna.motion is not None:
            self._stopper.call("birdcage", HeldReason.CLOCK, detail=detail)
            self._stopper.take_calls()
        self._control.hold("birdcage", HeldReason.CLOCK, detail=detail)

    def _clock_offset_s(self) -> float:
        clock = self._store.clock
        return clock.utc().timestamp() - clock.monotonic() * clock.rate
