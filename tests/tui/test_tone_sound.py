"""The tone by the sound system: its pitch measured in what a player got; players that hang, die, or are not there."""

from __future__ import annotations

import array
import contextlib
import itertools
import math
import os
import signal
import sys
import threading
import time

import pytest
from birdcage_tui.feeds.tone_sound import (
    HOLD_S,
    LEAD_BYTES,
    LOUDNESS,
    PLAYERS,
    RATE,
    Oscillator,
    PipedSound,
    find_sound,
)

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere there is the bell")

RECORDS = """#!{python}
import os, sys, time
with open({pid!r}, "w") as file:
    file.write(str(os.getpid()))
with open({out!r}, "ab", buffering=0) as file:
    while True:
        data = os.read(0, 441)
        if not data:
            break
        file.write(data)
        time.sleep(len(data) / 44100)
"""
DIES = "#!/bin/sh\necho 'ALSA lib: something' >&2\necho 'audio open error: No such device' >&2\nexit 1\n"
HANGS = "#!{python}\nimport os, time\nopen({pid!r}, 'w').write(str(os.getpid()))\ntime.sleep(60)\n"


class Player:
    """A stand-in of the system's player."""

    def __init__(self, folder, text, name="player"):
        self.out, self.pid, self.path = folder / f"{name}.pcm", folder / f"{name}.pid", folder / name
        self.path.write_text(text.format(python=sys.executable, pid=str(self.pid), out=str(self.out)))
        self.path.chmod(0o755)
        self.words = (str(self.path),)

    @property
    def samples(self):
        data = self.out.read_bytes() if self.out.exists() else b""
        return array.array("h", data[: len(data) // 2 * 2])

    def runs(self):
        with contextlib.suppress(OSError, ValueError):
            os.kill(int(self.pid.read_text()), 0)
            return True
        return False


def until(true, within_s=20.0, meanwhile=lambda: None):
    end = time.monotonic() + within_s
    while not true():
        meanwhile()
        assert time.monotonic() < end, "it did not come about"
        threading.Event().wait(0.02)


@contextlib.contextmanager
def sounding(*players, hangs_s=3.0):
    sound = PipedSound([each.words for each in players], hangs_s)
    try:
        yield sound
    finally:
        sound.close()


def pitch_of(samples):
    """The pitch by upward zero crossings, between the first and the last one."""
    ups = [index for index in range(1, len(samples)) if samples[index - 1] < 0 <= samples[index]]
    return (len(ups) - 1) * RATE / (ups[-1] - ups[0])


@pytest.mark.parametrize("hz", [220.0, 622.3, 1760.0])
def test_the_pitch_is_right_and_nothing_clicks(hz):
    made = Oscillator()
    samples = array.array("h", made.block(hz) + made.block(hz) + made.block(hz * 2.0) * 1 + made.block(None, 4410))
    assert pitch_of(samples[: RATE // 50 * 2]) == pytest.approx(hz, rel=0.02)
    steepest = 2.0 * math.pi * hz * 2.0 / RATE * LOUDNESS * 1.1 + 50.0
    assert max(abs(b - a) for a, b in itertools.pairwise(samples)) <= steepest
    assert abs(samples[0]) < 200
    assert set(samples[-2000:]) == {0}, "it fades, and is silent then"
    assert max(samples) == pytest.approx(LOUDNESS, rel=0.02)


def test_a_player_gets_the_pitch_and_a_new_one_soon(tmp_path):
    player = Player(tmp_path, RECORDS)
    with sounding(player) as sound:
        until(lambda: len(player.samples) > RATE, meanwhile=lambda: sound.play(440.0))
        before = len(player.samples)
        until(lambda: len(player.samples) > before + RATE // 2, meanwhile=lambda: sound.play(880.0))
        samples = player.samples
        assert sound.trouble == ""
    assert pitch_of(samples[2000:RATE]) == pytest.approx(440.0, rel=0.01)
    assert pitch_of(samples[-4000:]) == pytest.approx(880.0, rel=0.01)
    # What waits in the pipe is all that is late: the new pitch is there after that, and two turns of this test.
    late = before + LEAD_BYTES // 2 + RATE // 50 + RATE // 20
    assert pitch_of(samples[late + RATE // 20 : late + RATE // 5]) == pytest.approx(880.0, rel=0.03)
    assert not player.runs(), "it ended with the tone"


def test_silence_is_played_for_none_and_for_an_app_that_stalls(tmp_path):
    player = Player(tmp_path, RECORDS)
    with sounding(player) as sound:
        until(lambda: any(player.samples), meanwhile=lambda: sound.play(440.0))
        until(lambda: len(player.samples) > 4000 and not any(player.samples[-2000:]), HOLD_S + 15.0)
        sound.play(None)
        until(lambda: len(player.samples) > 4000 and not any(player.samples[-2000:]))
        assert sound.trouble == ""


def test_a_player_that_dies_gives_way_to_the_next_and_at_last_to_none(tmp_path):
    dies, plays = Player(tmp_path, DIES, "dies"), Player(tmp_path, RECORDS, "plays")
    with sounding(dies, plays) as sound:
        until(lambda: any(plays.samples), meanwhile=lambda: sound.play(440.0))
        os.kill(int(plays.pid.read_text()), signal.SIGKILL)
        until(lambda: sound.trouble)
        assert sound.trouble.endswith("plays ended.")
        sound.play(440.0)
    with sounding(dies) as sound:
        sound.play(440.0)
        until(lambda: sound.trouble)
        assert "ended: audio open error: No such device." in sound.trouble


def test_a_player_that_hangs_holds_nobody_up_and_is_ended(tmp_path):
    player = Player(tmp_path, HANGS)
    with sounding(player, hangs_s=0.5) as sound:
        begun = time.monotonic()
        sound.play(440.0)
        assert time.monotonic() - begun < 0.3
        until(lambda: sound.trouble, meanwhile=lambda: sound.play(440.0))
        assert "takes no sound for 0.5 s" in sound.trouble
        until(lambda: not player.runs())
    player.pid.unlink()
    with sounding(player) as sound:
        sound.play(440.0)
        until(player.runs)
        begun = time.monotonic()
        sound.close()
        assert time.monotonic() - begun < 2.0
        until(lambda: not player.runs())


def test_a_player_that_is_not_there_is_said(tmp_path):
    sound = PipedSound([(str(tmp_path / "none"),)])
    sound.play(440.0)
    until(lambda: sound.trouble)
    assert "can't be started" in sound.trouble
    sound.close()
    assert sound.trouble == "", "it is tried anew"


@pytest.mark.parametrize(("environ", "there", "why"), [
    ({"SSH_CONNECTION": "1.2.3.4 5 6 7"}, ("aplay",), "Over ssh"),
    ({}, (), "Without pacat, aplay or play"),
    ({}, ("aplay",), ""),
])  # fmt: skip
def test_who_has_a_sound_system(environ, there, why):
    sound, said = find_sound(environ, lambda name: f"/usr/bin/{name}" if name in there else None)
    assert (said, sound is None) == (why, bool(why))
    if sound is not None:
        assert sound._players == [words for words in PLAYERS if words[0] in there]
