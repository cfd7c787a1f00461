"""A port that names its machine is asked in that machine's language, and nothing else is sent there."""

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.detection.detecting import detect_firmware
from rotctl_twin import RotctlTwin

PORT = "rotctl://shed"


@pytest.fixture
def clock():
    return VirtualClock()


def test_it_is_named_with_what_it_tells(clock):
    twin = RotctlTwin(clock, "info=SPID%20ROT2PROG&model=901&rot_type=AzEl")
    found = detect_firmware(PORT, clock, open_port=twin.dial)
    assert (found.firmware, found.candidates, found.baud, found.is_told) == ("rotctl", ("rotctl",), None, True)
    assert found.sentence == (
        f"{PORT} is a rotctld rotator (rotctl): it answers in the language that its address names. Name from "
        "the server: SPID ROT2PROG, model 901, rot_type AzEl, south_zero 0."
    )
    assert twin.said() == ["\\dump_state", "\\dump_state", "_"]
    assert twin.dialled == ["socket://shed:4533"]


def test_one_that_tells_nothing_of_itself_answers_by_its_position(clock):
    twin = RotctlTwin(clock, "dump_state=silent&knows=pP")
    found = detect_firmware(PORT, clock, open_port=twin.dial)
    assert found.firmware == "rotctl"
    assert found.sentence.endswith("it answers in the language that its address names.")
    assert twin.said() == ["p"]


def test_where_none_answers_no_firmware_is_told(clock):
    twin = RotctlTwin(clock)
    twin.mute()
    found = detect_firmware(PORT, clock, open_port=twin.dial)
    assert (found.firmware, found.candidates, found.trouble) == (None, (), None)
    assert found.sentence.startswith(
        f"{PORT} names a rotctld rotator (rotctl), and none answers. The machine is silent"
    )


def test_a_server_that_has_lost_its_rotator_says_so(clock):
    twin = RotctlTwin(clock, "lost=1&dump_state=error")
    found = detect_firmware(PORT, clock, open_port=twin.dial)
    assert found.firmware is None
    assert "RPRT -6 (input or output error: the server has lost its rotator)" in found.sentence


def test_without_a_connection_the_port_is_in_trouble(clock):
    twin = RotctlTwin(clock)
    twin.unplug()
    found = detect_firmware(PORT, clock, open_port=twin.dial)
    assert found.firmware is None
    assert found.trouble is not None
