"""The simulator as another program meets it: a pty or TCP port, in a process of its own."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest
import serial

# A test may itself run under nohup or in the background of a shell, whose children ignore signals.
SERVE = """
import json, pathlib, signal, sys
signal.signal(signal.SIGHUP, signal.SIG_DFL)
signal.signal(signal.SIGINT, signal.default_int_handler)
from birdcage.sim.run import run_simulator
arguments = json.loads(sys.argv[1])
if "link" in arguments:
    arguments["link"] = pathlib.Path(arguments["link"])
sys.exit(run_simulator("g2", json=True, **arguments))
"""


class Served:
    def __init__(self, **arguments) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-c", SERVE, json.dumps(arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.info = json.loads(self.process.stdout.readline())
        self._control = socket.socket(socket.AF_UNIX)
        self._control.settimeout(5)
        self._control.connect(self.info["control"])
        self._lines = self._control.makefile("rw")

    def open(self, baud=115200) -> serial.SerialBase:
        return serial.serial_for_url(self.info["port"], baudrate=baud, timeout=5)

    def do(self, what, **fields):
        self._lines.write(json.dumps({"do": what, **fields}) + "\n")
        self._lines.flush()
        return json.loads(self._lines.readline())

    def end(self, number=signal.SIGTERM) -> int:
        self._control.close()
        self.process.send_signal(number)
        status = self.process.wait(10)
        assert self.process.stderr.read() == ""
        self.process.stdout.close()
        self.process.stderr.close()
        return status


@pytest.fixture
def served():
    running = []

    def start(**arguments) -> Served:
        running.append(Served(**arguments))
        return running[-1]

    yield start
    for one in running:
        if one.process.poll() is None:
            one.end()


def ask(port, line, prompt=b"MOT>"):
    port.write(line + b"\r")
    return port.read_until(prompt)


pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="no pseudo-terminals")


@pytest.mark.parametrize("kind", ["pty", "link", "tcp"])
def test_pyserial_talks_to_it_one_program_after_the_other(served, kind, tmp_path):
    arguments = {"pty": {}, "link": {"link": str(tmp_path / "dish")}, "tcp": {"tcp": True}}[kind]
    sim = served(**arguments)
    assert sim.info["firmware"] == "g2"
    if kind == "link":
        assert sim.info["port"] == str(tmp_path / "dish")
    with sim.open() as port:
        assert ask(port, b"mot") == b"mot\r\nMOT>"
        assert ask(port, b"a") == b"a\r\nAngle[0] = 0.00\r\nAngle[1] = 45.00\r\nMOT>"
    with sim.open() as port:
        assert ask(port, b"a 1 60").endswith(b"Angle = 60.00\r\nMOT>")
    assert sim.do("truth")["truth"]["menu"] == "mot"
    assert [line for _, line in sim.do("received")["received"]] == ["mot", "a", "a 1 60"]
    assert sim.end() == 0
    assert not Path(sim.info["control"]).exists()
    assert not (tmp_path / "dish").is_symlink()


def test_unplugging_and_return_on_another_path_under_the_same_link(served, tmp_path):
    sim = served(link=str(tmp_path / "dish"))
    before = Path(sim.info["port"]).readlink()
    holder = os.openpty()  # keeps the next pty from getting the old one's number
    with sim.open() as port:
        ask(port, b"mot")
        assert sim.do("unplug")["ok"]
        assert not (tmp_path / "dish").is_symlink()
        with pytest.raises(serial.SerialException):
            port.read(1)
    assert sim.do("plug")["port"] == str((tmp_path / "dish").readlink())
    with sim.open() as port:
        assert ask(port, b"a").startswith(b"a\r\nAngle[0]")
    for descriptor in holder:
        os.close(descriptor)
    assert before.parent == Path("/dev/pts")


@pytest.mark.parametrize("number", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_it_ends_cleanly(served, number, tmp_path):
    sim = served(link=str(tmp_path / "dish"))
    assert sim.end(getattr(signal, number)) == 0
    assert not (tmp_path / "dish").is_symlink()


def test_a_link_never_replaces_a_file(tmp_path):
    from birdcage.sim.run import run_simulator

    (tmp_path / "dish").write_text("precious")
    with pytest.raises(FileExistsError, match="choose another name"):
        run_simulator("g2", link=tmp_path / "dish")
    assert (tmp_path / "dish").read_text() == "precious"


def test_speed_pacing_and_options(served):
    sim = served(speed=20.0, pace_baud=115200, options={"unknown_command": "Huh?"})
    with sim.open() as port:
        assert b"Huh?" in ask(port, b"xyz", b"TRK>")
        ask(port, b"mot")
        ask(port, b"a 0 200")
        while sim.do("truth")["truth"]["moving"]:
            pass
        assert b"Angle[0] = 1" in ask(port, b"a")


def test_a_program_at_another_rate_meets_silence(served):
    sim = served()
    with sim.open(57600) as port:
        port.timeout = 0.3
        assert ask(port, b"mot") == b""
        port.baudrate = 115200
        port.timeout = 5
        assert ask(port, b"mot") == b"mot\r\nMOT>"
    with sim.open(1000000) as port:
        port.timeout = 0.3
        assert ask(port, b"a") == b""


def test_faults_through_the_control_socket(served):
    sim = served()
    with sim.open() as port:
        ask(port, b"mot")
        assert sim.do("fault", lane="to_host", double=1.0)["ok"]
        assert ask(port, b"a", b"MMOOTT>>").startswith(b"aa\r\r\n\n")
        assert sim.do("fault", double=0, silent=True)["ok"]
        port.timeout = 0.1
        assert ask(port, b"a") == b""
        assert sim.do("fault", silent=False)["ok"]
        assert sim.do("echo_loss")["ok"]
        port.timeout = 5
        assert ask(port, b"") == b"MOT>"
        assert sim.do("stall", axis=0)["ok"]
        assert sim.do("truth")["truth"]["stalled"] == ["az"]
        assert sim.do("free", axis=0)["ok"]
        assert sim.do("deadlock")["ok"]
        assert not sim.do("truth")["truth"]["shell_alive"]
        assert sim.do("reboot")["ok"]
        assert b"Bootloader" in port.read_until(b"v1.01")
        assert sim.do("power_off")["ok"]
        assert not sim.do("truth")["truth"]["powered"]
        assert sim.do("power_on")["ok"]
        assert sim.do("power_cycle", off_s=0.1)["ok"]


@pytest.mark.parametrize(
    ("request_", "says"),
    [
        ({"do": "dance"}, "unknown request 'dance'"),
        ({"do": "fault", "lane": "up"}, "to_dish or to_host"),
        ({"do": "fault", "loss": 1}, "unknown fault 'loss'"),
        ({"do": "fault", "drop": "much"}, "a number"),
        ({"do": "stall", "axis": 7}, "0 (azimuth) or 1"),
    ],
)
def test_bad_requests_are_answered(request_, says):
    from birdcage.base.clock import VirtualClock
    from birdcage.sim.control import obey
    from birdcage.sim.port import open_device

    with pytest.raises(ValueError, match=re.escape(says)):
        obey(open_device("g2", clock=VirtualClock()), request_)


def test_nonsense_on_the_control_socket(served):
    sim = served(tcp=True)
    sim._lines.write("nonsense\n[]\n")
    sim._lines.flush()
    for _ in range(2):
        assert json.loads(sim._lines.readline())["ok"] is False
