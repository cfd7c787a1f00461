from __future__ import annotations

import types

import pytest
from birdcage.link.ports import PortInfo, find_again, identify, list_ports

FTDI = PortInfo("/dev/ttyUSB0", "/dev/serial/by-id/usb-FTDI", "FT232R", "0403:6001", "A50285BI", "1-1.4")
CH340 = PortInfo("/dev/ttyUSB1", None, "USB Serial", "1a86:7523", None, "1-1.2")
BOARD = PortInfo("/dev/ttyS0")


def moved(port, device, topology):
    return PortInfo(device, port.by_id, port.description, port.vid_pid, port.serial_number, topology)


def test_identity():
    assert FTDI.identity == "0403:6001:A50285BI"
    assert CH340.identity == "1a86:7523@1-1.2"
    assert BOARD.identity is None


@pytest.mark.parametrize(
    ("identity", "ports", "device"),
    [
        (FTDI.identity, [BOARD, moved(FTDI, "/dev/ttyUSB7", "2-1")], "/dev/ttyUSB7"),
        (CH340.identity, [moved(CH340, "/dev/ttyUSB7", "1-1.2")], "/dev/ttyUSB7"),
        (CH340.identity, [moved(CH340, "/dev/ttyUSB7", "2-1"), FTDI], "/dev/ttyUSB7"),
        (CH340.identity, [moved(CH340, "/dev/ttyUSB7", "2-1"), moved(CH340, "/dev/ttyUSB8", "2-2")], None),
        (CH340.identity, [moved(CH340, "/dev/ttyUSB7", "2-1"), CH340], "/dev/ttyUSB1"),
        (FTDI.identity, [CH340, BOARD], None),
        (FTDI.identity, [], None),
    ],
)
def test_find_again(identity, ports, device):
    assert find_again(identity, lambda: ports) == device


def test_identify_follows_links(tmp_path):
    device = tmp_path / "ttyUSB0"
    device.touch()
    (tmp_path / "dish").symlink_to(device)
    port = PortInfo(str(device), None, None, "0403:6001", "A5", "1-1")
    assert identify(str(tmp_path / "dish"), lambda: [port]) == "0403:6001:A5"
    assert identify("/dev/pts/3", lambda: [port]) is None


def test_the_list_comes_from_the_system(monkeypatch, tmp_path):
    device = tmp_path / "ttyUSB0"
    device.touch()
    by_id = tmp_path / "by-id"
    by_id.mkdir()
    (by_id / "usb-FTDI").symlink_to(device)
    usb = types.SimpleNamespace(
        device=str(device), description="FT232R", vid=0x403, pid=0x6001, serial_number="A5", location="1-1.4"
    )
    board = types.SimpleNamespace(
        device="/dev/ttyS0", description="n/a", vid=None, pid=None, serial_number=None, location=None
    )
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: [board, usb])
    monkeypatch.setattr("birdcage.link.ports.BY_ID", by_id)
    assert list_ports() == [
        PortInfo(str(device), str(by_id / "usb-FTDI"), "FT232R", "0403:6001", "A5", "1-1.4"),
        PortInfo("/dev/ttyS0"),
    ]
