"""What the dialects of the G2's kin make of answers that no source quotes."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import CommandRefused, Held, NoReply, PositionUnknown, Stopped
from birdcage.link.link import Link
from birdcage.protocol.g2plus import CarryoutG2PlusProtocol
from birdcage.protocol.menu_raw import MenuRaw
from birdcage.protocol.pathway_x2 import PathwayX2Protocol
from birdcage.protocol.trk.answers import ANGLE
from birdcage.rotator.facts import Readback
from birdcage.rotator.verdict import Grade
from birdcage.sim.port import SimPort, open_device
from birdcage.sim.trk.nvram import NvramSetting


class Bench:
    """A dialect on a simulated dish."""

    def __init__(self, dish, address):
        self.clock, self.told = VirtualClock(), []
        self.device = open_device(address, clock=self.clock)
        self.dish = dish
        dish.attach(Link(SimPort(self.device, "bench"), self.clock), self.clock)
        dish.on_facts = self.told.append

    def lines(self):
        with self.device.lock:
            self.device.machine.run()
            return [line for _, line in self.device.shell.received]

    def over(self, seconds):
        end = self.clock.monotonic() + seconds
        while not self.dish.slew_is_over():
            assert self.clock.monotonic() < end
            self.clock.advance(0.1)
        return self.clock.monotonic()


def g2plus(options=""):
    return Bench(CarryoutG2PlusProtocol(), f"g2plus?seed=1{options}")


@pytest.mark.parametrize(("bare", "readback"), [("angles", Readback.ALWAYS), ("error", None), ("nothing", None),
                                                ("target", None)])  # fmt: skip
def test_the_first_look_tells_whether_it_tells_where_it_is(bare, readback):
    bench = g2plus(f"&bare_a={bare}")
    bench.dish.meet()
    assert [facts.readback for facts in bench.told] == ([] if readback is None else [readback])
    asked = bench.lines().count("a")
    assert asked == (1 if readback else 2)
    bench.dish.meet()
    assert bench.lines().count("a") == asked, "it is asked once"
    if readback is None:
        with pytest.raises(PositionUnknown):
            bench.dish.get_position()
        bench.dish.home_motor(1)
        bench.dish.meet()
        assert bench.lines().count("a") > asked, "after homing it may tell"


@pytest.mark.parametrize(("line", "more"), [("h *", 2), ("home", 2), ("a 0 90.00", 0)])
def test_it_is_asked_again_after_a_person_has_homed_it(line, more):
    bench = g2plus("&bare_a=error")
    bench.dish.meet()
    asked = bench.lines().count("a")
    typed = MenuRaw(bench.dish).type_line(line, "mot", takes_s=30.0, confirmed=Grade.MOVES, permit=lambda: None)
    assert typed.wait(32.0) is not None
    bench.dish.meet()
    assert bench.lines().count("a") == asked + more


def test_it_is_asked_again_where_the_answer_to_its_homing_was_lost():
    bench = g2plus("&bare_a=error")
    bench.dish.meet()
    asked = bench.lines().count("a")
    bench.device.wire.to_host.silent = True
    with pytest.raises(NoReply):
        bench.dish.home_motor(0)
    bench.device.wire.to_host.silent = False
    bench.clock.advance(30.0)
    bench.dish.meet()
    assert bench.lines().count("a") == asked + 2


def test_a_root_that_shows_another_prompt_is_not_taken_for_one_of_them():
    bench = g2plus("&root_prompt=HAL>")
    with pytest.raises(NoReply):
        bench.dish.meet()
    assert set(bench.lines()) <= {"", "?"}


def test_an_axis_that_is_not_homed_is_told_too():
    bench = g2plus("&unhomed=1")
    bench.dish.meet()
    assert [facts.readback for facts in bench.told] == [Readback.ALWAYS]
    with pytest.raises(PositionUnknown, match="not homed"):
        bench.dish.get_position()


def test_row_20_that_is_another_one_is_never_written():
    bench = g2plus()
    bench.device.board.nvram.rows = {20: NvramSetting("Motor Type", "bool", 0)}
    for ask in (bench.dish.kill_search, bench.dish.restore_search):
        with pytest.raises(NoReply, match="'Motor Type', not its TV search"):
            ask()
    assert not [line for line in bench.lines() if line.startswith("e") or line == "s"]
    assert bench.dish.survey().search_disabled is None


def test_the_search_is_switched_off_and_on_again_by_row_20():
    bench = g2plus("&homes_at_boot=1")
    assert bench.dish.survey().search_disabled is False
    bench.dish.kill_search()
    assert "e 20 1" in bench.lines()
    assert "s" in bench.lines()
    bench.dish.restore_search()
    assert bench.lines()[-3:] == ["e 20 0", "s", "d 20"]


def test_back_at_its_root_unsent_it_has_restarted():
    bench, told = g2plus("&bare_a=error&boot_s=0"), []
    bench.dish.on_restart = told.append
    bench.dish.meet()
    bench.dish.enter_motor_menu()
    typed = MenuRaw(bench.dish).type_line("q", "mot", takes_s=1.0, confirmed=Grade.HARMLESS, permit=lambda: None)
    assert typed.wait(3.0) is not None
    bench.dish.meet()
    assert bench.device.truth().menu == "root"
    assert told == [], "somebody has left the menu"
    bench.dish.enter_motor_menu()
    bench.device.brown_out(quiet=True)
    bench.dish.meet()
    assert told == ["The dish is back in menu `root`, and nothing was sent that leads there."]
    asked = bench.lines().count("a")
    bench.dish.meet()
    assert len(told) == 1
    assert bench.lines().count("a") == asked, "it was asked once more whether it tells, by the look that showed it"


def test_one_that_tells_where_it_is_shows_a_restart_by_that():
    bench, told = g2plus(), []
    bench.dish.on_restart = told.append
    bench.dish.meet()
    bench.dish.enter_motor_menu()
    bench.device.brown_out(quiet=True)
    bench.dish.meet()
    assert told == []
    with pytest.raises(PositionUnknown):
        bench.dish.get_position()


def test_a_stall_told_while_the_second_axis_waits_is_that_stall():
    bench = Bench(PathwayX2Protocol(), "pathway-x2?seed=1&lag_min_s=5&lag_max_s=5&az_speed=10")
    bench.dish.meet()
    bench.dish.begin_slew(120.0, 40.0, None)
    bench.clock.advance(7.0)
    bench.device.stall(0)
    with pytest.raises(CommandRefused, match="AZ MOTOR STALLED") as refused:
        bench.over(60.0)
    assert refused.value.trouble is not None
    assert refused.value.trouble.axis == "azimuth"


def test_both_axes_are_sent_in_a_row_and_the_answers_are_awaited():
    bench = g2plus("&bare_a=error")
    bench.dish.meet()
    bench.dish.begin_slew(120.0, 40.0, None)
    assert not bench.dish.slew_is_over()
    bench.over(1.0)
    assert bench.lines()[-2:] == ["a 0 120.00", "a 1 40.00"]


@pytest.mark.parametrize(("options", "error"), [("&low_el=50", NoReply), ("&unhomed=1", CommandRefused)])
def test_one_axis_of_two_is_no_direction(options, error):
    bench = g2plus(f"&bare_a=error{options}")
    bench.dish.meet()
    bench.dish.begin_slew(120.0, 40.0, None)
    with pytest.raises(error):
        bench.over(3.0)


def test_a_line_that_is_not_answered_is_a_silence():
    bench = g2plus("&bare_a=error")
    bench.dish.meet()
    bench.device.wire.to_dish.silent = True
    bench.dish.begin_slew(120.0, 40.0, None)
    with pytest.raises(NoReply, match=r"did not answer `a 0 120\.00`"):
        bench.over(10.0)


@pytest.mark.parametrize(("make", "address"), [
    (CarryoutG2PlusProtocol, "g2plus?seed=1&bare_a=error"), (PathwayX2Protocol, "pathway-x2?seed=1&lag_max_s=0"),
])  # fmt: skip
@pytest.mark.parametrize("error", [Stopped, Held])
def test_stop_between_both_axes_keeps_the_second_from_going_out(make, address, error):
    bench, asked = Bench(make(), address), []

    def permit():
        asked.append(len(asked))
        if len(asked) == 2:
            raise error("STOP is latched: the motion was not sent.")

    bench.dish.meet()
    bench.dish.permit = permit
    with pytest.raises(Stopped, match="the azimuth was sent, the elevation was not") as stopped:
        bench.dish.begin_slew(120.0, 40.0, None)
    assert stopped.value.reason == "half_sent"
    bench.clock.advance(20.0)
    assert [line for line in bench.lines() if line.startswith("a ")] == ["a 0 120.00"]


def test_an_x2_that_was_sent_one_axis_alone_is_timed_from_the_farthest_end_the_next_time():
    bench = Bench(PathwayX2Protocol(), "pathway-x2?seed=1&lag_max_s=0")
    bench.dish.meet()
    bench.dish.begin_slew(120.0, 40.0, None)
    bench.over(120.0)
    permits = iter([lambda: None, raising(Stopped("STOP is latched."))])
    bench.dish.permit = lambda: next(permits)()
    with pytest.raises(Stopped):
        bench.dish.begin_slew(130.0, 45.0, None)
    bench.dish.slew_is_over()
    bench.dish.permit = None
    begun = bench.clock.monotonic()
    bench.dish.begin_slew(131.0, 45.0, None)
    assert bench.over(120.0) - begun > 30.0 + 360.0 / 10.0


def raising(error):
    def deed():
        raise error

    return deed


def test_homing_of_an_x2_is_awaited_for_as_long_as_it_may_wait_before_it():
    bench = Bench(PathwayX2Protocol(), "pathway-x2?seed=1&unhomed=1&lag_min_s=14.9&az_speed=30&el_speed=4")
    bench.dish.meet()
    bench.dish.enter_motor_menu()
    begun = bench.clock.monotonic()
    bench.dish.home_motor(0)
    assert bench.clock.monotonic() - begun > 17.0, "longer than a G2 is waited for"
    for line, longest_s in (("h 0", 30.0), ("h 1", 30.0), ("h *", 60.0)):
        assert bench.dish.judge(line, "mot", homed=True).takes_s == longest_s
    assert PathwayX2Protocol.model.homing_s == 30.0


def test_an_x2_that_never_tells_where_it_is_has_no_new_target_to_be_stopped_by():
    assert [rung.means for rung in PathwayX2Protocol.model.stop_ladder] == ["power"]


@pytest.mark.parametrize("ack", ["executed", "at_once"])
def test_an_x2_is_over_when_its_latest_execution_may_be(ack):
    bench = Bench(PathwayX2Protocol(), f"pathway-x2?seed=1&lag_min_s=14.9&lag_ack={ack}&az_speed=10&el_speed=10")
    bench.dish.meet()
    for azimuth, elevation in ((170.0, 45.0), (180.0, 50.0)):
        begun = bench.clock.monotonic()
        bench.dish.begin_slew(azimuth, elevation, None)
        over = bench.over(120.0)
        truth = bench.device.truth()
        assert not truth.moving
        assert (truth.az_deg, truth.el_deg) == (pytest.approx(azimuth, abs=0.1), pytest.approx(elevation, abs=0.1))
        assert over - begun >= 30.0
    assert over - begun < 35.0, "a short way is over soon after both waits"
    assert bench.lines().count("a") == 0, "it is never asked where it is"
    assert bench.lines()[-5:] == ["", "a 0 180.00", "", "a 1 50.00", ""]


def test_an_x2_that_answers_with_another_angle_goes_nobody_knows_where():
    answer = PathwayX2Protocol.move_answer
    line = "m 0  a 17000  np 111714"
    assert answer.told(0, [line]) == "17000"
    assert answer.told(1, [line]) is None
    assert answer.confirms("17000", 170.0, turns=True)
    assert not answer.confirms("1700", 170.0, turns=True)
    assert PathwayX2Protocol().says_target(line)
    assert ANGLE.told(0, ["Angle = 46.00"]) == "46.00"
    assert ANGLE.told(0, [line]) is None
