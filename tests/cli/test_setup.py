"""`birdcage setup`: the list without a dish, and the conversation on a terminal."""

from __future__ import annotations

import contextlib
import os
import pty
import select
import signal
import subprocess
import sys
import termios
import time
import tomllib
from pathlib import Path

import pytest
from birdcage.base.paths import Paths

RUN = """
import signal
signal.signal(signal.SIGINT, signal.default_int_handler)
from birdcage.cli import main
main()
"""


def test_the_list_needs_no_dish_and_opens_no_port(run):
    result = run("setup", "--list", port="/dev/nothing")
    assert result.exit_code == 0, result.stderr
    lines = result.stdout.splitlines()
    assert [line.split()[0] for line in lines] == [str(number) for number in range(1, 12)]
    assert lines[0].split() == ["1", "Link", "todo"]
    assert lines[10].split()[:4] == ["11", "First", "satellite", "todo"]


def test_json_has_every_step_and_what_is_kept(run, as_json):
    file = Paths.default().config_file
    file.parent.mkdir(parents=True)
    file.write_text('[setup]\nlevel = "skipped 2026-03-20T12:00Z"\nlink = "done 2026-03-20T12:00Z: ttyUSB0, FTDI"\n')
    steps = as_json(run("setup", "--json"))
    assert {key: steps[0][key] for key in ("number", "name", "state", "evidence")} == {
        "number": 1, "name": "link", "state": "done", "evidence": "ttyUSB0, FTDI",
    }  # fmt: skip
    assert [each["state"] for each in steps if each["name"] in ("level", "first", "feed")] == [
        "todo",
        "skipped",
        "todo",
    ]


def test_without_a_terminal_it_asks_nothing(run, pty_dish):
    result = run("setup", port=pty_dish.path, input="\n\n")
    assert result.exit_code == 2
    assert "--list needs none" in result.stderr
    assert pty_dish.lines() == []


def test_a_new_user_need_not_know_the_name_of_the_firmware(run):
    assert run("setup", "--list", env={"BIRDCAGE_FIRMWARE": ""}).exit_code == 0


DEADLINE_S = 60.0
"""For what a program of its own does: seconds on a loaded machine."""


class Person:
    """Someone at a terminal, who reads what is said and types."""

    def __init__(self, *words, **environ):
        self._master, slave = pty.openpty()
        attributes = termios.tcgetattr(slave)
        attributes[3] &= ~termios.ECHO
        termios.tcsetattr(slave, termios.TCSANOW, attributes)
        self._process = subprocess.Popen(
            [sys.executable, "-c", RUN, "setup", *words], stdin=slave, stdout=slave, stderr=slave,
            env={**os.environ, "BIRDCAGE_FIRMWARE": "g2", "BIRDCAGE_LINK_DELAY_S": "0.3", **environ},
            start_new_session=True, preexec_fn=_take_terminal,
        )  # fmt: skip
        os.close(slave)
        self.screen = ""
        self._read = 0

    def sees(self, words, seconds=DEADLINE_S):
        """Wait for words that come after those that were seen last."""
        end = time.monotonic() + seconds
        while words not in self.screen[self._read :]:
            assert time.monotonic() < end, f"no {words!r} in:\n{self.screen}"
            if select.select([self._master], [], [], 0.05)[0]:
                with contextlib.suppress(OSError):
                    self.screen += os.read(self._master, 4096).decode(errors="replace").replace("\r\n", "\n")
        self._read = self.screen.index(words, self._read) + len(words)

    def types(self, text):
        os.write(self._master, (text + "\n").encode())

    def answers(self, prompt, text):
        self.sees(prompt)
        self.types(text)

    def presses(self, key):
        os.write(self._master, key)

    def ends(self, seconds=DEADLINE_S):
        end = time.monotonic() + seconds
        while self._process.poll() is None and time.monotonic() < end:
            if select.select([self._master], [], [], 0.05)[0]:
                with contextlib.suppress(OSError):
                    self.screen += os.read(self._master, 4096).decode(errors="replace").replace("\r\n", "\n")
        return self._process.poll()

    def close(self):
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()
        os.close(self._master)


def _take_terminal():
    import fcntl

    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture
def person():
    met = []

    def meet(*words, **environ):
        met.append(Person(*words, **environ))
        return met[-1]

    yield meet
    for each in met:
        each.close()


def kept():
    return tomllib.loads(Path(Paths.default().config_file).read_text())


def test_a_person_is_led_from_step_to_step(person, pty_dish):
    me = person("--port", pty_dish.path)
    me.answers("1 Link> ", "")
    me.sees("1 Link: done.")
    me.sees("2 Dish: done. Carryout G2 02.02.48")
    me.sees("3 TV search off: done. off: NVS 20 TRUE")
    me.answers("5 Feed> ", "x")
    me.answers("Unknown answer", "")
    me.sees("5 Feed: done. stock Ku LNB")
    me.answers("6 Limits> ", "")
    me.answers("7 Direction> ", "")
    me.answers("Is its area clear", "no")
    me.sees("Nothing was moved.")
    me.answers("7 Direction> ", "s")
    me.answers("8 Level> ", "")
    me.answers("pitch (deg", "1,5")
    me.answers("roll (deg", "abc")
    me.sees("'abc' is not a number")
    me.answers("8 Level> ", "q")
    me.sees("`birdcage setup` continues it")
    assert me.ends() == 0
    setup = kept()["setup"]
    assert set(setup) == {"link", "dish", "search", "feed", "limits", "direction"}
    assert setup["direction"].startswith("skipped ")
    assert kept()["dish"]["port"] == pty_dish.path
    assert [line for line in pty_dish.moves() if line != "a"] == []


@pytest.mark.parametrize("pty_dish", ["az_speed=8"], indirect=True)
def test_ctrl_c_while_it_moves_stops_the_dish_and_keeps_what_is_done(person, pty_dish):
    me = person("--port", pty_dish.path, "--step", "level")
    me.answers("8 Level> ", "")
    me.answers("pitch (deg", "1")
    me.answers("roll (deg", "0")
    me.sees("8 Level: done.")
    me.answers("9 Location, clock> ", "s")
    me.sees("Move it a little")
    me.answers("10 North> ", "j")
    me.answers("Is its area clear", "y")
    me.answers("az (deg", "-170")
    me.answers("el (deg", "")
    pty_dish.wait_for_motion()
    me.presses(b"\x03")
    assert me.ends() == 130
    assert "The dish was last seen at AZ" in me.screen
    pty_dish.wait_for(lambda truth: not truth.moving, 5.0)
    assert 180.0 < pty_dish.device.truth().az_deg < 359.99
    assert abs(pty_dish.device.truth().az_deg - 190.0) > 20.0
    assert kept()["alignment"]["pitch_deg"] == 1.0
    assert kept()["setup"]["level"].startswith("done ")


def test_ctrl_c_at_a_question_ends_at_once(person, pty_dish):
    me = person("--port", pty_dish.path)
    me.sees("1 Link> ")
    me.presses(b"\x03")
    assert me.ends() == 130
    assert [line for line in pty_dish.moves() if line != "a"] == []


def test_goes_on_where_it_was(person, pty_dish):
    for prompt, answer in (("1 Link> ", ""), ("5 Feed> ", "")):
        me = person("--port", pty_dish.path)
        me.answers(prompt, answer)
        me.sees(": done.")
        me.sees("> ")
        me.types("q")
        assert me.ends() == 0
    assert "feed" in kept()["setup"]


def test_no_line_is_broken_inside_a_word(person, pty_dish):
    me = person("--port", pty_dish.path, "--step", "level", COLUMNS="60")
    me.answers("8 Level> ", "l")
    me.sees("11 First satellite")
    me.answers("8 Level> ", "q")
    assert me.ends() == 0
    lines = [line for line in me.screen.splitlines() if pty_dish.path not in line and not line.startswith("…")]
    assert any(line.endswith("Better than") for line in lines)
    assert max(map(len, lines)) < 60
