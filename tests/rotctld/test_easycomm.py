"""What a program on a serial port says in EasyComm, and what it is answered; no port, no station."""

from __future__ import annotations

import pytest
from birdcage.rotctld.easycomm_conversation import EasycommConversation, EasycommError
from birdcage.rotctld.easycomm_service import errors_of
from birdcage.rotctld.rotor import MoveDirection
from birdcage.rotctld.rprt import Rprt
from birdcage.station.state import LinkPhase, LinkState, StationState
from hypothesis import given
from hypothesis import strategies as st

from .scripted_rotor import ScriptedRotor


def talk(said, rotor=None, errors=EasycommError.NONE):
    rotor = rotor or ScriptedRotor()
    return b"".join(EasycommConversation(rotor, lambda: errors).feed(said)), rotor


@pytest.mark.parametrize(("said", "answered"), [
    (b"AZ\n", b"AZ123.5\n"), (b"EL\n", b"EL45.7\n"), (b"AZ EL \n", b"AZ123.5 EL45.7\n"),
    (b"AZ EL\r", b"AZ123.5 EL45.7\n"),
    (b"EL AZ\r\n", b"AZ123.5 EL45.7\n"), (b"AZ\nEL\n", b"AZ123.5\nEL45.7\n"), (b"az el\n", b"AZ123.5 EL45.7\n"),
])  # fmt: skip
def test_both_ways_of_asking_get_what_they_read(said, answered):
    """Hamlib to 4.5 asks for the pair in one line, from 4.6 on for each by itself."""
    assert talk(said)[0] == answered


@pytest.mark.parametrize(("az_deg", "el_deg", "answered"), [
    (359.96, -0.04, b"AZ0.0 EL0.0\n"), (0.04, 90.0, b"AZ0.0 EL90.0\n"), (7.25, -1.5, b"AZ7.2 EL-1.5\n"),
])  # fmt: skip
def test_what_is_told_stays_on_the_circle_and_has_no_sign_of_zero(az_deg, el_deg, answered):
    rotor = ScriptedRotor()
    rotor.where = az_deg, el_deg
    assert talk(b"AZ EL\n", rotor)[0] == answered


@pytest.mark.parametrize(("said", "wished"), [
    (b"AZ180.0 EL45.1\n", (180.0, 45.1)), (b"AZ180.0 EL45.1 UP000 XXX DN000 XXX\n", (180.0, 45.1)),
    (b"AZ 180 EL 45\n", (180.0, 45.0)), (b"AZ-20.0 EL100\n", (-20.0, 100.0)), (b";AZ180.0 EL45.1\n", (180.0, 45.1)),
    (b"AZ180,5 EL45,1\n", (180.5, 45.1)), (b"AZ90.0\n", (90.0, 45.678)), (b"EL30.0\n", (123.456, 30.0)),
])  # fmt: skip
def test_a_wish_is_taken_and_gets_no_answer(said, wished):
    answered, rotor = talk(said)
    assert answered == b""
    assert rotor.moves == [("set_position", *wished)]


def test_each_axis_in_a_line_of_its_own_is_one_wish_in_the_end():
    assert talk(b"AZ90.0\nEL30.0\n")[1].moves == [("set_position", 90.0, 45.678), ("set_position", 90.0, 30.0)]
    assert talk(b"AZ90.0\nSA SE\nEL30.0\n")[1].moves[-1] == ("set_position", 123.456, 30.0), "STOP takes it back"


@pytest.mark.parametrize("said", [b"SA SE \n", b"SA\n", b"SE\n", b"S\n", b"STOP\n"])
def test_stop_stops_and_gets_no_answer(said):
    answered, rotor = talk(said)
    assert answered == b""
    assert set(rotor.moves) == {("stop",)}


@pytest.mark.parametrize("said", [b"AZ90.0 EL45.0 SA SE\n", b"MU SA\n", b"AZ90 VL0\n", b"VU4900 STOP\n"])
def test_a_stop_wins_over_what_stands_before_it_in_the_same_line(said):
    assert set(talk(said)[1].moves) == {("stop",)}


def test_what_stands_behind_a_stop_counts():
    assert talk(b"SA SE AZ90 EL30\n")[1].moves[-1] == ("set_position", 90.0, 30.0)


def test_a_dish_out_of_reach_does_not_keep_the_rest_of_a_line_from_counting():
    rotor = ScriptedRotor()
    rotor.refuses["stop"] = Rprt.EIO
    assert talk(b"SA SE AZ\n", rotor)[0] == b"AZ123.5\n"


@pytest.mark.parametrize(("said", "way"), [
    (b"VU4900\n", MoveDirection.UP), (b"VR5000 VD100\n", MoveDirection.RIGHT | MoveDirection.DOWN),
    (b"ML\n", MoveDirection.LEFT), (b"MD\n", MoveDirection.DOWN),
])  # fmt: skip
def test_a_drive_goes_on_for_a_moment(said, way):
    assert talk(said)[1].moves == [("move", way, -1)]


def test_a_drive_with_no_speed_stops():
    assert talk(b"VU0\n")[1].moves == [("stop",)]


def test_park_parks():
    assert talk(b"PARK\n")[1].moves == [("park",)]


@pytest.mark.parametrize("said", [
    b"RESET\n", b"R\n", b"RB\n", b"HOME\n", b"Z\n", b"IP0\n", b"AN\n", b"CR 1\n", b"CW1,5\n", b"OP\n", b"AZx EL\x00y\n",
    b"\n\r\n  \n", b"VU\n", b"AZ1e9\n", b"\xff\xfe\x80\n", b"AZ12345678901234567890\n", "AZ٤٥\n".encode(),
])  # fmt: skip
def test_what_is_not_known_moves_nothing_and_gets_no_answer(said):
    """`RESET` homes nothing: no program that knows only a serial port runs a dish into its end stops."""
    answered, rotor = talk(said)
    assert answered == b""
    assert rotor.moves == []


def test_a_version_has_its_prefix():
    assert talk(b"VE\r")[0].startswith(b"VEbirdcage-")


def test_status_and_error():
    moving = ScriptedRotor()
    moving.flags = ("MOVING", "MOVING_AZ")
    assert talk(b"GS\n;GE\n;")[0] == b"GS1\nGE1\n"
    assert talk(b"GS\n", moving)[0] == b"GS2\n"
    assert talk(b"GS GE\n", errors=EasycommError.NONE | EasycommError.HOMING)[0] == b"GS8\nGE5\n"


def test_a_position_that_is_not_known_is_not_answered():
    rotor = ScriptedRotor()
    rotor.refuses["position"] = Rprt.EIO
    assert talk(b"AZ\nEL\nAZ EL\nAZ90.0\n", rotor)[0] == b""
    assert rotor.moves == [], "one axis alone can't be sent from a place that is not known"
    assert talk(b"AZ90.0 EL30.0\n", rotor)[1].moves == [("set_position", 90.0, 30.0)]


def test_a_line_that_is_too_long_is_dropped_whole():
    answered, rotor = talk(b"AZ10.0 " * 30 + b"\nAZ\n")
    assert answered == b"AZ123.5\n"
    assert rotor.moves == []
    assert talk(b"AZ10.0 EL20.0".ljust(127) + b"\n")[1].moves == [("set_position", 10.0, 20.0)]


@given(st.lists(st.binary(max_size=40) | st.sampled_from([b"AZ", b"EL", b"AZ10", b"\n", b"\r", b";", b" ", b"GE"])))
def test_any_bytes_in_any_pieces(pieces):
    """Whatever comes, in whatever pieces: it raises nothing, and the next whole line counts."""
    talk_one = EasycommConversation(ScriptedRotor(), lambda: EasycommError.NONE)
    for piece in pieces:
        for reply in talk_one.feed(piece):
            assert reply[:2] in (b"AZ", b"EL", b"GE", b"GS", b"VE")
    assert talk_one.feed(b"\nAZ EL\n")[-1] == b"AZ123.5 EL45.7\n"


@pytest.mark.parametrize(("link", "lost", "errors"), [
    (LinkPhase.LOST, "link", 3), (LinkPhase.UP, "unread", 3), (LinkPhase.UP, "unhomed", 5),
    (LinkPhase.UP, "unsynced", 5), (LinkPhase.UP, "untold", 5),
])  # fmt: skip
def test_what_ge_tells_of_a_dish(link, lost, errors):
    state = StationState(link=LinkState(link, 0.0), position_lost=lost)
    assert int(errors_of(state)) == errors
