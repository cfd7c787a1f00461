"""The port after a replug: where it was, or wherever the adapter with the same USB identity is now."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.clock import VirtualClock
from birdcage.base.config import LinkSettings, Settings
from birdcage.base.paths import Paths
from birdcage.link.ports import PortInfo
from birdcage.station.build import open_session


@dataclass
class Shelf:
    ports: tuple[PortInfo, ...] = ()

    def __call__(self):
        return list(self.ports)


def adapter(device, serial):
    return PortInfo(device, None, "FTDI", "0403:6001", serial, "1-1")


def finder(tmp_path, shelf):
    session = open_session(
        port="/dev/ttyUSB0", firmware="g2", baud=None, settings=Settings(), paths=Paths.in_folder(tmp_path),
        clock=VirtualClock(), ports=shelf,
    )  # fmt: skip
    return session.station.settings.find_port


def test_the_same_adapter_on_another_path(tmp_path):
    shelf = Shelf((adapter("/dev/ttyUSB0", "A1"), adapter("/dev/ttyUSB1", "B2")))
    find = finder(tmp_path, shelf)
    assert find("/dev/ttyUSB0") == "/dev/ttyUSB0"
    shelf.ports = (adapter("/dev/ttyUSB1", "B2"),)
    assert find("/dev/ttyUSB0") is None
    shelf.ports = (adapter("/dev/ttyUSB1", "B2"), adapter("/dev/ttyUSB2", "A1"))
    assert find("/dev/ttyUSB0") == "/dev/ttyUSB2"


def test_another_adapter_that_took_the_path_is_left_alone(tmp_path):
    shelf = Shelf((adapter("/dev/ttyUSB0", "A1"),))
    find = finder(tmp_path, shelf)
    assert find("/dev/ttyUSB0") == "/dev/ttyUSB0"
    shelf.ports = (adapter("/dev/ttyUSB0", "B2"),)
    assert find("/dev/ttyUSB0") is None


def test_a_port_without_identity_is_tried_where_it_was(tmp_path):
    find = finder(tmp_path, Shelf())
    assert find("/dev/ttyUSB0") == "/dev/ttyUSB0"


def test_a_second_port_has_an_identity_of_its_own(tmp_path):
    shelf = Shelf((adapter("/dev/ttyUSB0", "A1"), adapter("/dev/ttyUSB1", "B2")))
    find = finder(tmp_path, shelf)
    assert find("/dev/ttyUSB0") == "/dev/ttyUSB0"
    assert find("/dev/ttyUSB1") == "/dev/ttyUSB1"
    shelf.ports = (adapter("/dev/ttyUSB0", "A1"), adapter("/dev/ttyUSB4", "B2"))
    assert find("/dev/ttyUSB1") == "/dev/ttyUSB4"
    assert find("/dev/ttyUSB0") == "/dev/ttyUSB0"


def test_the_configured_identity_is_that_of_the_configured_port_alone(tmp_path):
    shelf = Shelf((adapter("/dev/ttyUSB0", "A1"), adapter("/dev/ttyUSB1", "B2")))
    settings = Settings(link=LinkSettings(usb_identity="0403:6001:B2"))
    session = open_session(
        port="/dev/ttyUSB0", firmware="g2", baud=None, settings=settings, paths=Paths.in_folder(tmp_path),
        clock=VirtualClock(), ports=shelf,
    )  # fmt: skip
    find = session.station.settings.find_port
    assert find("/dev/ttyUSB0") == "/dev/ttyUSB1"
    shelf.ports = (*shelf.ports, adapter("/dev/ttyUSB2", "C3"))
    assert find("/dev/ttyUSB2") == "/dev/ttyUSB2"
