"""A pass is followed at matched speeds over a line that loses answers: nothing ends, and the speeds are put back."""

from __future__ import annotations

import numpy as np
import pytest
from birdcage.base.geometry import separation
from birdcage.base.no_go import NoGoSector
from birdcage.sim.wire import DROP, PASS
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Release, Stop

from .pursuit_bench import PursuitBench, at, plan_of

WAITS_S = 100.0
"""So long the dish is polled before: the line has proved sound."""
GLIDES = {"controller": "velocity", "velocity_allowed": True}


def following(address="g2?seed=1", *, seconds=12.0, settings=None, **options):
    bench = PursuitBench(address, settings or {}).connect()
    start = at(bench) + WAITS_S
    bench.pursue(plan_of(start, lasts_s=90.0, az_rate=0.6, leave_s=start - 60.0), **(options or GLIDES))
    bench.until(Phase.FOLLOWING)
    bench.step(start + seconds - at(bench))
    return bench


def speeds(bench):
    """What the dish itself goes at."""
    with bench.device.lock:
        bench.device.machine.run()
        return [axis.data.max_rate_deg_s for axis in bench.device.dish.axes[:2]]


def own_speeds(bench):
    return speeds(bench) == pytest.approx([65.0, 45.0], abs=0.02) and not bench.state.speeds_lent


def error_deg(bench):
    truth, plan = bench.device.truth(), bench.pursuit.plan
    return separation(*plan.course.at(at(bench)), truth.az_deg, truth.el_deg)


def lose_next(bench, menu):
    """Lose the next answer that comes from a menu."""
    seen = bytearray()

    def fate(value):
        if seen.endswith(b"lost"):
            return PASS
        seen.append(value)
        if seen.endswith(menu):
            seen.extend(b"lost")
            return DROP
        return PASS

    bench.device.wire.to_host.set_plan(fate)
    return seen


def test_it_glides_from_the_first_moment_on():
    bench = following(seconds=1.0)
    assert max(speeds(bench)) < 2.0, "the speeds are not matched"
    worst = 0.0
    for _ in range(200):
        bench.step(0.1)
        worst = max(worst, error_deg(bench))
    assert worst < 0.1


@pytest.mark.parametrize("prompt", [b"STEP>", b"MOT>", b"TRK>"])
def test_a_lost_answer_ends_no_pursuit_and_the_dish_has_its_speeds_back(prompt):
    bench = following()
    lost = lose_next(bench, prompt)
    worst = 0.0
    for _ in range(150):
        bench.step(0.1)
        worst = max(worst, error_deg(bench))
    assert lost.endswith(b"lost"), "nothing was lost"
    assert worst < 0.4, "the dish stopped while the line was silent"
    assert bench.phases[-1] is Phase.FOLLOWING
    assert Phase.INTERRUPTED not in bench.phases
    assert speeds(bench) == pytest.approx([65.0, 45.0], abs=0.02)
    since = bench.clock.monotonic()
    bench.step(3.0)
    assert len(bench.moves_since(since)) > 20, "it does not step"
    bench.until(Phase.OVER)
    bench.step(2.0)
    assert own_speeds(bench)
    assert bench.state.fault is None


def damage_read_back(bench, of):
    """Lose the first digit of the azimuth's speed where the dish tells it next, and it begins like this."""
    seen, lost = bytearray(), []

    def fate(value):
        if not lost and seen.endswith(b"mv\r\nMax Vel [0] = ") and value in of:
            lost.append(value)
            return DROP
        seen.append(value)
        return PASS

    bench.device.wire.to_host.set_plan(fate)
    return lost


def test_a_speed_that_reads_back_wrong_for_a_damaged_digit_ends_nothing_either():
    bench = following()
    lost = damage_read_back(bench, b"0123456789")
    bench.step(15.0)
    assert lost
    assert bench.pursuit.phase is Phase.FOLLOWING
    assert speeds(bench) == pytest.approx([65.0, 45.0], abs=0.02)


def test_after_stop_on_a_line_that_loses_answers():
    bench = following()
    seen = [0]

    def fate(value):
        seen[0] += value == ord(">")
        return DROP if value == ord(">") and seen[0] % 9 == 0 else PASS

    bench.device.wire.to_host.set_plan(fate)
    bench.station.submit(Stop("you"))
    bench.step(30.0)
    assert not bench.device.truth().moving
    bench.device.wire.to_host.set_plan(None)
    bench.step(20.0)
    assert own_speeds(bench)


def test_a_damaged_answer_as_they_are_put_back_is_no_fault():
    bench = following()
    lost = damage_read_back(bench, b"7")
    bench.station.submit(Stop("you"))
    bench.step(20.0)
    assert lost
    assert own_speeds(bench)
    assert bench.state.fault is None


def test_after_the_link_was_lost_in_a_glide():
    bench = following()
    bench.device.unplug()
    bench.step(15.0)
    assert not bench.device.truth().moving, "it glides on for ever"
    bench.device.plug()
    bench.step(15.0)
    assert own_speeds(bench)
    bench.do(Release("you"))


def test_a_sector_that_only_a_glide_would_meet_ends_nothing():
    """Straight on from the beginning of the pass is the corner of a sector, over which the course climbs."""
    bench = following(settings={"sectors": (NoGoSector(107.0, 112.0, 37.0),)}, seconds=0.0)
    worst = 0.0
    for _ in range(300):
        bench.step(0.1)
        worst = max(worst, error_deg(bench))
    assert bench.pursuit.phase is Phase.FOLLOWING, bench.pursuit.why
    assert worst < 0.4
    assert speeds(bench) == pytest.approx([65.0, 45.0], abs=0.02), "it was not in the way"


def lossy(bench, share, seed=1):
    chance = np.random.default_rng(seed)
    bench.device.wire.to_host.set_plan(lambda value: DROP if value == ord(">") and chance.random() < share else PASS)


@pytest.mark.parametrize(("dish", "share"), [
    ("latency_min=0.02&latency_max=0.3", 0.0), ("backlash=0.06", 0.004), ("latency_max=0.3&backlash=0.06", 0.02),
], ids=["jitter", "play and losses", "all"])  # fmt: skip
def test_it_is_never_worse_than_stepping(dish, share):
    rms = []
    for options in (GLIDES, {"controller": "fast"}):
        bench = following(f"g2?seed=1&overshoot=0&{dish}", seconds=0.0, **options)
        lossy(bench, share, seed=1)
        errors = []
        for _ in range(850):
            bench.step(0.1)
            errors.append(error_deg(bench))
        assert Phase.INTERRUPTED not in bench.phases
        rms.append(float(np.sqrt(np.mean(np.square(errors)))))
    assert rms[0] < 1.1 * rms[1]


def test_a_speed_that_the_owner_has_told_is_not_taken_for_the_one_that_it_glides_at():
    told = {"own_facts": {"azimuth.speed_deg_s": 40.0, "elevation.speed_deg_s": 30.0}}
    bench = following(seconds=30.0, settings=told)
    assert speeds(bench)[0] < 2.0
    ways_go_at = bench.station._host.find("pursuit").task.context.model()
    assert (ways_go_at.azimuth.speed_deg_s, ways_go_at.elevation.speed_deg_s) == (40.0, 30.0)
    assert error_deg(bench) < 0.02
