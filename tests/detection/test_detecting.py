"""Which firmware answers on a port: what speaks for one, and what is never taken for a dish."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.console.dialect import ConsoleDialect
from birdcage.detection.detecting import detect_firmware, heard_firmware
from birdcage.detection.probe import BaudFinding, Saw
from birdcage.link.link import Link
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.registry import FIRMWARE_REGISTRY
from birdcage.sim.port import SimPort, open_device


class Desk:
    """A port with a simulated dish behind it, which hears only its own rate."""

    def __init__(self, address: str) -> None:
        self.clock = VirtualClock()
        self.device = open_device(address, clock=self.clock)
        self.opened: list[int] = []

    def open(self, port: str, baud: int) -> Link:
        self.opened.append(baud)
        return Link(SimPort(self.device, port, baud=baud), self.clock)

    def detect(self, port: str = "/dev/ttyUSB0", **options):
        return detect_firmware(port, self.clock, open_port=self.open, **options)

    def lines(self) -> list[str]:
        with self.device.lock:
            self.device.machine.run()
            return [line for _, line in self.device.shell.received]


class Foreign:
    """Something on the port that is no dish of ours; `sent` is all that it was sent."""

    name, demo = "foreign", False

    def __init__(self, unasked: bytes, answers: dict[bytes, bytes]) -> None:
        self._out, self._answers, self.sent = unasked, answers, []

    def write(self, data: bytes) -> None:
        self.sent.append(data)
        self._out += self._answers.get(data, b"")

    def read(self) -> bytes:
        out, self._out = self._out, b""
        return out

    def fileno(self) -> None:
        return None

    def pending(self) -> bool:
        return bool(self._out)

    def next_event(self) -> None:
        return None

    def close(self) -> None:
        pass


@pytest.mark.parametrize(("address", "clue"), [
    ("g2?seed=1", "prompt `TRK>` at 115200 baud"), ("hal205?seed=1", "`?` lists `motor`, `ngsearch`"),
    ("hal205?seed=1&prompts=alike", "`?` lists `motor`, `ngsearch`"),
    ("hal000?seed=1", "`?` lists `mot`, `nvs`"), ("hal000?seed=1&prompts=alike", "`?` lists `mot`, `nvs`"),
])  # fmt: skip
def test_the_dish_that_is_there_is_found_by_enter_and_a_question_mark(address, clue) -> None:
    desk, told = Desk(address), []
    before = desk.clock.monotonic()
    found = desk.detect(tell=told.append)
    firmware = address.partition("?")[0]
    assert (found.firmware, found.candidates) == (firmware, (firmware,))
    assert found.baud == {"g2": 115200, "hal205": 57600, "hal000": 57600}[firmware]
    assert clue in found.sentence
    assert set(desk.lines()) <= {"", "?"}, "nothing but Enter and `?`"
    assert not desk.device.truth().moving
    assert desk.clock.monotonic() - before < (3.0 if firmware == "hal000" else 2.0), "another rate is tried, too"
    assert told[0] == "Listening for the dish on /dev/ttyUSB0 at 115200 baud …"


@pytest.mark.parametrize(("firmware", "menu"), [
    ("g2", "mot"), ("g2", "dvb"), ("g2", "os"), ("g2", "step"), ("g2", "adc"),
])  # fmt: skip
@pytest.mark.parametrize("options", ["", "&echo=0"])
def test_a_dish_that_was_left_in_a_submenu_is_found_and_stays_there(firmware, menu, options) -> None:
    desk = Desk(f"{firmware}?seed=1{options}")
    desk.device.shell.menu = menu
    assert desk.detect().firmware == firmware
    assert set(desk.lines()) <= {"", "?"}
    assert desk.device.shell.menu == menu


KIN = ["g2", "g2plus", "pathway-x1", "pathway-x2"]


@pytest.mark.parametrize(("firmware", "menu", "may_be"), [
    ("g2", "nvs", ["g2", "g2plus"]), ("g2plus", "nvs", ["g2", "g2plus"]), ("g2plus", "root", KIN),
    ("g2plus", "mot", KIN), ("pathway-x1", "root", KIN), ("pathway-x2", "root", KIN), ("pathway-x2", "mot", KIN),
])  # fmt: skip
def test_what_a_g2_and_its_kin_all_show_names_all_of_them(firmware, menu, may_be) -> None:
    desk = Desk(f"{firmware}?seed=1")
    desk.device.shell.menu = menu
    found = desk.detect()
    assert (found.firmware, sorted(found.candidates), found.baud) == (None, may_be, 115200)
    assert f"at 115200 baud ({', '.join(may_be)})" in found.sentence
    assert set(desk.lines()) <= {"", "?"}


@pytest.mark.parametrize(("firmware", "menu"), [("hal205", "motor"), ("hal000", "mot")])
def test_trav_lers_left_among_their_motors_cannot_be_told_apart_and_both_are_named(firmware, menu) -> None:
    desk = Desk(f"{firmware}?seed=1")
    desk.device.shell.menu = menu
    found = desk.detect()
    assert (found.firmware, set(found.candidates)) == (None, {"hal000", "hal205"})
    assert "may be any of hal000, hal205" in found.sentence
    assert set(desk.lines()) <= {"", "?"}
    assert desk.device.shell.menu == menu


@pytest.mark.parametrize("options", ["", "&prompts=alike", "&gap_s=0", "&odu_gap_s=0.9&motor_gap_s=0.15"])
@pytest.mark.parametrize("first", [None, 57600])
def test_a_pro_is_found_by_its_tunnel_at_any_rate_though_it_loses_what_comes_too_soon(options, first) -> None:
    desk = Desk(f"pro?seed=1{options}")
    found = desk.detect(first=first)
    assert found.firmware == "pro"
    assert "`?` lists `odu`" in found.sentence
    assert set(desk.lines()) <= {"", "?"}


@pytest.mark.parametrize("first", [None, 57600])
@pytest.mark.parametrize(("firmware", "menu", "may_be"), [
    ("pro", "odu", {"pro"}), ("pro", "mot", {"pro"}), ("hal000", "root", {"hal000"}),
    ("hal000", "mot", {"hal000", "hal205"}), ("hal205", "motor", {"hal000", "hal205"}),
])  # fmt: skip
def test_a_rate_of_its_own_tells_a_trav_ler_from_a_pro_in_its_tunnel(firmware, menu, may_be, first) -> None:
    desk = Desk(f"{firmware}?seed=1")
    desk.device.shell.menu = menu
    found = desk.detect(first=first)
    assert set(found.candidates) == may_be
    assert set(desk.lines()) <= {"", "?"}
    assert desk.device.shell.menu == menu


def test_without_a_rate_an_older_trav_ler_and_a_pro_are_both_named() -> None:
    odd = Foreign(b"", {b"\r": b"\r\n>", b"?\r": b"?\r\nmot\r\nnvs\r\nos\r\nq\r\n>"})
    found = detect_firmware("socket://here:1", VirtualClock(), open_port=lambda _port, _baud: odd)
    assert (found.firmware, set(found.candidates)) == (None, {"hal000", "pro"})


def test_an_older_trav_ler_that_starts_may_be_either() -> None:
    desk = Desk("hal000?seed=1&boot=1&boot_home_s=8&search_finds=0")
    seen = {desk.detect().candidates for _ in range(3)}
    assert ("hal000", "hal205") in seen or ("hal000",) in seen
    assert all("g2" not in each for each in seen)


def test_a_g2_that_moves_goes_on() -> None:
    desk = Desk("g2?seed=1&az_speed=5")
    port = desk.open("x", 115200)
    port.write(b"mot\ra 0 90\r")
    desk.clock.advance(1.0)
    assert desk.detect().firmware == "g2"
    assert desk.device.truth().moving
    desk.clock.advance(60.0)
    assert desk.device.truth().az_deg == pytest.approx(90.0, abs=0.1)


@pytest.mark.parametrize("address", ["g2?seed=1&boot=1&nvs20=0", "hal205?seed=1&boot=1&boot_home_s=8"])
def test_a_dish_that_starts_is_found_by_what_only_it_prints(address) -> None:
    desk = Desk(address)
    for _ in range(4):
        found = desk.detect()
        if found.firmware is not None:
            break
    assert found.firmware == address.partition("?")[0]


def test_a_log_without_a_known_word_is_nobodys() -> None:
    desk = Desk("hal205?seed=1&boot=1&boot_home_s=60")
    desk.clock.advance(9.0)
    found = desk.detect()
    assert (found.firmware, found.talks, found.is_told) == (None, True, False)
    assert "a dish that is starting" in found.sentence


@pytest.mark.parametrize("noise", [{"silent": True}, {"garble": True}])
def test_a_mute_dish_is_unknown(noise) -> None:
    desk = Desk("g2?seed=1")
    if "silent" in noise:
        desk.device.wire.to_host.silent = True
    else:
        read = SimPort.read
        desk.open = lambda port, baud: _Garbled(SimPort(desk.device, port, baud=baud), read)
    found = desk.detect()
    assert (found.firmware, found.candidates) == (None, ())


class _Garbled:
    def __init__(self, port, read) -> None:
        self._port, self._read, self.name, self.demo = port, read, port.name, True

    def __getattr__(self, name):
        return getattr(self._port, name)

    def read(self) -> bytes:
        return bytes(byte | 0x80 for byte in self._read(self._port))


def test_a_port_that_does_not_open_is_unknown_and_no_error() -> None:
    def refuse(_port: str, _baud: int) -> Link:
        raise LinkError("/dev/ttyUSB0 is busy.", reason="busy")

    found = detect_firmware("/dev/ttyUSB0", VirtualClock(), open_port=refuse)
    assert (found.firmware, found.sentence, found.trouble.reason) == (None, "/dev/ttyUSB0 is busy.", "busy")


def test_a_rate_that_was_named_is_the_only_one_tried() -> None:
    desk = Desk("hal205?seed=1")
    assert desk.detect(baud=57600).firmware == "hal205"
    assert desk.opened == [57600]


def test_a_prompt_that_another_program_has_left_there_does_not_end_the_search() -> None:
    class Left(Desk):
        def open(self, port: str, baud: int) -> Link:
            link = super().open(port, baud)
            return link if baud == 115200 else Link(Foreign(b"Angle = 30.00\r\nMOT>", {}), self.clock)

    found = Left("g2?seed=1").detect(first=57600)
    assert (found.firmware, found.baud) == ("g2", 115200)


def test_the_rate_that_is_likely_is_the_first() -> None:
    desk = Desk("hal205?seed=1")
    assert desk.detect(first=57600).firmware == "hal205"
    assert desk.opened == [57600]


def finding(baud=115200, saw=Saw.PROMPT, prompt="", listed="", text="") -> BaudFinding:
    return BaudFinding(baud, saw, prompt or text, 10, 0.7, prompt, frozenset(listed.split()), text)


@pytest.mark.parametrize(("seen", "firmware"), [
    (finding(prompt="TRK>"), None), (finding(prompt="MOT>"), None), (finding(prompt="DVB>"), "g2"),
    (finding(57600, prompt="TRK>"), None),
    (finding(57600, prompt=">"), None), (finding(57600, prompt="odd>"), None), (finding(prompt="odd>"), None),
    (finding(prompt="TRK>", listed="motor ngsearch nvs q"), "hal205"),
    (finding(57600, prompt="TRK>", listed="motor ngsearch"), "hal205"),
    (finding(57600, prompt="odd>", listed="a3981 dvb mot os"), "g2"),
    (finding(57600, prompt="odd>", listed="mot nvs os stow q"), None),
    (finding(115200, prompt="odd>", listed="mot nvs os stow q"), "pro"),
    (finding(57600, prompt="odd>", listed="mot nvs os a3981 q"), None),
    (finding(57600, prompt="odd>", listed="odu q"), "pro"), (finding(57600, prompt="odd>", listed="a g q"), None),
    (finding(57600, prompt="odd>", listed="a g azscan q"), "g2"), (finding(prompt="GO>", listed="azangle help"), None),
    (finding(saw=Saw.TEXT, text="Ant ID - 12-IN G2"), "g2"), (finding(57600, Saw.TEXT, text="Loc: NoGPS"), None),
    (finding(57600, Saw.TEXT, text="No LNB Voltage"), "hal205"),
    (finding(saw=Saw.TEXT, text="Boot Complete"), None), (finding(57600, Saw.TEXT, text="Bootloader v2"), None),
    (finding(57600, Saw.TEXT, text="EL calibrating"), None), (finding(saw=Saw.TEXT, text="NoGPS"), None),
    (finding(57600, Saw.GARBAGE), None), (finding(57600, Saw.ECHO), None), (finding(saw=Saw.SILENCE), None),
])  # fmt: skip
def test_what_is_seen_speaks_for_a_firmware_or_for_none(seen, firmware) -> None:
    assert heard_firmware(seen, "/dev/ttyUSB0") == firmware


def test_on_a_server_whose_rate_is_its_own_the_prompt_alone_counts() -> None:
    assert heard_firmware(finding(57600, prompt="DVB>"), "socket://here:1") == "g2"


def test_two_that_cannot_be_told_apart_are_both_named() -> None:
    odd = Foreign(b"", {b"\r": b"\r\nMOT>", b"?\r": b"?\r\na\r\ng\r\nq\r\nMOT>"})
    found = detect_firmware("socket://here:1", VirtualClock(), open_port=lambda _port, _baud: odd)
    assert (found.firmware, sorted(found.candidates)) == (None, sorted([*KIN, "hal000", "hal205", "pro"]))
    assert "may be any of" in found.sentence
    assert "Say which with --firmware." in found.sentence


FOREIGN = {
    "modem": (b"", {b"\r": b"\r\nOK\r\n"}),
    "modem that echoes": (b"", {b"\r": b"\r"}),
    "gps": (b"$GPGGA,120000.00,5154.0000,N,00428.0000,E,1,08,1.0,10.0,M,,M,,*5F\r\n$GPRMC,NoFix\r\n", {}),
    "hamlib": (b"", {b"\r": b"RPRT -1\n"}),
    "login": (b"", {b"\r": b"\r\nraspberrypi login: "}),
    "shell": (b"", {b"\r": b"\r\npi@raspberrypi:~$ "}),
    "root shell": (b"", {b"\r": b"\r\n/ # "}),
    "password": (b"", {b"\r": b"Password: "}),
    "python": (b"", {b"\r": b"\r\n>>> "}),
    "tailgater": (b"", {b"\r": b"\r\nGO>", b"?\r": b"?\r\nazangle\r\nelangle\r\nrfwatch\r\nGO>"}),
    "kvh": (b"", {b"\r": b">", b"?\r": b"?\r\n?"}),
    "router": (b"", {b"\r": b"\r\nRouter>", b"?\r": b"?\r\nExec commands:\r\n  enable  Turn on\r\nRouter>"}),
}


@pytest.mark.parametrize("what", FOREIGN)
@pytest.mark.parametrize("port", ["/dev/ttyUSB0", "socket://here:1"])
def test_another_device_is_never_taken_for_a_dish_and_gets_a_question_mark_only_at_a_prompt(what, port) -> None:
    device = Foreign(*FOREIGN[what])
    found = detect_firmware(port, VirtualClock(), open_port=lambda _port, _baud: device)
    assert (found.firmware, found.candidates) == (None, ())
    assert set(device.sent) <= {b"\r", b"?\r"}
    if what not in ("tailgater", "kvh", "router"):
        assert set(device.sent) == {b"\r"}


class Guest:
    """Somebody else's dialect, found by entry point: what its class tells of its console is all that is asked."""

    name = "guest"
    model = replace(CARRYOUT_G2, name="Guest dish", firmware="guest", baud=19200)
    dialect = ConsoleDialect(prompts={"root": "GO>"}, root_marks=frozenset({"azangle", "elangle"}))
    motor_menu = "root"
    log_marks = ("GuestOS",)


class Mute:
    """One that tells nothing of its console."""


def test_somebody_elses_dialect_takes_part_by_its_marks_and_one_without_is_passed_over(monkeypatch) -> None:
    monkeypatch.setitem(FIRMWARE_REGISTRY, "guest", Guest)
    monkeypatch.setitem(FIRMWARE_REGISTRY, "mute", Mute)
    rates: list[int] = []
    device = Foreign(*FOREIGN["tailgater"])

    def opening(_port: str, baud: int) -> Link:
        rates.append(baud)
        return device if baud == 19200 else Foreign(b"", {})

    found = detect_firmware("/dev/ttyUSB0", VirtualClock(), open_port=opening)
    assert (found.firmware, found.baud, rates) == ("guest", 19200, [115200, 57600, 19200])
    assert found.sentence.startswith("/dev/ttyUSB0 is a Guest dish (guest): `?` lists `azangle`, `elangle`")
    assert heard_firmware(found.findings[-1], "/dev/ttyUSB0") == "guest"
