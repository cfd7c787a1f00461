"""What a person sees of a rotator that speaks EasyComm, and what goes over the wire to it."""

from __future__ import annotations

import pytest
from birdcage.base.errors import (
    BirdcageError,
    CommandRefused,
    ConfirmationNeeded,
    Held,
    MotionRefused,
    NoReply,
    PositionUnknown,
)
from birdcage.easycomm.facts import FACTS, RP2040_FACTS, STOCK_FACTS
from birdcage.easycomm.kinds import kind_of
from birdcage.rotator.verdict import Grade
from birdcage.station.requests import AcknowledgeFault, Goto, Home, Jog, Raw, Read, Release, Set, Sync, Watch
from birdcage.station.state import Activity
from birdcage.testing import MachineBench, Stage
from birdcage.testing.features import opened

from tests.testing.test_easycomm import rotator

RP2040, STOCK = "&az=90&el=30", "&az=90&el=30&kind=stock"


def met(options, *, told=True):
    stage = Stage(MachineBench("easycomm", rotator(options), stops=(), near_deg=0.15))
    if told:
        stage.ready()
    else:
        stage.until(lambda: stage.state.surveyed, 20.0, "it was met")
        stage.step(1.0)
    return stage


def lines(stage):
    with stage.twin.device.lock:
        stage.twin.device.machine.run()
        return [line for _, line in stage.twin.device.shell.received]


def sets(stage):
    """The lines that name an angle."""
    return [line for line in lines(stage) if any(word[2:] for word in line.split() if word[:2] in ("AZ", "EL"))]


def test_it_asks_for_the_version_before_anything_that_one_of_them_takes_for_a_move():
    for options in (RP2040, STOCK):
        with met(options) as stage:
            assert lines(stage)[:2] == ["VE", "EL" if options == RP2040 else "AZ EL"]


def test_the_stock_firmware_is_never_asked_by_az_alone_whatever_is_done():
    with met(STOCK) as stage:
        stage.do(Goto(120.0, 40.0, "you"))
        stage.do(Jog(1.0, 0.0, "you"))
        stage.station.stop("you")
        stage.step(10.0)
        stage.do(Release("you"))
        stage.do(Jog(0.0, 1.0, "you"))
        stage.do(Read(("status", "error", "temperature", "end.azimuth")))
        assert "AZ" not in lines(stage)
        assert "EL" not in lines(stage)
        assert all(len(line.split()) == 2 for line in sets(stage)), (
            "both axes each time: one alone is read past its end"
        )
        assert stage.state.readings["temperature"].value == 27.0


def test_each_has_its_own_facts_once_it_was_met():
    with met(RP2040) as stage:
        assert (stage.state.dish.cable.min_deg, stage.state.dish.cable.max_deg) == (-360.0, 360.0)
        assert stage.state.dish.homing_s is None
        assert "kp" in stage.state.dish.features
        assert "temperature" not in stage.state.dish.features
    with met(STOCK) as stage:
        assert (stage.state.dish.cable.min_deg, stage.state.dish.cable.max_deg) == (0.0, 360.0)
        assert stage.state.dish.homing_s == STOCK_FACTS.homing_s
        assert "kp" not in stage.state.dish.features


def test_an_rp2040_has_to_be_told_where_it_points_and_then_is_asked_nothing_more():
    with met("&az=0&el=30", told=False) as stage:
        assert stage.state.position_lost == "unsynced"
        refusal = stage.refused(Goto(90.0, 30.0, "you"), PositionUnknown)
        assert "birdcage sync AZ EL" in str(refusal)
        assert sets(stage) == []
        stage.do(Sync(200.0, None, "you"))
        stage.do(Goto(230.0, 40.0, "you"))
        assert stage.truth.az_deg == pytest.approx(30.0, abs=0.15)
        assert stage.state.position.az_deg == pytest.approx(230.0, abs=0.15)


def test_the_turn_is_the_hosts_and_the_long_way_is_gone_where_the_cable_ends():
    with met("&az=300&el=30") as stage:
        stage.do(Goto(20.0, 30.0, "you"))
        assert sets(stage)[-1].startswith("AZ20.00"), "380 is beyond the cable, so back by 280 degrees"
        stage.do(Goto(350.0, 30.0, "you"))
        assert sets(stage)[-1].startswith("AZ-10.00"), "and the near way from there"


def test_a_banner_means_that_the_azimuth_is_unknown_until_it_is_told():
    with met(RP2040) as stage:
        stage.twin.device.reboot()
        stage.step(25.0)
        assert stage.state.fault is not None
        assert stage.state.position_lost == "unsynced"
        before = len(sets(stage))
        stage.refused(Goto(90.0, 30.0, "you"), BirdcageError)
        assert len(sets(stage)) == before
        stage.do(AcknowledgeFault("you"))
        stage.do(Sync(90.0, None, "you"))
        if stage.state.held is not None:
            stage.do(Release("you"))
        stage.do(Goto(100.0, 10.0, "you"))
        assert stage.truth.az_deg % 360.0 == pytest.approx(100.0, abs=0.15)


def test_one_that_is_met_as_it_starts_is_known_for_what_it_is():
    """Its version is not answered in time then, and its position is, a moment later."""
    stage = Stage(MachineBench("easycomm", rotator("&boot=1&el_homes=0&latency_max=0.1"), stops=()))
    stage.until(lambda: stage.state.surveyed, 30.0, "it was met")
    stage.step(2.0)
    assert stage.state.position_lost == "unsynced"
    assert stage.state.dish.zero_at_power_up == ("azimuth",)


def test_a_lost_byte_of_a_question_is_no_command():
    """`AZ` without its first byte would be the short word for `ZERO`."""
    with met(RP2040) as stage:
        stage.do(Goto(120.0, 40.0, "you"))
        for line in set(lines(stage)):
            for lost in range(len(line)):
                assert (line[:lost] + line[lost + 1 :]).upper() not in ("Z", "R", "S", "ZERO", "RESET"), line


def test_reset_is_never_sent_as_homing_to_an_rp2040():
    with met(RP2040) as stage:
        refusal = stage.refused(Home("you"), MotionRefused, CommandRefused)
        assert "no homing" in str(refusal)
        assert "RESET" not in lines(stage)


def test_before_it_is_met_homing_is_not_ruled_out():
    """`birdcage home` asks the rotator then, and does not refuse by what is known of the other one."""
    assert FACTS.no_homing == STOCK_FACTS.no_homing == ""
    assert "birdcage sync" in RP2040_FACTS.no_homing


def test_the_stock_firmware_homes_both_axes_by_one_reset():
    with met(STOCK) as stage:
        stage.do(Home("you"), 300.0)
        assert lines(stage).count("RESET") == 1
        assert stage.truth.az_deg == pytest.approx(0.0, abs=0.01)
        assert stage.state.homed is True
        stage.do(Goto(30.0, 20.0, "you"))
        assert stage.stands_at(30.0, 20.0)


def test_each_home_homes_both_axes_anew():
    with met(STOCK) as stage:
        for count in (1, 2):
            stage.do(Home("you"), 300.0)
            assert lines(stage).count("RESET") == count
            assert stage.state.homed is True


def test_a_switch_that_is_not_found_is_a_fault_that_says_so():
    with met(f"{STOCK}&home_fails=1") as stage:
        error = stage.refused(Home("you"), BirdcageError, within_s=300.0)
        assert "GE4" in str(error)
        assert stage.state.fault is not None


def test_no_position_is_told_while_the_stock_firmware_says_that_it_did_not_find_its_switches():
    stage = Stage(MachineBench("easycomm", rotator("&kind=stock&boot=1&home_fails=1"), stops=()))
    stage.until(lambda: stage.state.surveyed, 200.0, "it was met")
    stage.step(2.0)
    assert stage.state.position is None
    assert stage.state.position_lost == "unhomed"
    assert "switch it off and on" in str(stage.refused(Goto(90.0, 30.0, "you"), PositionUnknown))
    assert sets(stage) == []
    stage.do(Watch("you", frozenset({"position"})))
    stage.step(3.0)
    assert stage.state.position is None, "however often it is asked"
    stage.twin.device.firmware.board.error = 1
    stage.until(lambda: stage.state.position is not None, 10.0, "it says that all is well")


def test_a_firmware_that_nobody_knows_has_to_be_told_where_it_points():
    """A fork of the RP2040's counts from where it pointed at power-up, too."""
    assert kind_of("SatNOGS-Pico-v1").facts.zero_at_power_up == ("azimuth",)
    assert "birdcage sync" in kind_of("SatNOGS-Pico-v1").facts.no_homing
    assert kind_of("SatNOGS-v2.2").facts.zero_at_power_up == ()


def test_an_axis_whose_target_is_not_known_is_named_where_it_stands():
    """It may be in manual mode, with a target from long ago: a number ends that on both axes."""
    with met(RP2040) as stage:
        stage.do(Jog(5.0, 0.0, "you"))
        assert sets(stage) == ["AZ95.00 EL30.00"]
        stage.do(Jog(0.0, 2.0, "you"))
        assert sets(stage)[-1] == "EL32.00", "now both targets are ours"
        stage.station.stop("you")
        stage.step(5.0)
        stage.do(Release("you"))
        stage.do(Jog(1.0, 0.0, "you"))
        assert sets(stage)[-1].split() == [sets(stage)[-1]], "STOP has aimed both where they stand"
        stage.do(Raw("DUTY_EL0.2", "you", Grade.MOVES), 60.0)
        stage.step(1.0)
        stage.do(Raw("STOP", "you"), 60.0)
        stage.until(lambda: stage.is_found and stage.state.activity is Activity.IDLE, 60.0, "it was seen at rest")
        stage.do(Jog(1.0, 0.0, "you"))
        assert len(sets(stage)[-1].split()) == 2
        assert abs(stage.truth.el_deg - 32.0) > 1.0, "it stays where the duty has brought it"


def test_what_a_person_types_after_stop_voids_where_stop_has_aimed_an_axis():
    with met(RP2040) as stage:
        stage.station.submit(Goto(100.0, 30.0, "you"))
        stage.step(0.5)
        stage.station.stop("you")
        stage.step(5.0)
        stage.do(Release("you"))
        stage.do(Raw("DUTY_EL0.2", "you", Grade.MOVES), 60.0)
        stage.step(1.0)
        stage.do(Raw("DUTY_EL0", "you", Grade.MOVES), 60.0)
        stage.until(lambda: stage.is_found and stage.state.activity is Activity.IDLE, 60.0, "it was seen at rest")
        stage.do(Jog(1.0, 0.0, "you"))
        assert len(sets(stage)[-1].split()) == 2, "the elevation has another target than the one it stands at"
        assert stage.truth.el_deg > 31.0


def test_stop_is_the_rotators_own_command_and_leaves_at_once():
    for options, command in ((RP2040, "STOP"), (STOCK, "SA SE")):
        with met(options) as stage:
            stage.station.submit(Goto(200.0, 60.0, "you"))
            stage.step(2.0)
            stage.station.stop("you")
            stage.step(0.5)
            stage.until(lambda: stage.state.last_stop.confirmed is not None, 30.0, "STOP was followed up")
            assert command in lines(stage)
            assert stage.state.last_stop.means == "command"
            assert stage.state.last_stop.confirmed is True


def test_a_live_stream_between_the_answers_disturbs_nothing():
    with met(RP2040) as stage:
        stage.twin.device.receive(b"MONITOR\n")
        stage.do(Goto(120.0, 40.0, "you"))
        assert stage.stands_at(120.0, 40.0)
        assert stage.state.fault is None
        assert not [event for event in stage.events if "AZ_T=" in str(event)], "nor is it told line by line"


def test_its_bench_commands_are_features():
    with met(RP2040) as stage:
        told = stage.do(
            Read(("ticks.azimuth", "ticks.elevation", "kp", "ki", "kd", "imu.elevation", "status", "error"))
        )
        assert told["ticks.azimuth"].value == 22014.0
        assert (told["kp"].value, told["ki"].value, told["kd"].value) == (0.15, 0.03, 0.02)
        assert told["imu.elevation"].value == pytest.approx(30.0, abs=0.5)
        assert (told["status"].value, told["error"].value) == ("idle", "none")
        assert [each for each in lines(stage) if each in ("TICKS", "GAINS", "IMU")].count("GAINS") == 1
        stage.refused(Set("kp", 0.2, "you"), ConfirmationNeeded)
        assert stage.do(Set("kp", 0.2, "you", agreed=True)).value == 0.2
        assert stage.twin.device.dish.gains.kp == 0.2


def test_the_accelerometer_is_taken_for_the_elevation_after_a_question_where_there_is_one():
    with met(RP2040) as stage:
        stage.refused(Set("recal", True, "you"), ConfirmationNeeded)
        stage.do(Set("recal", True, "you", agreed=True))
        assert "RECAL" in lines(stage)
    with met(f"{RP2040}&imu=0") as stage:
        assert "accelerometer" in str(stage.refused(Set("recal", True, "you", agreed=True), CommandRefused))
        assert stage.do(Read(("imu.elevation", "kp"))).keys() == {"kp"}, "absent, and shown as a dash"


def test_zero_counts_from_here_moves_nothing_and_has_to_be_told_anew():
    with met(RP2040) as stage:
        stage.do(Goto(120.0, 40.0, "you"))
        before = stage.truth
        stage.refused(Set("zero", True, "you"), ConfirmationNeeded)
        stage.do(Set("zero", True, "you", agreed=True))
        assert stage.rests_for(5.0)
        assert stage.truth == before
        assert stage.twin.device.dish.az.ticks(stage.twin.device.machine.dish_s) == 0
        assert stage.state.position_lost == "unsynced"
        fault = stage.state.fault
        assert "It was synced a moment ago." in fault.meaning
        assert fault.remedy.endswith("Acknowledge, then sync it.")
        stage.refused(Goto(100.0, 30.0, "you"), BirdcageError)


def test_a_zero_whose_answer_is_lost_has_to_be_told_anew_all_the_same():
    with met(RP2040) as stage:
        board = stage.twin.device.firmware.board
        zero = board._words["ZERO"]
        board._words["ZERO"] = lambda: zero() and ""
        stage.refused(Set("zero", True, "you", agreed=True), NoReply)
        stage.step(1.0)
        assert stage.state.position_lost == "unsynced"


def test_a_zero_that_a_person_types_has_to_be_told_anew_too():
    with met(RP2040) as stage:
        stage.do(Raw("ZERO", "you", Grade.MOVES), 60.0)
        stage.until(lambda: stage.state.position_lost == "unsynced", 30.0, "its zero was forgotten")


@pytest.mark.parametrize(
    ("line", "grade"),
    [
        ("AZ EL", Grade.HARMLESS), ("GS", Grade.HARMLESS), ("STOP", Grade.HARMLESS), ("sa se", Grade.HARMLESS),
        ("TICKS", Grade.HARMLESS), ("AZ", Grade.MOVES), ("AZ100.0 EL20.0", Grade.MOVES), ("EL20", Grade.MOVES),
        ("DUTY_AZ0.3", Grade.MOVES), ("ZERO", Grade.MOVES), ("PARK", Grade.MOVES), ("VU500", Grade.MOVES),
        ("RESET", Grade.RUINS), ("RST", Grade.RUINS), ("KP0.3", Grade.SETTING), ("MONITOR", Grade.SETTING),
        ("CW1,0.5", Grade.SETTING), ("FOO", Grade.MOVES), ("VE AZ90", Grade.MOVES), ("GS PARK", Grade.MOVES),
        ("KP0.2 DUTY_AZ0.3", Grade.MOVES), ("CW1,0.5 PARK", Grade.MOVES), ("MON DUTY_EL1", Grade.MOVES),
    ],
)  # fmt: skip
def test_a_raw_line_is_judged_by_what_it_does(line, grade):
    with met(RP2040, told=False) as stage:
        verdict = stage.station.judge(line)
        assert verdict.grade is grade
        assert bool(verdict.consequence) is (grade is not Grade.HARMLESS)


def test_no_second_command_on_a_line_gets_past_a_latched_stop():
    with met(RP2040) as stage:
        stage.station.stop("you")
        stage.step(5.0)
        for line in ("VE AZ90", "GS PARK", "KP0.2 DUTY_AZ0.3", "TICKS EL80", "HELLO DUTY_EL1"):
            refusal = stage.refused(Raw(line, "you", Grade.RUINS), Held)
            assert line in str(refusal)
            assert line not in lines(stage)
        stage.do(Raw("KP0.2", "you", Grade.SETTING), 60.0)
        assert "KP0.2" in lines(stage), "what only sets a gain moves nothing by itself"


def test_a_raw_target_beyond_the_limits_is_told_as_such():
    with met(RP2040) as stage:
        assert stage.station.judge("AZ100 EL95").limit
        assert not stage.station.judge("AZ100 EL45").limit


def test_each_firmware_is_told_of_by_what_is_true_of_it():
    rp2040, stock, other = RP2040_FACTS, STOCK_FACTS, kind_of("Acme").facts
    assert "gets power" in rp2040.handling.north
    assert "switch" in stock.handling.north
    assert "two turns" not in stock.handling.clearance
    assert "stepper" not in rp2040.stop_ladder[0].sentence
    assert "13°" in stock.stop_ladder[0].sentence
    for unsure in (FACTS, other):
        assert "RP2040" in unsure.handling.clearance
        assert "stock" in unsure.handling.clearance
        assert "stock" in unsure.stop_ladder[0].sentence


def test_each_fact_of_the_class_has_somebody_who_stands_for_it():
    for facts in (FACTS, STOCK_FACTS):
        assert facts.origin_of("cable.min_deg") is not None
        assert facts.origin_of("stop_ladder") is not None


def test_a_target_behind_a_motor_that_ran_names_both_axes():
    with opened(MachineBench("easycomm", rotator(RP2040), stops=(), near_deg=0.15)) as (machine, twin):
        machine.send({"azimuth": 90.0, "elevation": 30.0})
        assert machine.run("elevation", -0.1) == -0.1
        machine.send({"azimuth": 91.0})
        assert [line for _, line in twin.device.shell.received if "AZ91.00" in line] == ["AZ91.00 EL30.00"]
