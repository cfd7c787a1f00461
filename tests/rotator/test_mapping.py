"""A machine without azimuth and elevation: what its mapping makes of it, and what is said where it has none."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.mapped_way import mapped_motion, mapped_s
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import MotionRefused, PositionUnknown
from birdcage.base.geometry import separation
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.axis import Axis, Role
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.listed_facts import listed
from birdcage.rotator.mapping import Arc
from birdcage.rotator.own import laid_by_owner, with_speeds
from birdcage.rotator.plain import PlainLine, PlainRotator
from birdcage.rotator.values import Look, Position, Taken

SLIDE = Axis("slide", Role.ARC, -50.0, 50.0, 5.0, 10.0, 0.1)


def along(slide_deg):
    """From the south-east low, over the south, to the south-west."""
    return 180.0 + slide_deg, 40.0 - slide_deg**2 / 100.0


ARC = Arc("slide", -50.0, 50.0, along)
FACTS = replace(CARRYOUT_G2, axes=(SLIDE,), mapping=ARC, features={}, cable=None)
BARE = replace(FACTS, mapping=None, mapping_lacks="Tell it where it stands.")


@pytest.mark.parametrize("slide_deg", [-50.0, -13.7, 0.0, 49.99, 50.0])
def test_a_point_of_the_arc_is_found_again(slide_deg):
    angles, miss_deg = ARC.to_axes(*along(slide_deg))
    assert angles["slide"] == pytest.approx(slide_deg, abs=1e-4)
    assert miss_deg < 1e-4


@pytest.mark.parametrize(("az_deg", "el_deg"), [(180.0, 60.0), (90.0, 10.0), (200.0, 30.0), (0.0, 0.0)])
def test_nothing_on_the_arc_is_nearer(az_deg, el_deg):
    angles, miss_deg = ARC.to_axes(az_deg, el_deg)
    assert -50.0 <= angles["slide"] <= 50.0
    every = (separation(az_deg, el_deg, *along(k / 100.0)) for k in range(-5000, 5001))
    assert miss_deg <= min(every) + 1e-6


def test_what_it_reaches_counts_as_its_azimuth_and_elevation():
    assert FACTS.points
    assert (FACTS.azimuth.min_deg, FACTS.azimuth.max_deg) == pytest.approx((130.0, 230.0), abs=0.06)
    assert (FACTS.elevation.min_deg, FACTS.elevation.max_deg) == pytest.approx((15.0, 40.0), abs=0.06)
    assert FACTS.moves_in_turn
    assert "one axis along an arc" in FACTS.no_following
    across_north = replace(FACTS, mapping=replace(ARC, point=lambda deg: (deg % 360.0, 40.0)))
    assert (across_north.azimuth.min_deg, across_north.azimuth.max_deg) == (0.0, 360.0)


def test_its_own_axis_is_listed_and_the_others_are_not():
    names = {fact.name for fact in listed(FACTS)}
    assert "slide.max_deg" in names
    assert not {name for name in names if name.startswith(("azimuth", "elevation"))}


def test_what_an_owner_says_of_axes_that_it_has_not_does_not_count():
    laid, wrong = laid_by_owner(FACTS, {"azimuth.max_deg": 200.0})
    assert laid == FACTS
    assert "no azimuth axis" in wrong[0]
    assert with_speeds(FACTS, {0: 1.0}) == FACTS


class Slider(PlainRotator):
    facts = FACTS

    def __init__(self):
        self.line, self.sent, self.is_open, self.slide_deg = PlainLine(), [], False, -20.0

    def open(self, address, baud, clock, hooks):
        self.clock, self.is_open = clock, True

    def look(self, *, hurry=False, busy_s=0.0):
        return Look({"slide": self.slide_deg})

    def send(self, to, *, hurry=False, busy_s=0.0):
        self.sent.append(dict(to))
        return Taken(True, "", 0.0)


@pytest.fixture
def slider():
    machine = Slider()
    antenna = BirdcageAntenna(machine)
    antenna.rotator.open("somewhere", None, VirtualClock(), Hooks())
    return machine, antenna


def test_a_machine_that_tells_its_angle_is_read_and_sent_by_it(slider):
    machine, antenna = slider
    here = antenna.get_position()
    assert (here.azimuth, here.elevation) == (160.0, 36.0)
    assert antenna.point(200.0, 36.2) == pytest.approx((199.9, 36.04), abs=0.02)
    (sent,) = machine.sent
    assert sent["slide"] == pytest.approx(19.9, abs=0.02)
    assert antenna.miss_deg(200.0, 36.2) == pytest.approx(0.19, abs=0.02)
    motion = antenna.motion
    assert motion.over_by(1.0) == pytest.approx(motion.eta(1.0))
    for k in range(20):
        at = motion.at(k * 0.5, 1.0)
        assert ARC.to_axes(at.azimuth, at.elevation)[1] < 0.01
    with pytest.raises(MotionRefused, match=r"one axis along an arc.*Nothing was sent"):
        antenna.steer(0, 190.0)


def test_too_large_a_miss_is_refused_but_not_for_who_takes_the_nearest(slider):
    machine, antenna = slider
    with pytest.raises(MotionRefused) as refused:
        antenna.point(180.0, 60.0)
    assert "misses this direction by 20.00°, more than the 1.00° allowed" in str(refused.value)
    assert "azimuth 180.00°, elevation 40.00°" in str(refused.value)
    assert not machine.sent
    antenna.point(180.0, 60.0, clamp=True)
    assert machine.sent == [{"slide": pytest.approx(0.0, abs=0.01)}]


class Bare(Slider):
    facts = BARE


def test_without_a_mapping_there_is_no_direction():
    assert not BARE.points
    antenna = BirdcageAntenna(Bare())
    antenna.rotator.open("somewhere", None, VirtualClock(), Hooks())
    said = f"^The {BARE.name} has no azimuth and elevation. Tell it where it stands. Nothing was sent."
    for act in (antenna.get_position, antenna.glance, lambda: antenna.move_to(180.0, 40.0)):
        with pytest.raises(PositionUnknown, match=said) as unknown:
            act()
        assert unknown.value.reason == "no_direction"
    with pytest.raises(MotionRefused, match=said):
        antenna.steer(0, 190.0)


class TwoArcs:
    """An X-Y mount near the zenith: x leans it to the east, y to the north."""

    def to_axes(self, az_deg, el_deg):
        off, az = 90.0 - el_deg, math.radians(az_deg)
        wanted = {"x": off * math.sin(az), "y": off * math.cos(az)}
        angles = {name: max(-40.0, min(40.0, deg)) for name, deg in wanted.items()}
        return angles, separation(az_deg, el_deg, *self.to_sky(angles))

    def to_sky(self, angles):
        x, y = angles["x"], angles["y"]
        return math.degrees(math.atan2(x, y)) % 360.0, 90.0 - math.hypot(x, y)


def test_two_axes_turn_at_once_and_what_need_not_turn_rests():
    axes = (Axis("x", Role.ARC, -40.0, 40.0, 2.0, 8.0, 0.1), Axis("y", Role.ARC, -40.0, 40.0, 4.0, 8.0, 0.1))
    facts = replace(FACTS, axes=axes, mapping=TwoArcs())
    assert (facts.azimuth.min_deg, facts.azimuth.max_deg) == (0.0, 360.0)
    assert facts.elevation.min_deg == pytest.approx(90.0 - 40.0 * math.sqrt(2.0), abs=0.1)
    start, end = Position(90.0, 60.0), (270.0, 60.0)
    assert mapped_s(facts, start, *end) == pytest.approx(60.0 / 2.0 + 2.0 / 8.0)
    motion = mapped_motion(facts, start, *end, 0.0)
    # Through the zenith, and not round about it.
    assert motion.at(mapped_s(facts, start, *end) / 2.0, 1.0).elevation == pytest.approx(90.0, abs=0.5)
    assert mapped_s(facts, start, 90.0, 59.97) == 0.0
