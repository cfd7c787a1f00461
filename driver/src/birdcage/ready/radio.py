"""What is asked of the receiver: whether it answers, what it gives, whether it records."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from birdcage.base.reason import Reason
from birdcage.ready.check import Check

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.radio.probe import ReceiverAnswers

RADIO_S = 1.0
TRY = "birdcage ready --try-recording"
BOX = "tick Recording under Rigctl Server in SDR++"


def radio(settings: Settings, *, try_recording: bool) -> Iterator[Check]:
    """Whether the receiver answers, where one is set, and what it does of what it will be asked in a pass.

    It is asked for frequency, level and modes, and left as it is; `try_recording` lets it record for 2 s.
    """
    address, by_feed = settings.radio.rigctld, settings.active_feed.signal == "rigctl"
    if address is None:
        if by_feed:
            words = f"the feed {settings.feed.active} takes its signal from a receiver, and none is set"
            yield Check("radio", "radio", "look", words, 'radio.rigctld = "localhost:4532"')
        return
    from birdcage.base.errors import ConfigError
    from birdcage.radio.errors import RadioLost
    from birdcage.radio.peer import SILENT, no_level
    from birdcage.radio.probe import ask_receiver

    try:
        answers = ask_receiver(address, RADIO_S, try_recording=try_recording and settings.radio.record)
    except ConfigError as error:
        yield Check("radio", "radio", "look", str(error), "birdcage config path")
        return
    except RadioLost as error:
        remedy = SILENT if error.reason == Reason.SILENT else f"start rigctld, SDR++ or gqrx at {address}"
        yield Check("radio", "radio", "look", str(error), remedy)
        return
    tuned = "" if answers.frequency_hz is None else f", tuned to {answers.frequency_hz / 1e6:.10g} MHz"
    who = ": SDR++, which serves one program at a time" if answers.is_sdrpp else ""
    yield Check("radio", "radio", "good", f"{address} answers{tuned}{who}")
    if by_feed and answers.level_code is not None:
        remedy = f'feed.{settings.feed.active}.signal = "tuner"'
        yield Check("radio", "radio level", "look", no_level(answers.level_code), remedy)
    elif settings.radio.strength and answers.level_code is not None:
        yield Check("radio", "radio level", "look", no_level(answers.level_code), "radio.strength = false")
    if settings.radio.record:
        yield _recording(answers)


def _recording(answers: ReceiverAnswers) -> Check:
    """Return what is known of recording: only a new file proves it."""
    code = answers.recording_code
    if code is None:
        words = "not tried: AOS would start a recording"
        if answers.is_sdrpp:
            words += "; SDR++ answers 0 to it with Recording switched off, too"
        return Check("radio", "recording", "look", words, f"{BOX}, then {TRY}" if answers.is_sdrpp else TRY)
    if code:
        words = f"AOS is answered with RPRT {code}: this receiver does not record"
        return Check("radio", "recording", "look", words, "radio.record = false, and a hook that records")
    if answers.is_sdrpp:
        words = "AOS and LOS are answered with 0, as SDR++ does with Recording switched off, too"
        return Check("radio", "recording", "look", words, f"look for a new file of 2 s; if there is none, {BOX}")
    return Check("radio", "recording", "good", "AOS is taken, and LOS 2 s later: look for the file")
