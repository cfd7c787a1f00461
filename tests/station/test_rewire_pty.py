"""The same over a real pseudo terminal with real pyserial: the simulated dish on a pty heeds the rate."""

from __future__ import annotations

import threading
import time

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import LinkSettings, Settings
from birdcage.base.paths import Paths
from birdcage.base.wake import Wake
from birdcage.detection.probe import Saw
from birdcage.setup.causes import Case, find_causes
from birdcage.sim.port import open_device
from birdcage.sim.pty import PtyChannel
from birdcage.sim.server import Server
from birdcage.station.build import open_session
from birdcage.station.known import look_at_system
from birdcage.station.requests import Connect, ProbePort
from birdcage.station.state import LinkPhase


@pytest.fixture
def pty_path():
    device = open_device("g2?seed=1", clock=RealClock())
    server, stop = Server(device, PtyChannel(None), "sim:g2"), Wake()
    thread = threading.Thread(target=server.serve, args=(stop,), daemon=True)
    thread.start()
    yield server.channel.path
    stop.set()
    thread.join(5)
    server.close()
    stop.close()


def wait_for(session, state):
    end = time.monotonic() + 10
    while session.station.state.link.state is not state:
        assert time.monotonic() < end, session.station.state.link
        threading.Event().wait(0.02)


def test_from_a_wrong_rate_to_a_dish_that_answers(pty_path, tmp_path):
    settings = Settings(link=LinkSettings(delay_s=0.5))
    session = open_session(
        port=pty_path, firmware="g2", baud=9600, settings=settings, paths=Paths.in_folder(tmp_path),
        clock=RealClock(), survey=False, ports=list,
    )  # fmt: skip
    session.start()
    try:
        wait_for(session, LinkPhase.SILENT)
        findings = session.station.submit(ProbePort()).result(20)
        assert [(each.baud, each.saw) for each in findings] == [(9600, Saw.SILENCE), (115200, Saw.PROMPT)]
        silent = session.station.state.link
        case = Case(pty_path, silent, findings, look_at_system(pty_path), firmware_baud=115200)
        remedy = find_causes(case)[0]
        assert remedy.use_baud == 115200
        session.station.submit(Connect(pty_path, remedy.use_baud)).result(20)
        wait_for(session, LinkPhase.UP)
    finally:
        session.close()
    written = "".join(path.read_text() for path in Paths.in_folder(tmp_path).transcripts.glob("*.txt"))
    assert "# 9600 baud 8N1" in written
    assert "# 115200 baud 8N1" in written
