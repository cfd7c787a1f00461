"""Serves requests, one at a time, on the station's thread."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress

from birdcage.base.errors import BirdcageError, MotionRefused, Stopped, Superseded
from birdcage.base.reason import Reason
from birdcage.station import requests as ask
from birdcage.station.applying import Applying
from birdcage.station.dish_settings import OwnSettingsHandler
from birdcage.station.events import ClientIgnored, End, FaultAcknowledged
from birdcage.station.features import FeatureHandler
from birdcage.station.lost_control import LostControl
from birdcage.station.motor_power import MotorPower
from birdcage.station.motor_runs import MotorRuns
from birdcage.station.mover import Job
from birdcage.station.parts import Parts
from birdcage.station.raw import CONSOLE
from birdcage.station.raw_console import RawConsole
from birdcage.station.rewire import Rewire
from birdcage.station.syncing import Syncing
from birdcage.station.tasks.drive import DriveTask
from birdcage.station.tasks.homing import HomingTask
from birdcage.station.tasks.host import TaskHost
from birdcage.station.tasks.park import ParkTask, ShelterTask
from birdcage.station.tasks.pursuit import Pursuits

SHELTER = "station.not_now"
"""Who parks the dish where the owner's command says *not now*."""


class RequestHandler:
    """Knows who serves what. Errors are raised, and become the future's."""

    def __init__(
        self, parts: Parts, rewire: Rewire, raw_console: RawConsole, applying: Applying, host: TaskHost
    ) -> None:
        self._parts, self._store, self._antenna, self._control = parts, parts.store, parts.antenna, parts.control
        self._mover, self._stopper, self._reader, self._watches = (
            parts.mover,
            parts.stopper,
            parts.reader,
            parts.watches,
        )
        self._rewire, self._raw_console, self._applying, self._host = rewire, raw_console, applying, host
        self._pursuits = Pursuits(parts, host)
        self._unattended = ""
        """Whose last motion no person had asked for; empty if one had."""
        self._motor_runs = MotorRuns(parts, host)
        self._motors, self._features = MotorPower(parts), FeatureHandler(parts)
        self._settings = OwnSettingsHandler(parts, self._features.note_written)
        self._lost_control, self._syncing = LostControl(parts), Syncing(parts)

    def serve(self, request: ask.Request, future: Future[object], stops_seen: int) -> None:
        """Serve one request; its future is resolved now, or at arrival for a motion.

        `stops_seen` is how often STOP had been called when it was asked for.
        """
        match request:
            case ask.Goto() | ask.Follow() | ask.Jog():
                self._move(request, future)
                return
            case ask.Pursue():
                future.set_result(self._pursuits.take_on(request))
                return
            case ask.EndPursuit(by):
                self._pursuits.end(by)
            case ask.TurnSkew():
                self._turn_skew(request, future)
                return
            case ask.Drive():
                self._drive(request)
            case ask.Run():
                self._motor_runs.run(request)
            case ask.EndMotion(holder):
                self._end_motion(holder)
            case ask.BeginTask(kind, values, holder, asked):
                future.set_result(self._host.begin_kind(kind, values, holder, asked=asked).state.number)
                return
            case ask.ResumeTask():
                future.set_result(self._host.resume().state.number)
                return
            case ask.DropTask():
                self._host.drop_kept()
            case ask.Home():
                self._home(request, future)
                return
            case ask.Sync():
                self._make_way(request.holder)
                future.set_result(self._syncing.sync(request))
                self._host.by_hand(request.holder)
                return
            case ask.ReleaseMotors(holder):
                self._make_way(holder)
                self._motors.release(holder, stops_seen)
                self._host.by_hand(holder)
            case ask.Engage(holder):
                self._motors.engage(holder)
            case ask.Stow(holder):
                self._motors.stow(holder, future)
                return
            case ask.Park(az_deg, el_deg, holder, asked):
                self._antenna.gate.require_direction()
                task = ParkTask(self._store, self._antenna, holder, az_deg, el_deg)
                self._host.begin(task, asked=asked, future=future)
                return
            case ask.SetSpeed(axis, speed_deg_s, holder):
                self._make_way(holder)
                future.set_result(self._features.set_speed(axis, speed_deg_s, holder))
                return
            case ask.Read(features, agreed):
                future.set_result(self._features.read(features, agreed=agreed))
                return
            case ask.Set():
                future.set_result(self._features.set(request))
                return
            case ask.ApplySettings(settings):
                self._applying.apply(settings)
            case ask.ReloadSettings(file):
                self._applying.reload(file)
            case ask.Raw():
                self._raw_console.raw(request, future)
                return
            case ask.ListCommands(holder):
                future.set_result(self._raw_console.list_commands(holder))
                return
            case ask.ProbePort(bauds):
                self._raw_console.line.make_way()
                future.set_result(self._rewire.probe(bauds))
                return
            case ask.Connect(port, baud):
                self._raw_console.line.make_way()
                self._rewire.connect(port, baud)
            case ask.SetSearch(holder, disabled):
                future.set_result(self._features.set_search(holder, disabled=disabled))
                return
            case ask.ReadSettings():
                future.set_result(self._settings.read())
                return
            case ask.WriteSettings():
                future.set_result(self._settings.write(request))
                return
            case ask.SaveSettings():
                future.set_result(self._settings.save(request))
                return
            case ask.Stop(by):
                self._stopper.call(by)
                self._stopper.take_calls()
            case ask.Release():
                self._stopper.release(stops_seen)
            case ask.AcquireLease(holder, take_over, for_s):
                self._control.take(holder, take_over=take_over)
                self._control.end_after(for_s)
                if holder == CONSOLE:
                    self._raw_console.begin(holder)
            case ask.ReleaseLease(holder):
                self._control.give_back(holder)
            case ask.Watch():
                self._watches.add(request)
            case ask.Unwatch(watcher):
                self._watches.remove(watcher)
            case ask.ReportIgnored(client, why):
                self._store.tell(ClientIgnored(*self._store.stamp(), client, why))
            case ask.AcknowledgeFault(by):
                self._acknowledge(by)
            case ask.AcceptLimits():
                self._store.change(motion_refused_because=None)
        future.set_result(None)

    def ending(self) -> tuple[End, str, BirdcageError]:
        """Return how motions end when the station does."""
        return End.STOPPED, "the station ends", Stopped("The station has ended.", reason=Reason.CLOSING)

    def _ready(self, holder: str) -> None:
        self._control.admit(holder)
        self._parts.free_wire()

    def _make_way(self, holder: str) -> None:
        """End what prints on, unless `holder` will be refused anyway."""
        if self._control.latched or self._store.state.holder in (None, holder):
            self._raw_console.line.make_way()

    def _move(self, request: ask.Goto | ask.Follow | ask.Jog, future: Future[object]) -> None:
        self._antenna.gate.require_direction()
        if isinstance(request, ask.Jog):
            az_deg, el_deg = self._jogged(request)
        else:
            az_deg, el_deg = request.az_deg, request.el_deg
        clamp = not isinstance(request, ask.Jog) and request.clamp
        follow = isinstance(request, ask.Follow)
        if not isinstance(request, ask.Jog):
            self._lost_control.go_on(request.holder, request.resume_within_s)
        self._control.refuse(request.holder, az_deg, el_deg)
        unasked = isinstance(request, ask.Goto | ask.Follow) and not request.asked
        if unasked:
            self._refuse_unattended()
        previous = self._take_for(request, lambda: self._judge(az_deg, el_deg, clamp=clamp))
        miss_deg = self._antenna.miss_deg(az_deg, el_deg)
        job = Job(az_deg, el_deg, request.holder, future, follow=follow, miss_deg=miss_deg)
        self._host.make_way(request.holder)
        try:
            self._mover.go(job, clamp=clamp, leapfrog=isinstance(request, ask.Follow) and request.leapfrog)
            self._host.by_hand(request.holder)
            self._unattended = request.holder if unasked else ""
        except MotionRefused:
            self._control.hand_back(request.holder, previous)
            raise

    def _refuse_unattended(self) -> None:
        guard = self._parts.guard
        if not guard.allows():
            asks = "The owner's command is asked whether the dish may move. Ask again in a moment."
            raise MotionRefused(guard.objection or asks, reason=Reason.NOT_NOW)

    def ask_guard(self) -> None:
        """Have the owner's command asked; where it objects, end a single motion that no person has asked for."""
        guard, before = self._parts.guard, self._parts.guard.objection
        guard.tick()
        single = bool(self._unattended) and self._mover.is_moving and self._unattended == self._store.state.holder
        if guard.objection and single:
            self._parts.come_to_rest(guard.objection)
            self._control.give_back(self._unattended)
        if guard.objection and not before and guard.shelter and (single or self._host.moves_unattended):
            task = ShelterTask(self._store, self._antenna, SHELTER, *guard.shelter)
            with suppress(BirdcageError):  # no link, HELD: the dish rests where it is
                self._host.begin(task, asked=False)

    def _take_for(
        self, request: ask.Goto | ask.Follow | ask.Jog | ask.TurnSkew, judge: Callable[[], None]
    ) -> str | None:
        """Take control for a motion once it is judged; return who had it before. What is refused takes nothing."""
        take_over = not isinstance(request, ask.Follow) and request.take_over
        previous = self._store.state.holder
        self._control.may_take(request.holder, take_over=take_over)
        self._parts.free_wire()
        judge()
        self._control.take(request.holder, take_over=take_over)
        return previous

    def _judge(self, az_deg: float, el_deg: float, *, clamp: bool) -> None:
        """Raise MotionRefused for what the last reading forbids: the mover judges the way, by one of its own.

        A pursuit that has changed the dish's speeds ends before that, so the whole way is judged for it here.
        """
        gate = self._antenna.gate
        if self._host.speeds.are_changed:
            self._antenna.aim(az_deg, el_deg, leapfrog=False, clamp=clamp)
        elif gate.position is not None:
            gate.check_limits(*self._antenna.to_dish(az_deg, el_deg, clamp=clamp))

    def _turn_skew(self, request: ask.TurnSkew, future: Future[object]) -> None:
        self._antenna.gate.check_skew(request.deg)
        self._control.refuse(request.holder)
        previous = self._take_for(request, lambda: self._mover.check_skew(request.deg))
        here = self._store.state.position
        az_deg, el_deg = (here.az_deg, here.el_deg) if here is not None else (0.0, 0.0)
        try:
            self._mover.turn_skew(Job(az_deg, el_deg, request.holder, future, skew_deg=request.deg))
            self._host.by_hand(request.holder)
        except MotionRefused:
            self._control.hand_back(request.holder, previous)
            raise

    def _jogged(self, jog: ask.Jog) -> tuple[float, float]:
        base = self._mover.target
        if base is None:
            position = self._store.state.position if self._store.state.position_lost is None else None
            if position is None:
                self._control.refuse(jog.holder)
                if self._store.state.awaits_first_move:
                    raise MotionRefused(
                        "This dish does not tell where it points, so no step is sent. Send it to an azimuth and an "
                        "elevation first. Nothing was sent.", reason=Reason.UNTOLD,
                    )  # fmt: skip
                raise MotionRefused(
                    "The position is unknown, so no step is sent. Wait until it is read.", reason=Reason.UNREAD
                )
            base = position.az_deg, position.el_deg
        return (base[0] + jog.d_az_deg) % 360.0, base[1] + jog.d_el_deg

    def _home(self, request: ask.Home, future: Future[object]) -> None:
        rotator = self._antenna.rotator
        if rotator.facts.no_homing:
            raise MotionRefused(f"{rotator.facts.no_homing} Nothing was sent.", reason=Reason.UNSUPPORTED)
        axes = (rotator.facts.azimuth.index, rotator.facts.elevation.index)
        if not set(request.axes) <= set(axes):
            raise MotionRefused(f"This dish has the axes {axes} only. Nothing was sent.", reason=Reason.UNSUPPORTED)
        self._ready(request.holder)
        self._host.by_hand(request.holder)
        self._mover.fail(End.SUPERSEDED, "homing", Stopped("Homing replaced the motion."))
        self._antenna.moving.forget()
        self._store.change(homed=None, position=None, position_lost=Reason.HOMING)
        self._host.begin(HomingTask(request.holder, request.axes or axes, not request.axes), future=future)

    def _drive(self, request: ask.Drive) -> None:
        """Begin to drive, or go on. What a person moves by hand ends what else they had moving."""
        self._antenna.gate.require_direction()
        if not any((request.az, request.el)) or not {request.az, request.el} <= {-1, 0, 1}:
            raise MotionRefused("A drive goes by -1, 0 or 1 on each axis. Nothing was sent.", reason=Reason.DIRECTION)
        driving = self._host.find(DriveTask.kind)
        if driving is None or driving.task.holder != request.holder:
            self._control.refuse(request.holder)
            self._control.may_take(request.holder)
            self._parts.free_wire()
            self._antenna.gate.require_position()
            self._control.take(request.holder)
            self._host.by_hand(request.holder)
            replaced = "A drive replaced the motion."
            self._mover.fail(End.SUPERSEDED, replaced, Superseded(replaced))
        self._host.drive(request.holder, request.az, request.el)

    def _end_motion(self, holder: str) -> None:
        self._host.end_all_of(holder)
        if self._store.state.holder == holder:
            if self._mover.is_moving:
                self._parts.come_to_rest(f"Ended by {holder}.")
            self._control.give_back(holder)

    def _acknowledge(self, by: str) -> None:
        fault = self._store.state.fault
        if fault is not None:
            self._store.change(fault=None)
            self._store.tell(FaultAcknowledged(*self._store.stamp(), fault, by))
