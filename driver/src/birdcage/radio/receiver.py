"""The receiver at the other end: connected to, tuned, listened to, told when to record, and let go."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from datetime import timedelta

from birdcage.base.clock import Clock
from birdcage.base.config.tracking_sections import RadioSettings
from birdcage.base.reason import Reason
from birdcage.radio import peer
from birdcage.radio.errors import RadioLost, RadioRefused
from birdcage.radio.now import RadioNow, RadioState
from birdcage.radio.recorder import Recorder
from birdcage.radio.rigctl import RigctlClient
from birdcage.radio.tuning import Tuning
from birdcage.radio.wire import CONNECT_S, HURRY_S, Call

TUNE_EVERY_S = 0.1
LOOK_EVERY_S = 1.0
"""How often its frequency and signal are read, and how soon it is asked again for what it refused."""
TUNED_EVERY_S = 10.0
"""How often one that is only listened to is asked where it is tuned: a person may turn it."""
BACKOFF_S = (0.5, 1.0, 2.0, 4.0, 8.0)
NO_LEVEL_S = 30.0
"""How soon one that refuses to tell its level is asked again; it is hung up meanwhile, as SDR++ serves one program."""
OWED_S = 60.0
"""How long after the pass a receiver that went away is called, to tell it LOS."""
ASTRAY_HZ = 1000.0
"""By how much what it says of itself may differ: real radios round to steps of their own."""


class Receiver:
    """Used on one thread, which waits for every answer. `now` is replaced, never changed: any thread may read it."""

    def __init__(
        self, settings: RadioSettings, clock: Clock, where: str, call: Call, publish: Callable[[RadioNow], None]
    ) -> None:
        """`where` is what its address is called, `call` connects to it."""
        self._settings, self._clock, self._publish = settings, clock, publish
        self._connect = call
        self._recorder = Recorder()
        self._rig: RigctlClient | None = None
        self._failures = 0
        self._call_at = self._tune_at = self._look_at = self._asks_tuning_at = -math.inf
        self._tuned_hz: int | None = None
        self._has_strength = True
        self.now = RadioNow(address=where)

    def another_pass(self) -> None:
        """What it did not know in the pass before is tried again."""
        self._recorder.fresh()
        self._call_at = -math.inf
        self._failures, self._has_strength = 0, True

    def work(self, tuning: Tuning, at_s: float) -> float:
        """Do what is due while a pass is on, and return when to come again (monotonic)."""
        if self._rig is None and not self._call(tuning):
            return self._call_at
        assert self._rig is not None
        try:
            if self._recorder.owed is not None and not tuning.is_same_pass(self._recorder.owed):
                self._recorder.end(self._rig)
            self._tune(self._rig, tuning, at_s)
            if self._settings.record and at_s >= tuning.start_s:
                self._recorder.begin(self._rig, tuning)
            self._look(self._rig)
        except RadioLost as error:
            self._lost(error)
            return self._call_at
        self._show(recording=self._recorder.recording)
        return self._clock.monotonic() + TUNE_EVERY_S

    def listen_anew(self) -> None:
        """Somebody begins to look at its level: what it did not know before is tried again, and at once."""
        self._call_at = self._look_at = self._asks_tuning_at = -math.inf
        self._failures, self._tuned_hz = 0, None
        self._put(RadioNow(RadioState.CONNECTING, self._where, recording=self._recorder.recording))

    def listen(self) -> float:
        """Read its level, and now and then where it is tuned, while no pass is on; return when to come again.

        Monotonic seconds. Nothing of it is changed.
        """
        if self._rig is None and not self._call(None):
            return self._call_at
        assert self._rig is not None
        now = self._clock.monotonic()
        if now < self._look_at:
            return self._look_at
        self._look_at = now + LOOK_EVERY_S
        try:
            self._read_strength(self._rig)
            quick = self._clock.monotonic() - now < LOOK_EVERY_S / 2.0  # a slow one has no time for both
            if quick and now >= self._asks_tuning_at:
                self._asks_tuning_at = now + TUNED_EVERY_S
                self._read_tuning(self._rig)
        except RadioLost as error:
            self._lost(error)
            return self._call_at
        code = self.now.strength_refused
        if code is not None:
            self._hang_up()
            self._call_at = self._clock.monotonic() + NO_LEVEL_S
            self._show(state=RadioState.REFUSED, sentence=f"{self._where}: {peer.no_level(code)}")
            return self._call_at
        self._failures = 0
        self._show(state=RadioState.LISTENING, sentence="")
        return self._look_at

    def _read_tuning(self, rig: RigctlClient) -> None:
        try:
            self._show(read_back_hz=rig.frequency_hz())
        except RadioRefused:
            self._show(read_back_hz=None)

    @property
    def owes(self) -> bool:
        """Whether LOS is still to be told for a pass that is over."""
        return self._recorder.owed is not None

    def rest(self, at_s: float) -> float:
        """Tell LOS where it is owed, and hang up; return when to come again, or `inf`."""
        owed = self._recorder.owed
        if owed is not None and at_s > owed.end_s + OWED_S and self._rig is None:
            self._recorder.give_up()
            sentence = f"{self._where} was not reachable at LOS: it may still record."
            self._show(state=RadioState.OFF, sentence=sentence, recording=None)
            return math.inf
        if owed is not None and self._rig is None and not self._call(owed):
            return self._call_at
        if self._rig is None:
            return math.inf
        try:
            self._recorder.end(self._rig)
        except RadioLost as error:
            self._lost(error)
            return self._call_at if self._recorder.owed is not None else math.inf
        self._hang_up()
        return math.inf

    def finish(self) -> bool:
        """Hang up for good, LOS first where it is owed; False if it may not have been heard."""
        heard = True
        try:
            if self._rig is None and self._recorder.owed is not None:
                self._rig = RigctlClient(self._connect(HURRY_S), self._clock.monotonic, reply_s=HURRY_S)
            if self._rig is not None:
                self._recorder.end(self._rig)
        except RadioLost:
            heard = False
        self._hang_up()
        self.idle(None)
        return heard

    def idle(self, coming: Tuning | None) -> None:
        """Show that it is left alone, and for which pass it will be taken."""
        sentence = self.now.sentence if self.now.state is RadioState.OFF else ""
        now = RadioNow(address=self.now.address, recording=self._recorder.recording, sentence=sentence)
        if coming is not None:
            now = replace(now, name=coming.name, downlink_hz=coming.downlink_hz)
        self._put(now)

    @property
    def _where(self) -> str:
        return self.now.address

    def _call(self, tuning: Tuning | None) -> bool:
        """Connect, and ask for its frequency, which whatever speaks this protocol answers."""
        if self._clock.monotonic() < self._call_at:
            return False
        name, downlink_hz = ("", None) if tuning is None else (tuning.name, tuning.downlink_hz)
        self._put(RadioNow(RadioState.CONNECTING, self._where, name, downlink_hz,
                           sentence=self.now.sentence, recording=self._recorder.recording))  # fmt: skip
        try:
            self._rig = RigctlClient(self._connect(CONNECT_S), self._clock.monotonic)
            read_back_hz = _or_none(self._rig.frequency_hz)
        except RadioLost as error:
            self._lost(error, first=self._rig is not None)
            return False
        self._tuned_hz = None
        self._tune_at = self._look_at = -math.inf
        self._show(read_back_hz=read_back_hz)
        return True

    def _tune(self, rig: RigctlClient, tuning: Tuning, at_s: float) -> None:
        now = self._clock.monotonic()
        wanted_hz, shift_hz = tuning.wanted_hz(at_s)
        if now < self._tune_at or (
            self._tuned_hz is not None and abs(wanted_hz - self._tuned_hz) <= self._settings.step_hz
        ):
            return
        self._tune_at = now + TUNE_EVERY_S
        freq_hz = round(wanted_hz)
        told = {"name": tuning.name, "downlink_hz": tuning.downlink_hz, "doppler_hz": shift_hz}
        try:
            rig.tune(freq_hz)
        except (RadioRefused, ValueError) as error:
            self._tune_at = now + LOOK_EVERY_S
            lo = f" (LO {tuning.lo_hz / 1e6:.10g} MHz)" if tuning.lo_hz else ""
            self._show(state=RadioState.REFUSED, sentence=f"{freq_hz / 1e6:.6f} MHz{lo}: {error}", **told)
            return
        self._tuned_hz, self._failures = freq_hz, 0
        sentence = "" if self.now.state is not RadioState.TUNED else self.now.sentence
        self._show(state=RadioState.TUNED, tuned_hz=float(freq_hz), sentence=sentence, **told)

    def _look(self, rig: RigctlClient) -> None:
        now = self._clock.monotonic()
        if now < self._look_at:
            return
        self._look_at = now + LOOK_EVERY_S
        self._show(read_back_hz=_or_none(rig.frequency_hz))
        if self._settings.strength and self._has_strength:
            # Not asked again where it is refused, nor where it cost the connection.
            self._has_strength = False
            self._read_strength(rig)
        if self.now.state is RadioState.TUNED:
            self._show(sentence=self._astray() or peer.remark(replace(self.now, recording=self._recorder.recording)))

    def _read_strength(self, rig: RigctlClient) -> None:
        asked_s, asked_at = self._clock.monotonic(), self._clock.utc()
        try:
            strength_db = rig.strength_db()
        except RadioRefused as refused:
            self._show(strength_db=None, strength_at=None, strength_read_s=None, strength_refused=refused.code)
        else:
            self._has_strength = True
            half_s = (self._clock.monotonic() - asked_s) / 2.0
            self._show(
                strength_db=strength_db, strength_at=asked_at + timedelta(seconds=half_s * self._clock.rate),
                strength_read_s=asked_s + half_s, strength_refused=None,
            )  # fmt: skip

    def _astray(self) -> str:
        read_hz, tuned_hz = self.now.read_back_hz, self.now.tuned_hz
        if read_hz is None or tuned_hz is None or abs(read_hz - tuned_hz) <= max(self._settings.step_hz, ASTRAY_HZ):
            return ""
        return f"It is told {tuned_hz / 1e6:.6f} MHz and says {read_hz / 1e6:.6f}: may it be tuned from here?"

    def _lost(self, error: RadioLost, *, first: bool = False) -> None:
        """Hang up, as what comes next would be out of step, and call again later."""
        self._hang_up()
        wait_s = BACKOFF_S[min(self._failures, len(BACKOFF_S) - 1)]
        self._failures += 1
        self._call_at = self._clock.monotonic() + wait_s
        hint = ""
        if first and error.reason == Reason.SILENT:
            hint = f" {peer.SILENT}"
        if first and error.reason == Reason.CLOSED:
            hint = " gqrx does that to hosts that are not on its list."
        self._show(
            state=RadioState.REFUSED if error.reason == Reason.GARBAGE else RadioState.LOST,
            sentence=f"{self._where}: {error}{hint}",
            read_back_hz=None, strength_db=None, strength_at=None, strength_read_s=None, tuned_hz=None,
            recording=self._recorder.recording,
        )  # fmt: skip

    def _hang_up(self) -> None:
        if self._rig is not None:
            self._rig.close()
            self._rig = None
        self._recorder.disconnected()

    def _show(self, **changes: object) -> None:
        self._put(replace(self.now, **changes))  # type: ignore[arg-type]

    def _put(self, now: RadioNow) -> None:
        if now != self.now:
            self.now = now
            self._publish(now)


def _or_none(ask: Callable[[], float]) -> float | None:
    try:
        return ask()
    except RadioRefused:
        return None
