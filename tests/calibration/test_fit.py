"""The fit finds how a dish stands, as well as an independent simulation says, and knows how well it does."""

from __future__ import annotations

import math
import random
from datetime import UTC, datetime
from statistics import fmean

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.base.config.sections import AlignmentSettings
from birdcage.base.geometry import separation
from birdcage.calibration.fit import fit
from birdcage.calibration.peak import MeasuredPeak
from birdcage.calibration.terms import OFFSETS_ONLY, TERMS, WITH_TILT, priors_of
from birdcage.sky.geostationary import look_angle

NOON = datetime(2026, 3, 20, 12, 0, tzinfo=UTC)
SITE = (52.0, 5.0)
SUN = [(105.0, 18.0), (125.0, 32.0), (150.0, 45.0), (180.0, 55.0), (215.0, 50.0), (240.0, 35.0), (260.0, 20.0),
       (90.0, 40.0)]  # fmt: skip
NOISE_DEG = 0.1
NOTHING = AlignmentSettings()


def arc(count: int) -> list[tuple[float, float]]:
    """So many satellites along the arc, as one finds them there."""
    east, west = SITE[1] + 45.0, SITE[1] - 45.0
    return [look_angle(*SITE, east + (west - east) * index / (count - 1)) for index in range(count)]


def stand(rng: random.Random) -> Alignment:
    """A dish put up by hand: it points some two degrees off all over the sky."""
    return Alignment(rng.gauss(0, 1.5), rng.gauss(0, 0.8), rng.gauss(0, 0.3), rng.gauss(0, 0.9), rng.gauss(0, 0.9))


def peaks(alignment: Alignment, directions: list[tuple[float, float]], rng: random.Random | None) -> list[MeasuredPeak]:
    """What would be measured on them."""
    found = []
    for az, el in directions:
        right, up = (rng.gauss(0, NOISE_DEG), rng.gauss(0, NOISE_DEG)) if rng else (0.0, 0.0)
        dish = alignment.to_dish(az + right / math.cos(math.radians(el)), el + up)
        found.append(MeasuredPeak(NOON, "x", az, el, *dish, sigma_deg=NOISE_DEG))
    return found


def sky_error(true: Alignment, fitted: Alignment) -> float:
    """How far off the fitted model points, over the sky that such a dish reaches."""
    grid = [(az, el) for el in (20.0, 30.0, 40.0, 50.0, 60.0) for az in range(0, 360, 30)]
    offs = [separation(az, el, *true.to_true(*fitted.to_dish(az, el))) for az, el in grid]
    return math.sqrt(fmean(off**2 for off in offs))


def table(directions: list[tuple[float, float]], terms: tuple[str, ...]) -> float:
    """The error over the sky after the fit, over two dozen dishes: root mean square."""
    rng, errors = random.Random(4), []
    for _ in range(24):
        true = stand(rng)
        found = peaks(true, directions, rng)
        errors.append(sky_error(true, fit(found, priors_of(NOTHING, found), Alignment(), terms).alignment))
    return math.sqrt(fmean(error**2 for error in errors))


@pytest.mark.parametrize(
    ("directions", "terms", "most"),
    [
        # The figures of an independent simulation, with room for another draw of the dishes.
        (arc(6), WITH_TILT, 0.26),
        (arc(6), TERMS, 0.24),
        (arc(12), WITH_TILT, 0.24),
        (arc(12), TERMS, 0.19),
        (arc(6) + SUN, WITH_TILT, 0.21),
        (arc(6) + SUN, TERMS, 0.13),
    ],
)
def test_the_table_of_the_reference(directions: list, terms: tuple[str, ...], most: float) -> None:
    assert table(directions, terms) < most


def test_offsets_alone_leave_what_the_lean_makes() -> None:
    assert 0.5 < table(arc(6), OFFSETS_ONLY) < 1.6
    assert table(arc(6), OFFSETS_ONLY) > 3 * table(arc(6), TERMS)


def test_it_was_bad_before() -> None:
    rng = random.Random(4)
    before = [sky_error(stand(rng), Alignment()) for _ in range(24)]
    assert 1.5 < math.sqrt(fmean(each**2 for each in before)) < 3.0


def test_without_noise_it_is_found_to_a_hundredth() -> None:
    true = Alignment(133.0, -0.7, 0.2, 0.5, -0.3)
    found = peaks(true, arc(8) + SUN, None)
    fitted = fit(found, priors_of(NOTHING, found), Alignment(), TERMS)
    # The priors still pull a little: a ridge is a bias.
    assert sky_error(true, fitted.alignment) < 0.02
    assert fitted.rms_deg < 0.01
    assert fitted.rms_before_deg > 50.0
    assert fitted.alignment.az_offset_deg == pytest.approx(133.0, abs=0.1)


def test_it_knows_how_well_it_knows() -> None:
    rng, beyond = random.Random(7), 0
    for _ in range(40):
        true = stand(rng)
        found = peaks(true, arc(8) + SUN, rng)
        result = fit(found, priors_of(NOTHING, found), Alignment())
        error = result.errors_deg[TERMS.index("an_deg")]
        assert error is not None
        beyond += abs(result.alignment.an_deg - true.an_deg) > 2 * error
        assert result.leave_one_out_rms_deg is not None
        assert result.rms_deg < result.leave_one_out_rms_deg < 0.35
    assert beyond <= 6  # one in twenty is expected


def test_so_many_terms_as_the_peaks_carry() -> None:
    true = Alignment(10.0, 0.5, 0.1, 0.5, 0.2)
    by_count = {}
    for count in (1, 2, 3, 4, 6):
        found = peaks(true, arc(8)[:count], None)
        by_count[count] = fit(found, priors_of(NOTHING, found), Alignment())
    assert [len(each.terms) for each in by_count.values()] == [2, 2, 4, 5, 5]
    one = by_count[1]
    assert one.leave_one_out_rms_deg is None
    assert one.residuals[0].alone_right_deg is None
    assert one.rms_deg < 0.01
    assert (one.alignment.an_deg, one.errors_deg[2:]) == (0.0, (None, None, None))
    assert "Offsets only" in one.warning
    with pytest.raises(ValueError, match="needs a peak"):
        fit([], priors_of(NOTHING, []), Alignment())


def test_the_level_of_setup_is_believed() -> None:
    # Front north, leaning back by a degree: the axis leans south.
    true = Alignment(20.0, 0.4, 0.0, -0.94, 0.34)
    leveled = AlignmentSettings(pitch_deg=1.0, roll_deg=0.0)
    found = peaks(true, arc(8)[2:4], None)
    priors = priors_of(leveled, found)
    assert priors.leveled
    assert priors.mean[3:] == pytest.approx((-0.94, 0.34), abs=0.02)
    with_level = fit(found, priors, Alignment())
    without = fit(found, priors_of(NOTHING, found), Alignment())
    assert sky_error(true, with_level.alignment) < 0.1 < 0.5 < sky_error(true, without.alignment)


def test_a_short_stretch_of_the_arc_is_warned_of() -> None:
    true = Alignment(10.0, 0.5, 0.1, 0.5, 0.2)
    narrow = peaks(true, [(150.0 + az, 30.0 + az / 10) for az in range(6)], None)
    told = fit(narrow, priors_of(NOTHING, narrow), Alignment())
    assert told.condition is None or told.condition > 100.0
    assert "Add one far from them" in told.warning
    wide = peaks(true, arc(8) + SUN, None)
    assert fit(wide, priors_of(NOTHING, wide), Alignment()).warning == ""


def test_a_weak_peak_counts_less() -> None:
    true = Alignment(5.0, 0.0)
    good = peaks(true, arc(4), None)
    wrong = MeasuredPeak(NOON, "Moon", 180.0, 40.0, 172.0, 40.0, sigma_deg=3.0)
    taken = fit([*good, wrong], priors_of(NOTHING, good), Alignment())
    assert sky_error(true, taken.alignment) < 0.1
    trusted = MeasuredPeak(NOON, "Moon", 180.0, 40.0, 172.0, 40.0, sigma_deg=0.1)
    assert sky_error(true, fit([*good, trusted], priors_of(NOTHING, good), Alignment()).alignment) > 0.3


def test_the_peak_that_contradicts_the_others_is_named() -> None:
    true = Alignment(25.0, 0.0, 0.1, 0.5, 0.2)
    found = peaks(true, arc(6), random.Random(2))
    assert "agree" not in fit(found, priors_of(NOTHING, found), Alignment()).warning
    wrong = MeasuredPeak(NOON, "Sun", 150.0, 45.0, 0.0, 45.0, sigma_deg=NOISE_DEG, number=7)
    told = fit([*found[:3], wrong, *found[3:]], priors_of(NOTHING, found), Alignment())
    assert told.warning.startswith("Peak 7 (Sun) disagrees")
