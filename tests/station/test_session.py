"""The thread around the station, with a real clock: it begins, ends at once, and stops the dish first."""

from __future__ import annotations

import threading

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import Settings, load
from birdcage.base.journal import read_journal
from birdcage.base.paths import Paths
from birdcage.sim.port import open_device
from birdcage.station.build import open_session
from birdcage.station.events import LinkChanged
from birdcage.station.requests import Goto
from birdcage.station.state import LinkPhase


class Live:
    def __init__(self, tmp_path, address, settings=None):
        self.clock = RealClock()
        self.device = open_device(address.removeprefix("sim:"), clock=self.clock)
        self.paths = Paths.in_folder(tmp_path)
        self.session = open_session(
            port=address, firmware="g2", baud=None, settings=settings or Settings(), paths=self.paths, clock=self.clock
        )
        self.station = self.session.station
        self.link = threading.Event()
        self.station.subscribe(self._hear)

    def _hear(self, event):
        if isinstance(event, LinkChanged) and event.link.state in (LinkPhase.UP, LinkPhase.SILENT):
            self.link.set()

    def begin(self):
        self.session.start()
        assert self.link.wait(10)
        return self

    def wait(self, seconds):
        self.clock.wait(None, self.clock.monotonic() + seconds)

    def wait_until(self, condition, seconds=60.0):
        end = self.clock.monotonic() + seconds
        while not condition():
            assert self.clock.monotonic() < end
            self.wait(0.02)

    def slewing(self):
        self.station.submit(Goto(300, 45, "you"))
        self.wait_until(lambda: self.device.truth().moving)
        return self

    def stopped_short(self):
        self.wait_until(lambda: not self.device.truth().moving)
        return abs((self.device.truth().az_deg - 300 + 180) % 360 - 180) > 5


def threads():
    return {thread.name for thread in threading.enumerate()}


def test_quitting_in_mid_slew_stops_the_dish_first(tmp_path):
    live = Live(tmp_path, "sim:g2?id=quit&az_speed=10").begin().slewing()
    live.wait(0.3)
    assert live.session.close().startswith("STOP was sent")
    assert live.stopped_short()
    assert "station" not in threads()


def test_quitting_with_a_silent_port_does_not_wait_for_it(tmp_path):
    live = Live(tmp_path, "sim:g2?id=silent")
    live.device.wire.to_host.silent = True
    live.session.start()
    live.wait(0.2)
    assert live.session.close() == "The dish's position is not known."
    assert "station" not in threads()


def test_a_crash_of_the_station_stops_the_dish_and_is_kept_for_the_face(tmp_path):
    live = Live(tmp_path, "sim:g2?id=crash&az_speed=10").begin().slewing()

    def fail(_event):
        raise RuntimeError("a listener fails")

    live.station.subscribe(fail)
    assert live.stopped_short()
    assert isinstance(live.session.crash, RuntimeError)
    live.session.close()


def test_bytes_and_faults_are_on_disk_after_closing(tmp_path):
    live = Live(tmp_path, "sim:g2?id=disk").begin()
    live.device.reboot()
    live.wait_until(lambda: live.station.state.fault is not None)
    live.session.close()
    [transcript] = list(live.paths.transcripts.iterdir())
    lines = transcript.read_text().splitlines()
    assert "DEMO" in lines[0]
    assert any("> mot" in line for line in lines)
    [entry] = read_journal(live.paths.journal)
    assert entry.reason == "reboot"


def test_settings_that_limit_motion_reach_the_gate(tmp_path):
    file = tmp_path / "birdcage.toml"
    file.write_text("[motion]\nmin_elevation_deg = 30\n[alignment]\naz_offset_deg = 10\n")
    live = Live(tmp_path, "sim:g2?id=limits", load(file, {})).begin()
    future = live.station.submit(Goto(180, 25, "you"))
    with pytest.raises(ValueError, match=r"floor of 30\.00"):
        future.result(5)
    assert live.station.state.position.az_deg == pytest.approx(10, abs=0.1)
    live.session.close()


def test_a_damaged_file_refuses_motion_and_shows_the_rest(tmp_path):
    file = tmp_path / "birdcage.toml"
    file.write_text("[motion]\nmin_elevation_deg = 'high'\n")
    live = Live(tmp_path, "sim:g2?id=damaged", load(file, {})).begin()
    assert live.station.state.position is not None
    with pytest.raises(Exception, match="min_elevation_deg"):
        live.station.submit(Goto(180, 45, "you")).result(5)
    live.session.close()
