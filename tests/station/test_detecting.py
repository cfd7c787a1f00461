"""Which firmware answers on a port, from what a bare Enter brings."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.console.probe import BaudFinding, Saw
from birdcage.link.link import Link
from birdcage.sim.port import SimPort, open_device
from birdcage.station.detecting import detect_firmware, firmware_of


class Desk:
    """A port with a simulated dish behind it, which hears only its own rate."""

    def __init__(self, address: str) -> None:
        self.clock = VirtualClock()
        self.device = open_device(address, clock=self.clock)
        self.opened: list[int] = []

    def open(self, port: str, baud: int) -> Link:
        self.opened.append(baud)
        return Link(SimPort(self.device, port, baud=baud), self.clock)

    def lines(self) -> list[str]:
        return [line for _, line in self.device.shell.received]


@pytest.mark.parametrize("firmware", ["g2", "hal205"])
def test_the_dish_that_is_there_is_found_by_one_enter_a_rate(firmware) -> None:
    desk = Desk(f"{firmware}?seed=1")
    before, told = desk.clock.monotonic(), []
    found = detect_firmware("/dev/ttyUSB0", desk.clock, open_port=desk.open, tell=told.append)
    assert found.firmware == firmware
    assert desk.opened == {"g2": [115200], "hal205": [115200, 57600]}[firmware]
    assert [line for line in desk.lines() if line] == [], "nothing but Enter"
    assert not desk.device.truth().moving
    assert desk.clock.monotonic() - before < 2.0
    assert told[0] == "Listening for the dish on /dev/ttyUSB0 at 115200 baud …"


@pytest.mark.parametrize("up_s", [3.0, 4.5, 6.0, 9.0, 14.0, 21.0])
def test_a_travler_that_starts_is_found_by_its_log(up_s) -> None:
    desk = Desk("hal205?seed=1&boot=1&boot_home_s=60")
    desk.clock.advance(up_s)
    found = detect_firmware("/dev/ttyUSB0", desk.clock, open_port=desk.open)
    assert found.firmware == "hal205"


def test_a_mute_dish_is_unknown() -> None:
    desk = Desk("g2?seed=1")
    desk.device.wire.to_host.silent = True
    assert detect_firmware("/dev/ttyUSB0", desk.clock, open_port=desk.open).firmware is None


def test_a_port_that_does_not_open_is_unknown_and_no_error() -> None:
    def refuse(_port: str, _baud: int) -> Link:
        raise LinkError("/dev/ttyUSB0 is busy.", reason="busy")

    found = detect_firmware("/dev/ttyUSB0", VirtualClock(), open_port=refuse)
    assert (found.firmware, found.sentence) == (None, "/dev/ttyUSB0 is busy.")


def test_a_rate_that_was_named_is_the_only_one_tried() -> None:
    desk = Desk("hal205?seed=1")
    assert detect_firmware("/dev/ttyUSB0", desk.clock, baud=57600, open_port=desk.open).firmware == "hal205"
    assert desk.opened == [57600]


@pytest.mark.parametrize(("baud", "saw", "sample", "firmware"), [
    (115200, Saw.PROMPT, "TRK>", "g2"), (115200, Saw.PROMPT, "MOT>", "g2"), (57600, Saw.PROMPT, "TRK>", "hal205"),
    (57600, Saw.PROMPT, ">", "hal205"), (115200, Saw.PROMPT, "odd>", "hal205"), (57600, Saw.TEXT, "NoGPS", "hal205"),
    (115200, Saw.TEXT, "Boot Complete", "g2"), (115200, Saw.TEXT, "Welcome", None),
    (57600, Saw.GARBAGE, "..x", None), (57600, Saw.ECHO, "", None),
    (115200, Saw.SILENCE, "", None),
])  # fmt: skip
def test_what_is_seen_speaks_for_a_firmware_or_for_none(baud, saw, sample, firmware) -> None:
    assert firmware_of(BaudFinding(baud, saw, sample, len(sample), 0.7)) == firmware


def test_on_a_server_whose_rate_is_its_own_the_prompt_alone_counts() -> None:
    finding = BaudFinding(115200, Saw.PROMPT, "TRK>", 6, 0.7)
    assert firmware_of(finding, rate_counts=False) == "g2"
