"""The middle of a source from levels in several directions: planted sources, noise, and what is no source."""

from __future__ import annotations

import math
import random
import statistics

import pytest
from birdcage.base.geometry import shortest_turn
from birdcage.signal.beam_fit import FALL, BeamPoint, fit_beam

NOISE, WIDTH = 0.65, 6.4
EL_DEG = 40.0


def level(az_deg, el_deg, rise, at=(180.0, EL_DEG), width=WIDTH):
    across = shortest_turn(at[0], az_deg) * math.cos(math.radians(EL_DEG))
    return 400.0 + rise * math.exp(-FALL * (across**2 + (el_deg - at[1]) ** 2) / width**2)


def grid(rng, rise, *, side=5, step=0.35 * WIDTH, at=(180.0, EL_DEG), noise=NOISE):
    """A grid about a direction a third of a beam off the source."""
    points = []
    for i in range(side):
        for j in range(side):
            az_deg = (at[0] + 1.5 + (i - side // 2) * step / math.cos(math.radians(EL_DEG))) % 360.0
            el_deg = at[1] - 1.2 + (j - side // 2) * step
            points.append(BeamPoint(az_deg, el_deg, level(az_deg, el_deg, rise, at) + rng.gauss(0.0, noise), noise))
    return points


def off_deg(fit, at=(180.0, EL_DEG)):
    across = shortest_turn(at[0], fit.az_deg) * math.cos(math.radians(EL_DEG))
    return math.hypot(across, fit.el_deg - at[1])


@pytest.mark.parametrize(("rise", "least_deg"), [(150.0, 0.03), (46.0, 0.08)])
def test_25_points_find_the_middle_ten_times_better_than_the_highest_of_them(rise, least_deg):
    rng, fitted, highest = random.Random(1), [], []
    for _ in range(60):
        points = grid(rng, rise)
        fitted.append(off_deg(fit_beam(points, 5.0)))
        best = max(points, key=lambda each: each.value)
        highest.append(off_deg(best))
    assert statistics.median(fitted) < least_deg
    assert statistics.median(highest) > 10.0 * statistics.median(fitted)


def test_its_own_standard_deviation_is_honest():
    rng = random.Random(2)
    fits = [fit_beam(grid(rng, 60.0), 5.0) for _ in range(200)]
    rms = math.sqrt(statistics.fmean(off_deg(fit) ** 2 for fit in fits) / 2.0)  # of one direction
    assert statistics.fmean(fit.sigma_deg for fit in fits) == pytest.approx(rms, rel=0.25)


def test_rise_floor_and_width_are_those_that_were_planted():
    fit = fit_beam(grid(random.Random(3), 150.0), 4.0)
    assert (fit.rise, fit.floor) == (pytest.approx(150.0, abs=3.0), pytest.approx(400.0, abs=3.0))
    assert fit.width_deg == pytest.approx(WIDTH, rel=0.03)
    assert fit.points == 25


@pytest.mark.parametrize("width_deg", [None, 2.6, 12.0])
def test_a_wrong_idea_of_the_width_does_not_move_the_middle(width_deg):
    assert off_deg(fit_beam(grid(random.Random(4), 150.0), width_deg)) < 0.06


def test_across_north_it_is_found_too():
    at = (359.5, EL_DEG)
    fit = fit_beam(grid(random.Random(5), 150.0, at=at), 6.0)
    assert off_deg(fit, at) < 0.06
    assert 0.0 <= fit.az_deg < 360.0


def test_noise_alone_is_no_source():
    for seed in range(60):
        assert fit_beam(grid(random.Random(seed), 0.0), 6.0) is None


def test_too_few_points_a_line_and_one_flank_tell_no_middle():
    rng = random.Random(6)
    assert fit_beam(grid(rng, 150.0)[:5], 6.0) is None
    line = [BeamPoint(170.0 + i, EL_DEG, level(170.0 + i, EL_DEG, 150.0), NOISE) for i in range(20)]
    line_fit = fit_beam(line, 6.0)
    assert line_fit is None or line_fit.sigma_deg > 0.3
    flank = [
        BeamPoint(165.0 + i, EL_DEG + j, level(165.0 + i, EL_DEG + j, 150.0) + rng.gauss(0.0, NOISE), NOISE)
        for i in range(4) for j in range(4)
    ]  # fmt: skip
    assert fit_beam(flank, 6.0) is None


def test_equal_levels_and_points_at_one_place_are_refused():
    assert fit_beam([BeamPoint(100.0 + i, 30.0, 400.0, NOISE) for i in range(9)], 6.0) is None
    assert fit_beam([BeamPoint(100.0, 30.0, 400.0 + i % 3, NOISE) for i in range(9)], 6.0) is None


def with_neighbour(rng, rise, other, right_deg=9.5):
    beside = (180.0 + right_deg / math.cos(math.radians(EL_DEG)), EL_DEG)
    return [
        BeamPoint(each.az_deg, each.el_deg, each.value + level(each.az_deg, each.el_deg, other, beside) - 400.0, NOISE)
        for each in grid(rng, rise)
    ]


def test_beside_an_equal_neighbour_it_is_found_where_that_is_known():
    rng, alone, together = random.Random(7), [], []
    for _ in range(40):
        points = with_neighbour(rng, 150.0, 150.0)
        alone.append(fit_beam(points, 6.0))
        together.append(off_deg(fit_beam(points, 6.0, [[(9.5, 0.0)]])))
    assert statistics.median(together) < 0.1
    assert all(fit is None or off_deg(fit) > 0.2 for fit in alone)


def test_beside_a_stronger_neighbour_near_by_it_is_the_one_that_is_sought_that_is_found():
    rng, offs = random.Random(9), []
    for _ in range(40):
        fit = fit_beam(with_neighbour(rng, 100.0, 145.0, right_deg=4.3), 6.0, [[(4.3, 0.0)]])
        offs.append(off_deg(fit))
    assert statistics.median(offs) < 0.15


def test_of_several_patterns_the_one_that_is_there_counts():
    rng, there, offs = random.Random(10), [(4.3, 0.0)], []
    for _ in range(40):
        points = with_neighbour(rng, 145.0, 100.0, right_deg=4.3)
        offs.append(off_deg(fit_beam(points, 6.0, [[], [(9.5, 0.5)], there, [(-4.3, 0.0)], [(2.0, -3.0)]])))
    assert statistics.median(offs) < 0.15


def test_a_neighbour_that_is_not_there_costs_little():
    rng = random.Random(8)
    offs = [off_deg(fit_beam(grid(rng, 150.0), 6.0, [[(9.5, 0.0), (-12.0, 1.0)]])) for _ in range(40)]
    assert statistics.median(offs) < 0.06
