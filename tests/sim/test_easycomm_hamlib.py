"""Hamlib's own `rotctl`, EasyComm II and III, against the simulated rotators at a pty."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import threading
import time

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.wake import Wake
from birdcage.sim.port import open_device
from birdcage.sim.pty import PtyChannel
from birdcage.sim.server import Server

pytestmark = pytest.mark.skipif(
    shutil.which("rotctl") is None and "CI" not in os.environ, reason="Hamlib's rotctl is not installed"
)
MODELS = ("202", "204")


class Served:
    """A rotator at a pty, in real time."""

    def __init__(self, options):
        self.device = open_device(f"easycomm?seed=1&{options}", clock=RealClock())
        self.channel, self._stop = PtyChannel(), Wake()
        self._server = Server(self.device, self.channel, "sim:easycomm", None)
        self._thread = threading.Thread(target=self._server.serve, args=(self._stop,), daemon=True)
        self._thread.start()

    def rotctl(self, model, *words):
        return subprocess.run(
            ["rotctl", "-m", model, "-r", self.channel.path, *words], capture_output=True, text=True, timeout=20
        )

    def told(self, model, word, line):
        """Give rotctl one command, and let go of the port only when the rotator has read a line."""
        with subprocess.Popen(
            ["rotctl", "-m", model, "-r", self.channel.path, "-"], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, text=True,
        ) as program:  # fmt: skip
            program.stdin.write(f"{word}\n")
            program.stdin.flush()
            self.until(lambda _truth: line in self.lines())
            program.communicate("q\n", timeout=20)

    def lines(self):
        with self.device.lock:
            self.device.machine.run()
            return [line.strip() for _, line in self.device.shell.received]

    def until(self, holds, within_s=15.0):
        end = time.monotonic() + within_s
        while not holds(self.device.truth()):
            assert time.monotonic() < end, self.device.truth()
            time.sleep(0.05)

    def close(self):
        self._stop.set()
        self._thread.join(5.0)
        self._server.close()


@pytest.fixture(params=["az=12.3&el=30", "az=12.3&el=30&replies=apart", "az=12.3&el=30&kind=stock"])
def served(request):
    rotator = Served(request.param)
    yield rotator
    rotator.close()


@pytest.fixture(scope="module")
def splits_the_query():
    """Hamlib from 4.6 on asks `AZ` and `EL` apart."""
    told = subprocess.run(["rotctl", "--version"], capture_output=True, text=True, timeout=20).stdout
    major, minor = re.search(r"Hamlib (\d+)\.(\d+)", told).groups()
    return (int(major), int(minor)) >= (4, 6)


@pytest.mark.parametrize("model", MODELS)
def test_it_reads_the_position(served, model, splits_the_query):
    settings = served.device.settings
    said = served.rotctl(model, "p")
    if splits_the_query and settings.replies == "pair":
        assert said.returncode != 0, "docs/reference/easycomm.md says that such a version fails here"
        return
    assert said.returncode == 0, said.stderr
    assert [float(each) for each in said.stdout.split()] == pytest.approx([12.3, 30.0], abs=0.05)
    assert set(served.lines()) <= {"AZ EL", "AZ", "EL"}


@pytest.mark.parametrize("model", MODELS)
def test_it_sends_a_target_and_stops(served, model):
    served.told(model, "P 60.04 45.06", "AZ60.0 EL45.1")
    served.until(lambda truth: truth.moving)
    served.told(model, "S", "SA SE")
    served.until(lambda truth: not truth.moving)
    assert served.device.truth().az_deg < 59.0, "it was stopped before its target"


def test_it_parks_by_the_rotators_own_command(served):
    served.told("204", "K", "PARK")
    served.until(lambda truth: not truth.moving and abs(truth.cable_deg) < 0.1 and abs(truth.el_deg) < 0.1)
