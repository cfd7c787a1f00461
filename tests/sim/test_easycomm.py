"""The simulated EasyComm rotators against docs/reference/easycomm.md: what is sent, what comes back, what turns."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.sim.port import SimPort, open_device

BANNER = "== SatNOGS-RP2040-v0.2 ready =="


class Bench:
    """One of them, spoken to in lines."""

    def __init__(self, options=""):
        self.clock = VirtualClock()
        self.device = open_device(f"easycomm?seed=1{options}", clock=self.clock)
        self.port = SimPort(self.device, "bench", baud=19200)

    def say(self, line, wait_s=0.1):
        self.port.write(line.encode() + b"\n")
        self.clock.advance(wait_s)
        return self.heard()

    def heard(self):
        return self.port.read().decode().splitlines()

    def where(self):
        truth = self.device.truth()
        return truth.cable_deg, truth.el_deg

    def turned(self, line, wait_s=12.0):
        self.say(line, wait_s)
        return self.where()


@pytest.fixture
def rp2040():
    return Bench("&el=30")


@pytest.fixture
def stock():
    return Bench("&kind=stock&az=90&el=30")


@pytest.mark.parametrize(
    ("line", "answers"),
    [
        ("VE", ["VESatNOGS-RP2040-v0.2"]),
        ("AZ", ["AZ0.0 EL30.0"]),
        ("EL", ["AZ0.0 EL30.0"]),
        ("AZ EL", ["AZ0.0 EL30.0"] * 2),
        ("SA SE", ["AZ0.0 EL30.0"] * 2),
        ("STOP", ["AZ0.0 EL30.0"]),
        ("S", ["AZ0.0 EL30.0"]),
        ("SA", ["AZ0.0 EL30.0"]),
        ("GS", ["GS1"]),
        ("GE", ["GE1"]),
        ("TICKS", ["AZ_TICKS=0 EL_TICKS=3783"]),
        ("GAINS", ["KP=0.150 KI=0.030 KD=0.020"]),
        ("KP0.3", ["KP=0.300 KI=0.030 KD=0.020"]),
        ("DUTY_AZ0.3", ["AZ duty=0.30"]),
        ("DUTY_EL-0.5", ["EL duty=-0.50"]),
        ("ZERO", ["Encoders zeroed"]),
        ("PARK", ["AZ0.0 EL30.0"]),
        ("ve", ["VESatNOGS-RP2040-v0.2"]),
        (";AZ", []),
        ("AZEL", ["AZ0.0 EL30.0"]),
        ("GET_EL", ["AZ0.0 EL30.0"]),
        ("NONSENSE", []),
        ("AZ45.0 EL31.0", []),
        ("IP0", []),
    ],
)
def test_an_rp2040_answers_as_its_page_says(rp2040, line, answers):
    assert rp2040.say(line) == answers


def test_it_lists_its_commands_and_tells_all_at_once(rp2040):
    told = rp2040.say("INFO")
    assert told[0] == "AZ=0.0 EL=30.0"
    assert told[-1] == "MANUAL=1 STATUS=1 ERROR=1"
    assert len(told) == 6
    assert any("RECAL" in line for line in rp2040.say("HELP"))


def test_a_line_longer_than_127_bytes_is_dropped(rp2040):
    assert rp2040.say("VE" + " " * 126) == []
    assert rp2040.say("VE") == ["VESatNOGS-RP2040-v0.2"]


def test_cr_ends_a_line_as_lf_does(rp2040):
    rp2040.port.write(b"VE\rGS\r\n")
    rp2040.clock.advance(0.2)
    assert rp2040.heard() == ["VESatNOGS-RP2040-v0.2", "GS1"]


def test_a_target_is_reached_within_the_dead_band_and_it_says_that_it_moves(rp2040):
    rp2040.say("AZ45.0 EL40.0")
    assert rp2040.say("GS") == ["GS2"]
    rp2040.clock.advance(10.0)
    az_deg, el_deg = rp2040.where()
    assert abs(az_deg - 45.0) <= 0.06
    assert abs(el_deg - 40.0) <= 0.06
    assert rp2040.say("GS") == ["GS1"]


def test_it_turns_as_fast_as_16_rpm_by_its_gear_at_35_per_cent(rp2040):
    rp2040.say("AZ180.0 EL90.0", 2.0)
    before = rp2040.where()[0]
    rp2040.clock.advance(1.0)
    assert rp2040.where()[0] - before == pytest.approx(16 * 6 * 15 / 40 * 0.35, rel=0.01)


def test_it_does_not_wrap_and_stops_at_its_limits(rp2040):
    assert rp2040.turned("AZ350.0", 40.0)[0] == pytest.approx(350.0, abs=0.06)
    assert rp2040.turned("AZ10.0", 40.0)[0] == pytest.approx(10.0, abs=0.06), "it goes back by 340 degrees"
    assert rp2040.turned("AZ500.0", 60.0)[0] == pytest.approx(360.0, abs=0.06)
    assert rp2040.turned("EL-20.0", 10.0)[1] == pytest.approx(0.0, abs=0.06)


def test_stop_aims_where_it_stands(rp2040):
    rp2040.say("AZ90.0", 3.0)
    (told,) = rp2040.say("STOP")
    rp2040.clock.advance(5.0)
    assert rp2040.where()[0] == pytest.approx(float(told.split()[0][2:]), abs=0.5)
    assert not rp2040.device.truth().moving


def test_a_duty_drives_past_every_limit_until_a_number_behind_az_or_el_ends_it(rp2040):
    rp2040.say("DUTY_AZ-1", 30.0)
    assert rp2040.where()[0] == pytest.approx(-365.0), "it stands at its end stop"
    assert rp2040.say("INFO")[-1].startswith("MANUAL=1")
    rp2040.say("STOP")
    assert rp2040.say("INFO")[-1].startswith("MANUAL=1"), "STOP does not leave manual mode"
    rp2040.say("AZ-300.0", 10.0)
    assert rp2040.say("INFO")[-1].startswith("MANUAL=0")
    assert rp2040.where()[0] == pytest.approx(-300.0, abs=0.06)


def test_at_its_switch_the_loop_does_not_push_on():
    bench = Bench("&az=-364.5&el=30")
    bench.say("ZERO")
    assert bench.say("INFO")[3] == "AZ_END=1 EL_END=0"
    bench.say("AZ-20.0", 5.0)
    assert bench.where()[0] == pytest.approx(-364.5, abs=0.01)


def test_zero_leaves_the_target_so_a_driven_axis_runs_on(rp2040):
    rp2040.turned("AZ20.0 EL30.0")
    rp2040.say("ZERO", 10.0)
    assert rp2040.where()[0] == pytest.approx(40.0, abs=0.15)


def test_monitor_streams_ten_lines_a_second_until_it_is_sent_again(rp2040):
    assert rp2040.say("MONITOR", 0.05) == ["MONITOR ON (send MON again to stop)"]
    rp2040.clock.advance(1.0)
    lines = rp2040.heard()
    assert 9 <= len(lines) <= 11
    assert all(line.startswith("AZ_T=0 EL_T=3783  AZ_END=0") for line in lines)
    assert "MONITOR OFF (send MON again to stop)" in rp2040.say("MON")
    rp2040.clock.advance(1.0)
    assert rp2040.heard() == []


def test_reset_leaves_error_5_for_good(rp2040):
    assert rp2040.say("RESET") == ["AZ0.0 EL30.0"]
    assert rp2040.say("GE") == ["GE5"]
    assert rp2040.turned("AZ10.0 EL30.0")[0] == pytest.approx(10.0, abs=0.06)
    assert rp2040.say("GE") == ["GE5"]
    assert Bench("&alert=1").say("GE") == ["GE9"]


def test_the_accelerometer_tells_the_elevation_and_recal_takes_it(rp2040):
    assert rp2040.say("IMU")[0].startswith("X=0.50")
    rp2040.say("DUTY_EL0.3", 0.5)
    rp2040.say("STOP", 1.0)
    rp2040.say("ZERO")
    (told,) = rp2040.say("RECAL")
    assert float(told.split()[-2]) == pytest.approx(rp2040.where()[1], abs=0.3)
    assert Bench("&imu=0").say("RECAL")[0].startswith("IMU not found")


def test_at_power_up_it_levels_itself_counts_azimuth_from_there_and_says_so():
    bench = Bench("&boot=1")
    pose = bench.where()
    assert bench.say("VE", 0.5) == [], "it reads nothing while it starts"
    bench.clock.advance(20.0)
    lines = bench.heard()
    assert lines[0].startswith("EL homing: IMU reads")
    assert BANNER in lines
    assert lines[-1] == "VESatNOGS-RP2040-v0.2"
    assert bench.where()[0] == pytest.approx(pose[0])
    assert abs(bench.where()[1]) < 2.0
    assert bench.say("AZ")[0].startswith("AZ0.0 EL")


def test_apart_it_tells_each_axis_by_itself_and_both_on_one_line():
    bench = Bench("&el=30&replies=apart")
    assert bench.say("AZ") == ["AZ0.0"]
    assert bench.say("EL") == ["EL30.0"]
    assert bench.say("AZ EL") == ["AZ0.0 EL30.0"]


@pytest.mark.parametrize(
    ("line", "answers"),
    [
        ("VE", ["VESatNOGS-v2.2"]),
        ("AZ EL", ["AZ90.0 EL30.0"]),
        ("SA SE", ["AZ90.0 EL30.0"]),
        ("PARK", ["AZ90.0 EL30.0"]),
        ("STOP", []),
        ("GS", ["GS1"]),
        ("GE", ["GE1"]),
        ("IP0", ["IP0,27"]),
        ("IP3", ["IP3,90.00"]),
        ("CR 7", ["7,0.00"]),
        ("TICKS", []),
    ],
)
def test_the_stock_firmware_answers_as_its_page_says(stock, line, answers):
    assert stock.say(line) == answers


def test_a_bare_az_turns_the_stock_firmware_to_0_unless_it_is_a_later_one(stock):
    assert stock.say("AZ", 20.0) == []
    assert stock.where() == pytest.approx((0.0, 30.0), abs=0.01)
    later = Bench("&kind=stock&az=90&el=30&bare_az=answer")
    assert later.say("AZ", 20.0) == ["AZ90.0"]
    assert later.where()[0] == pytest.approx(90.0)


def test_the_stock_firmware_goes_and_parks_and_only_notes_a_speed(stock):
    assert stock.turned("AZ100.0 EL40.0") == pytest.approx((100.0, 40.0), abs=0.01)
    stock.say("CW7,20")
    assert stock.say("CR 7") == ["7,20.00"]
    assert stock.turned("PARK") == pytest.approx((20.0, 0.0), abs=0.01)
    assert stock.say("CR 9") == ["9,0"]
    assert stock.turned("VL2000") == pytest.approx((20.0, 0.0), abs=0.01)
    assert stock.say("CR 9") == ["9,1"]


def test_the_stock_firmware_passes_by_where_it_is_stopped_and_comes_back(stock):
    stock.say("AZ270.0 EL30.0", 6.0)
    (told,) = stock.say("SA SE", 1.8)
    stopped_deg = float(told.split()[0][2:])
    assert stock.where()[0] > stopped_deg + 10.0
    stock.clock.advance(5.0)
    assert stock.where()[0] == pytest.approx(stopped_deg, abs=0.15)


def test_the_stock_firmware_homes_at_its_switches_and_reads_nothing_meanwhile(stock):
    assert stock.say("RESET") == ["AZ90.0 EL30.0"]
    assert stock.say("AZ EL", 10.0) == []
    stock.clock.advance(60.0)
    assert stock.heard() == ["AZ0.0 EL0.0"]
    assert stock.say("GE") == ["GE1"]
    failing = Bench("&kind=stock&az=90&el=30&home_fails=1")
    failing.say("RESET", 60.0)
    assert failing.say("GE") == ["GE4"]
    assert failing.say("GS") == ["GS8"]
    assert failing.turned("AZ50.0 EL20.0")[0] == pytest.approx(0.0, abs=0.1), "it moves no more"


def test_the_stock_firmware_homes_again_after_rb_and_reads_nothing_meanwhile():
    failing = Bench("&kind=stock&az=90&el=30&home_fails=1")
    failing.say("RB", 5.0)
    assert failing.say("GE", 5.0) == []
    failing.clock.advance(90.0)
    assert failing.heard() == ["GE4"]


def test_after_rst_the_stock_firmware_answers_only_its_status_until_rb(stock):
    stock.say("RST")
    assert stock.say("AZ EL") == []
    assert stock.say("GS") + stock.say("GE") == ["GS8", "GE16"]
    stock.say("RB", 120.0)
    assert stock.say("GE") == ["GE1"]


@pytest.mark.parametrize(
    ("line", "az_deg"), [("AZx EL30.0", 90.0), ("AZ1e1 EL30.0", 90.0), ("AZ L", 0.0), ("AZ80,5 EL30.0", 80.0)]
)
def test_a_damaged_set_of_the_stock_firmware(stock, line, az_deg):
    assert stock.turned(line) == pytest.approx((az_deg, 30.0), abs=0.01)


def test_an_rp2040_reads_numbers_as_c_does_and_writes_a_long_dash(rp2040):
    assert rp2040.turned("AZ1e1 EL30.0")[0] == pytest.approx(10.0, abs=0.06)
    assert Bench("&imu=0").say("RECAL") == ["IMU not found \u2014 cannot recalibrate"]
