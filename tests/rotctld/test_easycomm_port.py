"""Hamlib's own `rotctl` at the pseudo terminal, one program after the other, on threads and a real clock."""

from __future__ import annotations

import os
import shutil
import subprocess

import pytest

pytest.importorskip("termios", reason="a pseudo terminal is needed")
from birdcage.base.errors import ConfigError
from birdcage.rotctld.easycomm_port import EasycommPort
from birdcage.rotctld.easycomm_service import EasycommService
from birdcage.rotctld.options import RotctldOptions
from birdcage.station.requests import Goto

from .real_dish import RealDish

needs_rotctl = pytest.mark.skipif(shutil.which("rotctl") is None, reason="Hamlib's rotctl is not installed")
MODELS = ("202", "204")


class Served(RealDish):
    """A simulated G2 behind a serial port."""

    def __init__(self, link=None, **options):
        super().__init__()
        self.port, self.told = EasycommPort(link), []
        options = RotctldOptions(park=(180.0, 40.0), **options)
        self.service = EasycommService(self.session.station, self.port, options, self.told.append)
        self.service.start()
        self.wait_for(lambda state: state.position is not None)

    def close(self):
        self.service.shutdown()
        self.session.close()


@pytest.fixture
def served():
    served = Served()
    yield served
    assert served.service.crash is None
    served.close()


def rotctl(served, model, *words):
    """Run it, and return its exit code and what it printed."""
    done = subprocess.run(
        ["rotctl", "-m", model, "-r", served.port.path, *words], capture_output=True, text=True, timeout=20, check=False
    )
    return done.returncode, done.stdout


def say(served, said, answers=0):
    """Talk as a program does that opens the port, and closes it in the end."""
    port = os.open(served.port.path, os.O_RDWR | os.O_NOCTTY)
    try:
        os.write(port, said)
        heard = b""
        while heard.count(b"\n") < answers:
            heard += os.read(port, 100)
        return heard
    finally:
        os.close(port)


@needs_rotctl
@pytest.mark.parametrize("model", MODELS)
def test_rotctl_reads_sets_and_stops(served, model):
    here = served.state.position
    code, told = rotctl(served, model, "p")
    assert (code, [float(each) for each in told.split()]) == (
        0, pytest.approx([here.az_deg, here.el_deg], abs=0.1)
    ), told  # fmt: skip
    assert rotctl(served, model, "P", "20", "50")[0] == 0
    served.wait_at(20.0, 50.0)
    assert [float(each) for each in rotctl(served, model, "p")[1].split()] == pytest.approx([20.0, 50.0], abs=0.1)
    assert rotctl(served, model, "P", "100", "50")[0] == 0
    served.wait_for(lambda state: state.motion is not None)
    assert rotctl(served, model, "S")[0] == 0
    served.wait_for(lambda state: state.motion is None)
    assert served.state.held is None, "it ends its own motion, and is no person's STOP"
    assert abs(served.state.position.az_deg - 100.0) > 1.0, "it did not go on"


@needs_rotctl
def test_rotctl_parks_and_homes_nothing(served):
    assert rotctl(served, "204", "K")[0] == 0
    served.wait_at(180.0, 40.0)
    assert rotctl(served, "204", "R", "1")[0] == 0
    assert rotctl(served, "204", "p")[0] == 0, "what came before it is done"
    assert served.state.motion is None
    served.wait_at(180.0, 40.0)


def test_a_wish_below_the_floor_is_clamped(served):
    say(served, b"AZ10.0 EL0.0\n")
    served.wait_at(10.0, served.state.el_min_deg)


def test_each_program_is_one_of_its_own_and_gives_control_back(served):
    say(served, b"AZ30.0 EL45.0\n")
    served.wait_at(30.0, 45.0)
    served.wait_for(lambda state: state.holder is None)
    assert say(served, b"AZ EL\n", 1).startswith(b"AZ30.")
    served.wait_for(lambda _state: len(served.told) == 4)
    assert [words.rpartition("(")[2] for words in served.told] == [
        "easycomm 1).", "easycomm 1).", "easycomm 2).", "easycomm 2).",
    ]  # fmt: skip


def test_what_one_has_left_unread_does_not_reach_the_next(served):
    say(served, b"VE\nVE\nGE\n")
    served.wait_for(lambda _state: len(served.told) == 2)
    assert say(served, b"GS\n", 1) == b"GS1\n"


def test_bytes_that_are_no_text_end_nothing(served):
    say(served, bytes(range(256)) * 40)
    served.wait_for(lambda _state: len(served.told) >= 2)
    assert say(served, b"\nGE\n", 1) == b"GE1\n"


def test_another_ones_control_is_not_taken(served):
    served.session.station.submit(Goto(60.0, 45.0, "you")).result(20)
    say(served, b"AZ10.0 EL30.0\nSA SE\n")
    served.wait_for(lambda _state: len(served.told) == 2)
    assert served.state.holder == "you"
    served.wait_at(60.0, 45.0)


def test_its_link_is_there_while_it_serves(tmp_path):
    link = tmp_path / "rotator"
    served = Served(link)
    assert os.path.realpath(link) == served.port.path
    served.close()
    assert not link.is_symlink()
    link.write_text("mine")
    with pytest.raises(ConfigError, match="is not a symbolic link"):
        EasycommPort(link)
    assert link.read_text() == "mine"


def test_a_link_of_somebody_elses_is_left_alone_and_an_old_one_of_ours_replaced(tmp_path):
    link = tmp_path / "rotator"
    link.symlink_to("/dev/ttyUSB0")
    with pytest.raises(ConfigError, match="points at /dev/ttyUSB0, not at a pseudo terminal"):
        EasycommPort(link)
    assert str(link.readlink()) == "/dev/ttyUSB0"
    first = EasycommPort(link.with_name("first"))
    link.unlink()
    link.symlink_to(first.path)
    second = EasycommPort(link)
    assert str(link.readlink()) == second.path
    first.close()
    second.close()


def test_only_a_link_that_fails_is_blamed_on_the_link(tmp_path, monkeypatch):
    with pytest.raises(ConfigError, match=r"rotator can't be made: .*\. Choose another --link\."):
        EasycommPort(tmp_path / "no" / "rotator")

    def none_left():
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pty.openpty", none_left)
    with pytest.raises(ConfigError, match=r"No pseudo terminal can be made: No space left on device") as refused:
        EasycommPort(tmp_path / "rotator")
    assert "--link" not in str(refused.value)


def test_a_program_that_closes_the_port_is_seen_on_a_mac_too(monkeypatch):
    """Its system tells so by an end of file, Linux by an error."""
    port = EasycommPort()
    with monkeypatch.context() as patched:
        patched.setattr("os.read", lambda *_: b"")
        assert port.read() is None
    port.close()


def test_one_that_may_only_look_moves_nothing():
    served = Served(read_only=True)
    say(served, b"AZ20.0 EL50.0\n")
    served.wait_for(lambda _state: len(served.told) == 2)
    assert served.state.motion is None
    assert served.state.holder is None
    served.close()
