"""Whole machines at a port are asked last, by a question that moves nothing on any machine."""

from __future__ import annotations

import itertools

import pytest
from birdcage.detection.detecting import heard_firmware
from birdcage.detection.machine_probe import probes, questions
from birdcage.detection.probe import USUAL_BAUDS, BaudFinding, Saw
from birdcage.rotator import machines

from .test_detecting import Desk, Foreign
from .test_probe import misread

VE = b"\nVE\n"


@pytest.mark.parametrize("kind", ["rp2040", "stock"])
@pytest.mark.parametrize("port", ["/dev/ttyACM0", "socket://here:1"])
def test_a_rotator_is_named_by_its_version_and_stays_where_it_is(kind, port):
    desk, told = Desk(f"easycomm?seed=1&az=90&el=30&kind={kind}"), []
    before = desk.device.truth()
    found = desk.detect(port, tell=told.append)
    assert (found.firmware, found.candidates) == ("easycomm", ("easycomm",))
    assert f"{port} is a SatNOGS rotator (easycomm): `VE` is answered `VESatNOGS-" in found.sentence
    assert set(desk.lines()) == {"VE"}, "nothing else that it could read"
    assert desk.device.truth() == before
    assert any("Asking for a SatNOGS rotator" in each for each in told)


def test_without_a_log_it_is_asked_as_soon_as_the_rates_are_silent():
    desk = Desk("easycomm?seed=1")
    began = desk.clock.monotonic()
    assert desk.detect(log_s=0.0).firmware == "easycomm"
    assert desk.clock.monotonic() - began < 3.0


def test_what_it_prints_as_it_starts_names_it_with_nothing_asked():
    desk = Desk("easycomm?seed=1&boot=1")
    found = desk.detect()
    assert found.firmware == "easycomm"
    assert "VE" not in desk.lines()
    seen = BaudFinding(115200, Saw.TEXT, "", 60, 0.7, text="AZ_T=0 EL_T=0  AZ_END=0 EL_END=0  AZ_ALR=0 EL_ALR=0\n")
    assert heard_firmware(seen, "/dev/ttyACM0") == "easycomm"


@pytest.mark.parametrize("said", [b"Welcome\r\n", b"login: ", b"\x80\xfe\x00\xfc\x1c"])
def test_what_says_anything_is_not_asked(said):
    foreign = Foreign(said, {})
    desk = Desk("easycomm?seed=1")
    desk.open = lambda _port, _baud: foreign
    desk.detect()
    assert VE not in foreign.sent


def test_another_answer_to_the_question_is_nobodys():
    foreign = Foreign(b"", {VE: b"VE2.1 antenna rotor\r\n"})
    desk = Desk("easycomm?seed=1")
    desk.open = lambda _port, _baud: foreign
    found = desk.detect()
    assert found.firmware is None
    assert "VE2.1 antenna rotor" in found.sentence


@pytest.mark.parametrize("address", ["g2?seed=1", "hal205?seed=1", "carryout?seed=1"])
def test_a_dish_that_is_asked_all_the_same_neither_moves_nor_leaves_its_menu(address):
    desk = Desk(address)
    before = desk.device.truth()
    port = desk.open("x", desk.device.firmware.baud)
    port.write(VE)
    port.write(b"\r")
    desk.clock.advance(5.0)
    assert desk.device.truth() == before
    assert before.shell_alive


def test_every_machine_that_offers_a_question_ends_its_lines_and_has_a_rate():
    assert "easycomm" in probes()
    for (ask, baud), names in questions().items():
        assert ask[:1] in b"\r\n"
        assert ask[-1:] in b"\r\n"
        assert all(machines.facts_of(name).baud == baud for name in names)


@pytest.mark.parametrize(("sent_at", "read_at"), list(itertools.permutations(USUAL_BAUDS, 2)))
def test_at_no_wrong_rate_is_it_taken_for_a_bare_q(sent_at, read_at):
    for phase in (-0.3, -0.15, 0.0, 0.15, 0.3):
        taken = bytes(read & 0x7F for byte in VE for read in misread(byte, sent_at, read_at, phase))
        lines = (b"\r" + taken + b"\r").replace(b"\n", b"\r").lower().split(b"\r")
        assert b"q" not in [line.strip() for line in lines], (phase, taken)
        if sent_at == machines.facts_of("easycomm").baud and read_at > sent_at:
            assert b"q" not in taken, "at the rate at which it is sent there is none at all"
