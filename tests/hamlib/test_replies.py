"""What a rotctld's lines are read as."""

import pytest
from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.hamlib.address import dialled
from birdcage.hamlib.aims import AxisAims
from birdcage.hamlib.model import FACTS, facts_of, on_cable
from birdcage.hamlib.replies import CodeReply, Heard, PositionReply, ServerState, read_state, reason_of, words_of
from birdcage.rotator.axis import CableRange, TurnBy
from birdcage.rotator.facts import CableTurn
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.rotator.origin import Origin
from rotctl_twin import opened

TAGS = ["1", "1", "min_az=-180.000000", "max_az=450.000000", "min_el=0.000000", "max_el=90.000000", "south_zero=0",
        "rot_type=AzEl", "done"]  # fmt: skip
"""As Hamlib 4.5.4 and 4.7.2 write it (docs/reference/rotctl.md, *Ranges*)."""


@pytest.mark.parametrize(
    ("address", "to"),
    [
        ("rotctl://shed:1234", "socket://shed:1234"), ("rotctl://shed", "socket://shed:4533"),
        ("rotctl://[::1]", "socket://[::1]:4533"), ("ROTCTL://Shed:1", "socket://shed:1"),
        ("socket://shed:1", "socket://shed:1"), ("/dev/ttyUSB0", "/dev/ttyUSB0"), ("sim:rotctl", "sim:rotctl"),
    ],
)  # fmt: skip
def test_what_is_dialled(address, to):
    assert dialled(address) == to


@pytest.mark.parametrize(
    "address", ["rotctl://", "rotctl://:4533", "rotctl://shed:0", "rotctl://shed:70000", "rotctl:shed"]
)
def test_what_is_no_address(address):
    with pytest.raises(LinkError, match="write it as rotctl://host or rotctl://host:port") as error:
        dialled(address)
    assert error.value.reason is Reason.UNSUPPORTED


def told(reply, *lines):
    return [reply.hear(line) for line in lines]


@pytest.mark.parametrize(
    ("lines", "angles"),
    [
        (("180.00", "45.00"), (180.0, 45.0)), (("-134.500000", "10.0"), (-134.5, 10.0)), (("180", "45"), (180.0, 45.0)),
        (("180 45",), (180.0, 45.0)), (("180,5", "45,25"), (180.5, 45.25)), (("1e2", "+1"), (100.0, 1.0)),
    ],
)  # fmt: skip
def test_positions(lines, angles):
    reply = PositionReply("p")
    assert told(reply, *lines)[-1] is Heard.END
    assert reply.angles == angles


def test_what_stands_before_a_position_is_not_taken_for_it():
    reply = PositionReply("p")
    assert told(reply, "RPRT 0", "hello", "180.00", "hello", "45.00") == [
        Heard.STRAY, Heard.STRAY, Heard.PART, Heard.STRAY, Heard.END,
    ]  # fmt: skip
    assert reply.angles == (180.0, 45.0)


def test_an_error_is_the_reply():
    reply = PositionReply("p")
    assert told(reply, "RPRT -6") == [Heard.END]
    assert (reply.is_refused, reply.code) == (True, -6)


@pytest.mark.parametrize("line", ["RPRT 0", "RPRT  0"])
def test_codes(line):
    reply = CodeReply("S")
    assert told(reply, line) == [Heard.END]
    assert not reply.is_refused


def test_a_number_says_that_a_command_is_left_unanswered():
    assert told(CodeReply("S"), "180.00") == [Heard.OTHERS]


@pytest.mark.parametrize(
    ("code", "reason", "words"),
    [
        (-1, Reason.BAD_PARAMETER, "RPRT -1 (invalid parameter, or beyond its range)"),
        (-21, Reason.OUT_OF_RANGE, "RPRT -21 (beyond its range)"),
        (-4, Reason.UNSUPPORTED, "RPRT -4 (not implemented)"),
        (-99, Reason.FAILED, "RPRT -99"),
    ],
)
def test_what_codes_mean(code, reason, words):
    assert (reason_of(code), words_of(code)) == (reason, words)


@pytest.mark.parametrize(
    ("lines", "state"),
    [
        (TAGS, ServerState("1", -180.0, 450.0, 0.0, 90.0, False, "AzEl")),
        (["0", "901", "0", "360", "0", "180"], ServerState("901", 0.0, 360.0, 0.0, 180.0)),
        (["1", "x", "done"], ServerState()),
        (["1", "2", "min_az = -10", "new_tag=3", "max_az=", "south_zero=1", "done"],
         ServerState("2", -10.0, None, None, None, True)),
        ([], ServerState()),
    ],
)  # fmt: skip
def test_ranges_are_read_leniently(lines, state):
    assert read_state(lines) == state


def test_a_range_is_the_cable_and_the_host_chooses_the_turn():
    facts = facts_of(read_state(TAGS))
    assert (facts.cable, facts.turn, facts.azimuth.turn_by) == (
        CableRange(-180.0, 450.0),
        CableTurn.REPORTED,
        TurnBy.HOST,
    )
    assert (facts.azimuth.min_deg, facts.azimuth.max_deg) == (0.0, 360.0)
    assert (facts.elevation.min_deg, facts.elevation.max_deg) == (0.0, 90.0)
    for name in ("cable.min_deg", "cable.max_deg", "elevation.min_deg", "elevation.max_deg"):
        assert facts.origin_of(name) is Origin.DOCUMENTED


def test_without_ranges_the_widest_sensible_ones_are_inferred():
    facts = facts_of(None)
    assert (facts.cable, facts.cable_known, facts.azimuth.turn_by) == (None, False, TurnBy.MACHINE)
    assert facts.features == {}
    for name in ("azimuth.min_deg", "azimuth.max_deg", "elevation.min_deg", "elevation.max_deg"):
        assert facts.origin_of(name) is Origin.INFERRED


@pytest.mark.parametrize("state", [ServerState(), ServerState(min_az_deg=90.0, max_az_deg=90.0, min_el_deg=0.0)])
def test_what_is_no_range_is_none(state):
    facts = facts_of(state)
    assert (facts.cable, facts.elevation) == (None, FACTS.elevation)


def test_it_does_not_flip():
    assert facts_of(ServerState(min_el_deg=-10.0, max_el_deg=180.0)).elevation.max_deg == 90.0


@pytest.mark.parametrize(
    ("told_deg", "cable", "turn_deg"),
    [
        (270.0, (-180.0, 180.0), -90.0), (181.0, (-180.0, 180.0), 181.0), (400.0, (-180.0, 450.0), 400.0),
        (-90.0, (0.0, 360.0), 270.0), (200.0, (0.0, 100.0), 200.0),
    ],
)  # fmt: skip
def test_an_azimuth_a_whole_turn_off_its_range(told_deg, cable, turn_deg):
    assert on_cable(told_deg, CableRange(*cable)) == turn_deg


class TestAims:
    @staticmethod
    def see(aims, az_deg, el_deg, at, *, circle=False):
        aims.see({"az": az_deg, "el": el_deg}, at, aims.era, circle=circle)

    def test_the_axis_that_stays_goes_where_it_was_sent(self):
        aims = AxisAims()
        self.see(aims, 10.0, 20.0, 0.0)
        assert aims.with_({"az": 50.0}, circle=False) == {"az": 50.0, "el": 20.0}
        aims.sent({"az": 50.0, "el": 40.0}, 1.0)
        self.see(aims, 11.0, 21.0, 2.0)
        assert aims.with_({"az": 60.0}, circle=False) == {"az": 60.0, "el": 40.0}

    def test_after_stop_it_stays_where_it_is_seen(self):
        aims = AxisAims()
        aims.sent({"az": 50.0, "el": 40.0}, 1.0)
        aims.forget()
        self.see(aims, 12.0, 22.0, 2.0)
        assert aims.with_({"az": 60.0}, circle=False) == {"az": 60.0, "el": 22.0}

    def test_what_was_asked_for_before_stop_is_too_old_after_it(self):
        aims = AxisAims()
        asked = aims.era
        aims.forget()
        aims.see({"az": 12.0, "el": 22.0}, 2.0, asked, circle=False)
        assert not aims.knows("el")

    def test_a_refusal_that_comes_after_stop_brings_nothing_back(self):
        aims = AxisAims()
        self.see(aims, 10.0, 20.0, 0.0)
        before = aims.known
        aims.sent({"az": 50.0, "el": 40.0}, 1.0)
        aims.forget()
        aims.back_to(before)
        assert not aims.knows("el")

    def test_one_that_rests_elsewhere_was_sent_there_by_somebody_else(self):
        aims = AxisAims()
        aims.sent({"az": 50.0, "el": 40.0}, 0.0)
        self.see(aims, 50.0, 30.0, 10.0)
        self.see(aims, 50.0, 30.01, 11.0)
        assert aims.with_({}, circle=False) == {"az": 50.0, "el": 30.01}
        assert not AxisAims().knows("az")

    def test_a_whole_turn_off_it_is_still_where_it_was_sent(self):
        aims = AxisAims()
        aims.sent({"az": 270.0, "el": 40.0}, 0.0)
        self.see(aims, -90.0, 40.0, 10.0, circle=True)
        self.see(aims, -90.0, 40.0, 11.0, circle=True)
        assert aims.with_({}, circle=False)["az"] == 270.0
        assert aims.with_({"az": -90.0, "el": 41.0}, circle=True) == {"az": 270.0, "el": 41.0}
        assert aims.with_({"az": -89.99}, circle=True)["az"] == -89.99

    def test_stop_while_the_reply_to_a_target_is_due_voids_the_target(self, monkeypatch):
        """As from another thread: what the reply, or an error in its place, brings afterwards is too late."""
        rotator, twin, _clock = opened("seed=1&az=100&el=30")
        rotator.meet()
        rotator.look()
        session, waits = rotator.session, rotator.session.await_reply

        def stopped_meanwhile(*given):
            monkeypatch.setattr(session, "await_reply", waits)
            rotator.stop_now(StopOrder(StopBy.COMMAND))
            return waits(*given)

        monkeypatch.setattr(session, "await_reply", stopped_meanwhile)
        rotator.send({"azimuth": 160.0, "elevation": 80.0})
        rotator.settle(1.0)
        rotator.send({"azimuth": 99.0})
        sent = [line for line in twin.said() if line.startswith(("P", "S"))]
        assert sent[:2] == ["P 160.00 80.00", "S"]
        assert float(sent[2].split()[2]) == pytest.approx(30.0, abs=1.0), "where it is, not where it was going"
