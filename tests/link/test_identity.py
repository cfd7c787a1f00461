from __future__ import annotations

import os

import pytest
from birdcage.link.identity import dish_folder, dish_identity
from birdcage.link.ports import PortInfo

FTDI = PortInfo("/dev/ttyUSB0", "/dev/serial/by-id/usb-FTDI", "FT232R", "0403:6001", "A50285BI", "1-1.4")


def none():
    return []


def test_an_adapter_with_a_serial_number_keeps_its_dish_under_another_name():
    again = PortInfo("/dev/ttyUSB7", None, "FT232R", "0403:6001", "A50285BI", "2-1")
    assert dish_identity("/dev/ttyUSB0", lambda: [FTDI]) == "usb:0403:6001:A50285BI"
    assert dish_identity("/dev/ttyUSB7", lambda: [again]) == "usb:0403:6001:A50285BI"
    assert dish_identity(FTDI.by_id, lambda: [FTDI]) == "usb:0403:6001:A50285BI"


def test_two_interfaces_of_one_adapter_are_two_dishes():
    ports = [PortInfo(f"/dev/ttyUSB{n}", None, "FT2232", "0403:6010", "FT1", f"1-1.4:1.{n}") for n in (0, 1)]
    assert [dish_identity(port.device, lambda: ports) for port in ports] == [
        "usb:0403:6010:FT1.0", "usb:0403:6010:FT1.1",
    ]  # fmt: skip


def test_without_a_serial_number_the_resolved_path_counts(tmp_path):
    device = tmp_path / "ttyUSB0"
    device.touch()
    (tmp_path / "dish").symlink_to(device)
    ch340 = PortInfo(str(device), None, "USB Serial", "1a86:7523", None, "1-1.2")
    for port in (device, tmp_path / "dish"):
        assert dish_identity(str(port), lambda: [ch340]) == f"path:{device}"
        assert dish_identity(str(port), none) == f"path:{device}"
    assert dish_identity("COM4", lambda: [PortInfo("COM4")]) == "path:COM4"


def test_a_device_that_is_not_there_has_none():
    assert dish_identity("/dev/ttyUSB9", lambda: [FTDI]) is None
    assert dish_identity("", lambda: [FTDI]) is None


def test_a_server_is_its_address_and_a_simulator_of_our_own_has_none():
    assert dish_identity("socket://Rack:2217", none) == dish_identity("socket://rack:2217", none)
    assert dish_identity("rfc2217://rack:2217", none) == "url:rfc2217://rack:2217"
    assert dish_identity("sim:g2", none) is None
    assert dish_identity("loop://", none) is None


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="Windows has no pseudo terminals")
def test_a_pseudo_terminal_that_gets_an_old_name_is_another_dish():
    def made():
        descriptors = os.openpty()
        name = os.ttyname(descriptors[1])
        os.write(descriptors[1], b"hello")
        os.read(descriptors[0], 5)
        told = name, dish_identity(name, none), dish_identity(name, none)
        for descriptor in descriptors:
            os.close(descriptor)
        return told

    first = made()
    assert first[1] == first[2]
    assert first[1].startswith(f"pty:{first[0]}@")
    made_ns = later_ns = int(first[1].partition("@")[2])
    while later_ns < made_ns + 50_000_000:  # the system's clock of files goes in steps of some milliseconds
        name, identity, _ = made()
        later_ns = int(identity.partition("@")[2])
    assert name != first[0] or identity != first[1]


def test_each_dish_has_a_folder_of_its_own(tmp_path):
    names = {dish_folder(tmp_path, identity) for identity in ("path:/dev/ttyS0", "path:/dev/ttyS1", "path:/dev-ttyS0")}
    assert len(names) == 3
    assert all(folder.parent == tmp_path / "dishes" for folder in names)


def test_a_pseudo_terminal_that_goes_while_it_is_looked_at_is_not_there():
    ours, theirs = os.openpty()
    name = os.ttyname(theirs)
    assert dish_identity(name, none).startswith(f"pty:{name}@")

    def go():
        os.close(theirs)
        os.close(ours)
        return []

    assert dish_identity(name, go) is None
