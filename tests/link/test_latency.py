"""FTDI's latency timer: asked down where there is one, told in the transcript, and never a reason to fail."""

from __future__ import annotations

import os
import tty

import pytest
from birdcage.base.clock import RealClock
from birdcage.link.latency import latency_ms, lower_latency
from birdcage.link.opening import open_link
from birdcage.link.transcript import Transcript


class Adapter:
    """As much of pyserial's port as is asked, and the sysfs file that follows it."""

    def __init__(self, file, refusal=None):
        self.file, self.refusal, self.asked = file, refusal, []

    def set_low_latency_mode(self, on):
        self.asked.append(on)
        if self.refusal is not None:
            raise self.refusal
        self.file.write_text("1\n")


@pytest.fixture
def timer(tmp_path):
    file = tmp_path / "class" / "tty" / "ttyUSB0" / "device" / "latency_timer"
    file.parent.mkdir(parents=True)
    file.write_text("16\n")
    return file


def test_it_is_lowered_and_told(tmp_path, timer):
    adapter = Adapter(timer)
    assert lower_latency(adapter, "/dev/ttyUSB0", tmp_path) == "FTDI latency timer 16 ms before, 1 ms now"
    assert adapter.asked == [True]
    assert latency_ms("/dev/ttyUSB0", tmp_path) == 1


@pytest.mark.parametrize(
    "refusal", [ValueError("Failed to update ASYNC_LOW_LATENCY flag: Permission denied"), NotImplementedError("no")]
)
def test_a_refusal_is_told_and_harmless(tmp_path, timer, refusal):
    remark = lower_latency(Adapter(timer, refusal), "/dev/ttyUSB0", tmp_path)
    assert remark.startswith("FTDI latency timer 16 ms, low latency refused: ")
    assert str(refusal) in remark


def test_a_port_without_a_timer_is_left_alone(tmp_path, timer):
    adapter = Adapter(timer)
    assert lower_latency(adapter, "/dev/ttyACM0", tmp_path) is None
    assert adapter.asked == []
    assert latency_ms("/dev/ttyACM0", tmp_path) is None


def test_a_timer_that_cannot_be_read_is_none(tmp_path, timer):
    timer.write_text("soon\n")
    assert latency_ms("/dev/ttyUSB0", tmp_path) is None


def test_a_link_to_the_device_leads_to_its_timer(tmp_path, timer):
    (tmp_path / "ttyUSB0").touch()
    link = tmp_path / "usb-FTDI_A50285BI-if00-port0"
    link.symlink_to(tmp_path / "ttyUSB0")
    assert latency_ms(str(link), tmp_path) == 16


def test_the_remark_stands_in_the_transcript(monkeypatch):
    master, slave = os.openpty()
    tty.setraw(slave)
    heard = []
    transcript = Transcript(None, version="test")
    transcript.listen(heard.append)
    monkeypatch.setattr("birdcage.link.latency.lower_latency", lambda port, device: "FTDI latency timer: a remark")
    link = open_link(os.ttyname(slave), baud=9600, clock=RealClock(), transcript=transcript)
    link.close()
    os.close(master)
    os.close(slave)
    assert "9600 baud 8N1; exclusive; FTDI latency timer: a remark" in [
        entry.data.decode() for entry in heard if entry.direction == "#"
    ]
