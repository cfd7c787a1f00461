"""One axis of a stream, modelled before its first byte."""

from __future__ import annotations

import pytest
from birdcage.antenna.motion import start_motion
from birdcage.antenna.steering import steered
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.values import Position

AZ, EL = 0, 1


def stream(rate_deg_s, seconds, *, latency_s=0.05, read_every_s=1.0, interval_s=0.2):
    """Send the azimuth along an even course, and read it as a dish that follows with a latency."""
    start = Position(100.0, 40.0)
    motion, now, read_at = None, 0.0, read_every_s
    here = start
    while now < seconds:
        ahead = 100.0 + rate_deg_s * (now + 0.3)
        motion = steered(CARRYOUT_G2, motion, here, AZ, ahead % 360.0, None, now, 1.0)
        now += interval_s
        if now >= read_at:
            here = Position((100.0 + rate_deg_s * (now + 0.1 - latency_s)) % 360.0, 40.0)
            motion, read_at = motion.with_reading(here, now, 1.0), read_at + read_every_s
    return motion, now


def test_the_other_axis_goes_on_as_it_was():
    both = start_motion(CARRYOUT_G2, Position(100.0, 40.0), 40.0, 60.0, 0.0)
    after = steered(CARRYOUT_G2, both, Position(100.0, 40.0), AZ, 150.0, None, 0.2, 1.0)
    assert after.elevation is both.elevation
    position, velocity = both.azimuth.modelled(0.2, 1.0)
    assert after.azimuth.modelled(0.2, 1.0) == pytest.approx((position, velocity))
    assert after.rest == pytest.approx((150.0, 60.0))


def test_azimuths_go_on_beyond_north():
    motion, _now = stream(6.0, 60.0)
    assert motion.azimuth.slew.end_deg == pytest.approx(100.0 + 6.0 * (60.0 - 0.2 + 0.3), abs=0.01)


@pytest.mark.parametrize("rate_deg_s", [-15.0, -3.0, 3.0, 15.0])
def test_stop_aims_near_and_ahead_between_two_readings(rate_deg_s):
    motion, now = stream(rate_deg_s, 10.9)
    position = motion.azimuth.modelled(now, 1.0)[0]
    aim = motion.stopped(now, 1.0).azimuth.slew.end_deg
    way = (aim - position) * (1 if rate_deg_s > 0 else -1)
    assert -1e-6 <= way <= abs(rate_deg_s) * 0.3 + 0.01


def test_stop_aims_short_of_a_far_target_by_the_model_and_not_by_the_last_reading():
    """A stream that leads far, as at a lowered speed: its target is not where STOP leads."""
    motion, now = stream(8.0, 4.8)
    far = steered(CARRYOUT_G2, motion, Position(130.0, 40.0), AZ, 200.0, None, now, 1.0)
    aim = far.stopped(now + 0.3, 1.0).azimuth.slew.end_deg
    position, velocity = far.azimuth.modelled(now + 0.3, 1.0)
    assert position < aim < position + velocity * 0.1 + velocity**2 / 800 + 0.01


def test_a_dish_seen_a_little_beyond_its_target_does_not_turn_the_other_way_round():
    motion, now = stream(6.0, 3.0)
    end = motion.azimuth.slew.end_deg
    seen = motion.with_reading(Position(end + 0.4, 40.0), now + 0.05, 1.0)
    seen = seen.with_reading(Position(end + 1.9, 40.0), now + 0.4, 1.0)
    assert seen.azimuth.slew.end_deg == end


def test_where_moves_queue_it_begins_when_the_one_before_is_over():
    here = Position(100.0, 40.0)
    first = steered(TRAVLER, None, here, AZ, 101.0, None, 0.0, 1.0)
    second = steered(TRAVLER, first, here, EL, 40.4, None, 0.35, 1.0)
    assert second.elevation.started == pytest.approx(first.eta(1.0)) == pytest.approx(0.5)
    assert second.azimuth is first.azimuth
    assert second.eta(1.0) == pytest.approx(0.8)
