"""What a receiver answers, asked once with a deadline and left as it was."""

from __future__ import annotations

import threading
from dataclasses import dataclass, replace

from birdcage.base.clock import Clock, RealClock
from birdcage.base.errors import BirdcageError
from birdcage.radio.errors import RadioLost, RadioRefused
from birdcage.radio.opening import caller
from birdcage.radio.rigctl import RigctlClient

TAKEN = 0
"""The code behind RPRT of what was done."""
TRIAL_S = 2.0
"""How long a trial recording lasts: long enough to be seen in a folder."""


@dataclass(frozen=True, slots=True)
class ReceiverAnswers:
    """What a receiver told. None is what it refused, or was not asked."""

    frequency_hz: float | None = None
    level_db: float | None = None
    level_code: int | None = None
    """The code behind RPRT where it refused `l STRENGTH`."""
    modes: tuple[str, ...] = ()
    recording_code: int | None = None
    """The code behind RPRT to AOS, where that was tried."""

    @property
    def is_sdrpp(self) -> bool:
        """Whether these are the modes of SDR++'s module rigctl_server: gqrx lists OFF too, Hamlib calls none RAW."""
        return {"DSB", "RAW"} <= set(self.modes) and "OFF" not in self.modes


def ask_receiver(address: str, timeout_s: float = 1.0, *, try_recording: bool = False) -> ReceiverAnswers:
    """Ask the receiver at `address` for frequency, level and modes; each answer has `timeout_s`.

    `try_recording` tells it AOS and, after 2 s, LOS: it records if that is armed, and ends what it recorded before.
    Whoever falls silent after the first answer leaves the rest at None. ConfigError where that is no address, RadioLost
    without that first answer.
    """
    clock = RealClock()
    where, call = caller(address, clock)
    told: list[ReceiverAnswers] = []
    failed: list[BirdcageError] = []

    def ask() -> None:
        try:
            rig = RigctlClient(call(timeout_s), clock.monotonic, reply_s=timeout_s)
            try:
                told.append(_frequency(rig))
                told.append(_level(rig, told[-1]))
                told.append(_modes(rig, told[-1]))
                if try_recording:
                    told.append(_recording(rig, clock, told[-1]))
            finally:
                rig.close()
        except BirdcageError as error:
            failed.append(error)

    # Looking a name up has no deadline of its own: a thread that hangs there is left behind.
    asking = threading.Thread(target=ask, name="radio-probe", daemon=True)
    asking.start()
    longest_s = timeout_s + (2.0 * timeout_s + TRIAL_S if try_recording else 0.5)
    asking.join(longest_s)
    if told:
        return told[-1]
    raise failed[0] if failed else RadioLost(f"{where} has not answered within {longest_s:g} s.")


def _frequency(rig: RigctlClient) -> ReceiverAnswers:
    try:
        return ReceiverAnswers(frequency_hz=rig.frequency_hz())
    except RadioRefused:
        return ReceiverAnswers()


def _level(rig: RigctlClient, before: ReceiverAnswers) -> ReceiverAnswers:
    try:
        return replace(before, level_db=rig.strength_db())
    except RadioRefused as refused:
        return replace(before, level_code=refused.code)


def _modes(rig: RigctlClient, before: ReceiverAnswers) -> ReceiverAnswers:
    try:
        return replace(before, modes=rig.modes())
    except RadioRefused:
        return before


def _recording(rig: RigctlClient, clock: Clock, before: ReceiverAnswers) -> ReceiverAnswers:
    """Record for a moment. LOS is for whoever took AOS (`RigctlClient.word`)."""
    try:
        rig.word("AOS")
    except RadioRefused as refused:
        return replace(before, recording_code=refused.code)
    clock.wait(None, clock.monotonic() + TRIAL_S)
    try:
        rig.word("LOS")
    except RadioRefused as refused:
        return replace(before, recording_code=refused.code)
    return replace(before, recording_code=TAKEN)
