"""What an owner says of the machine in `[dish.facts]`: gate, plan, STOP and everything that is shown go by it."""

from __future__ import annotations

import pytest
from birdcage.base.config import load
from birdcage.base.errors import MotionRefused
from birdcage.link.identity import dish_folder
from birdcage.rotator.facts import SecondMove
from birdcage.station.facts_file import FILE
from birdcage.station.known import model_of
from birdcage.station.mounting import mount_of
from birdcage.station.reach_limits import reach_limits
from birdcage.station.requests import ApplySettings, Goto, Stop, TurnSkew
from birdcage.station.state import LimitSource

from .conftest import Bench
from .test_waiting_dish import WAITS, sent_since, stands_at


def settings_of(tmp_path, text):
    path = tmp_path / "birdcage.toml"
    path.write_text(text)
    return load(path, {})


def bench_of(tmp_path, facts, address="g2?seed=1&az=-180", firmware="g2", **options):
    settings = settings_of(tmp_path, f"[dish.facts]\n{facts}")
    bench = Bench(address, {"own_facts": settings.own_facts, **options}, firmware)
    bench.connect()
    bench.watch("position")
    bench.step(2.0)
    return bench


@pytest.mark.parametrize(
    ("facts", "target", "said"),
    [
        ("elevation.min_deg = 30", (180, 25), "5.00° below the floor of 30.00°"),
        ("elevation.max_deg = 50", (180, 55), "5.00° above the limit of 50.00°"),
        ("azimuth.min_deg = 30", (20, 40), "10.00° beyond the limit of 30.00°"),
    ],
)
def test_the_gate_refuses_what_lies_outside_the_range_that_the_owner_says(tmp_path, facts, target, said):
    bench = bench_of(tmp_path, facts)
    with pytest.raises(MotionRefused, match=said):
        bench.do(Goto(*target, "you"))
    assert bench.moves_since(0.0) == []
    bench.do(Goto(180, 40, "you"))
    assert stands_at(bench, 180, 40)


def test_a_narrower_elevation_counts_before_and_after_the_dish_has_told_its_own(tmp_path):
    bench = bench_of(tmp_path, "elevation.min_deg = 30")
    bench.step(10.0)
    assert bench.state.surveyed
    assert bench.state.el_min_deg == 30.0
    assert bench.state.limit_sources["el_min"] is LimitSource.USER
    assert bench.state.el_max_deg == 65.0


def test_a_skew_range_that_was_an_assumption_is_wider_on_the_wire_too(tmp_path):
    bench = bench_of(tmp_path, "skew.max_deg = 200", "hal205?seed=1", "hal205")
    bench.station.submit(TurnSkew(190.0, "you"))
    bench.step(20.0)
    assert any(line.startswith("a 2 190") for line in bench.lines())
    with pytest.raises(MotionRefused, match=r"beyond the limit of 200\.00"):
        bench.do(TurnSkew(205.0, "you"))
    other = bench_of(tmp_path, "", "hal205?seed=1", "hal205")
    with pytest.raises(MotionRefused, match=r"beyond the limit of 180\.00"):
        other.do(TurnSkew(190.0, "you"))


def test_a_fact_that_could_harm_the_dish_keeps_it_from_moving_until_it_is_mended(tmp_path):
    bench = bench_of(tmp_path, "elevation.min_deg = 5")
    said = r"elevation.min_deg is 5, 13 deg beyond the Carryout G2's own limit of 18 deg, and can only narrow it"
    with pytest.raises(MotionRefused, match=said):
        bench.do(Goto(180, 40, "you"))
    bench.do(ApplySettings(load(None, {}), "you"))
    with pytest.raises(MotionRefused, match="start again"):
        bench.do(Goto(180, 40, "you"))
    assert bench.state.el_min_deg == 18.0


def test_the_plan_goes_by_the_owner_s_speed_even_where_the_dish_tells_a_greater_one(tmp_path):
    bench = bench_of(tmp_path, "azimuth.speed_deg_s = 20")
    bench.step(10.0)
    assert bench.state.readings["speed.azimuth"].value > 64.0
    mount = mount_of(bench.state, load(None, {}))
    assert (mount.model.azimuth.speed_deg_s, mount.model.elevation.speed_deg_s) == (20.0, pytest.approx(45.0, abs=0.01))
    bench.station.submit(Goto(0, 45, "you"))
    bench.step(0.5)
    assert bench.state.motion.eta - bench.state.motion.started == pytest.approx(180 / 20, abs=1.0)


def test_faces_without_a_dish_go_by_it_too(tmp_path):
    settings = settings_of(tmp_path, '[dish]\nfirmware = "g2"\n[dish.facts]\nelevation.min_deg = 30\n')
    assert reach_limits(settings, model_of("g2", settings)).el_floor_deg == 30.0


def test_a_dish_that_is_said_to_wait_moves_one_axis_at_a_time_from_the_first_move_on(tmp_path):
    bench = bench_of(tmp_path, 'second_same = "block"\nsecond_other = "block"', WAITS)
    since = bench.clock.monotonic()
    bench.station.submit(Goto(0, 30, "you"))
    bench.step(1.0)
    assert len(sent_since(bench, since)) == 1
    assert bench.state.motion.stop_means == "end of move"
    bench.step(8.0)
    assert stands_at(bench, 0, 30)


def test_stop_of_such_a_dish_ends_at_the_end_of_the_axis_s_move(tmp_path):
    bench = bench_of(tmp_path, 'second_same = "block"\nsecond_other = "block"', WAITS)
    bench.station.submit(Goto(0, 30, "you"))
    bench.step(0.5)
    bench.do(Stop("you"))
    bench.step(10.0)
    assert bench.state.last_stop.means == "end of move"
    assert bench.state.last_stop.confirmed is True


def test_a_dish_that_waits_though_its_owner_says_that_it_does_not_is_reported_and_both_are_kept(tmp_path):
    kept = {"state_folder": tmp_path, "identify": lambda _port: "usb:A"}
    bench = bench_of(tmp_path, 'second_same = "retarget"\nsecond_other = "retarget"', WAITS, **kept)
    bench.do(Goto(0, 30, "you"))
    assert bench.state.dish.second_same is SecondMove.RETARGET
    assert "seen to wait for its motors" in bench.state.warnings["facts"]
    bench.session.close()
    assert '"second_same", "value": "block", "origin": "learnt"' in (dish_folder(tmp_path, "usb:A") / FILE).read_text()
    assert bench_of(tmp_path, "", WAITS, **kept).state.dish.second_same is SecondMove.BLOCK
