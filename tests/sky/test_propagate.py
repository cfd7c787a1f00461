"""Elements through SGP4: against its verification set, and whole catalogues at one time."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
import sgp4
from birdcage.sky.elements import ElementSet
from birdcage.sky.frames import julian, posix_s
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import Fleet, satrec, sgp4_complaint, track
from sgp4.api import Satrec

HERE = Observer(47.0, 8.0, 500.0)


def verification_set() -> list[tuple[Satrec, ElementSet]]:
    """The 33 cases of Vallado et al. 2006 as the `sgp4` package carries them."""
    lines = (Path(sgp4.__file__).parent / "SGP4-VER.TLE").read_text(encoding="ascii").splitlines()
    pairs = [(line, lines[n + 1][:69]) for n, line in enumerate(lines) if line.startswith("1 ")]
    made = []
    for line1, line2 in pairs:
        record = Satrec.twoline2rv(line1, line2)
        epoch = datetime(1949, 12, 31, tzinfo=UTC) + timedelta(days=record.jdsatepoch - 2433281.5)
        made.append(
            (
                record,
                ElementSet(
                    name=line2[2:7], norad_id=record.satnum,
                    epoch=epoch + timedelta(days=record.jdsatepochF),
                    inclination_deg=math.degrees(record.inclo), raan_deg=math.degrees(record.nodeo),
                    eccentricity=record.ecco, argument_of_perigee_deg=math.degrees(record.argpo),
                    mean_anomaly_deg=math.degrees(record.mo), mean_motion_rev_day=record.no_kozai * 720.0 / math.pi,
                    bstar=record.bstar,
                ),
            )
        )  # fmt: skip
    return made


def test_elements_propagate_as_their_lines_do() -> None:
    compared = 0
    for record, elements in verification_set():
        t_s = posix_s(elements.epoch) + np.arange(0.0, 6.0 * 3600.0, 600.0)
        ours = satrec(elements)
        expected, r, v = record.sgp4_array(*julian(t_s))
        error, r1, v1 = ours.sgp4_array(*julian(t_s))
        assert list(error) == list(expected), elements.name
        fine = expected == 0
        assert np.abs(r1[fine] - r[fine]).max(initial=0.0) < 2e-5, elements.name
        assert np.abs(v1[fine] - v[fine]).max(initial=0.0) < 1e-7, elements.name
        compared += int(fine.sum())
    assert compared > 900


def test_a_number_of_nine_digits_is_no_obstacle() -> None:
    _, elements = verification_set()[0]
    far = replace(elements, norad_id=987654321)
    assert np.isfinite(Fleet([far]).look(HERE, far.epoch).el_deg).all()


def test_a_fleet_looks_as_each_of_its_tracks_does() -> None:
    elements = [one for _, one in verification_set()]
    fleet = Fleet(elements)
    when = elements[0].epoch
    seen = fleet.look(HERE, when, {2: 30.0})
    assert len(fleet) == len(elements) == len(seen.el_deg)
    assert fleet[2] is elements[2]
    fine = 0
    for index, one in enumerate(elements):
        alone = track(one, HERE, [posix_s(when)], 30.0 if index == 2 else 0.0)
        for name in ("az_deg", "el_deg", "range_km", "range_rate_km_s"):
            told = getattr(seen, name)[index]
            assert told == pytest.approx(getattr(alone, name)[0], abs=1e-6, nan_ok=True)
        fine += bool(np.isfinite(seen.el_deg[index]))
    assert fine > 10
    assert seen.el_deg[2] != fleet.look(HERE, when).el_deg[2]


def test_a_satellite_that_comes_later_is_where_it_was_computed_to_be_before() -> None:
    _, elements = verification_set()[0]
    t_s = posix_s(elements.epoch) + np.array([0.0, 60.0, 120.0])
    late, plain = track(elements, HERE, t_s, 60.0), track(elements, HERE, t_s)
    assert np.allclose(late.position_km[1:], plain.position_km[:-1], atol=1e-6)
    assert np.array_equal(late.t_s, t_s)


def test_where_sgp4_has_no_position_there_is_no_number() -> None:
    _, elements = verification_set()[0]
    broken = replace(elements, eccentricity=1.5)
    seen = Fleet([broken, elements]).look(HERE, elements.epoch)
    for told in (seen.az_deg, seen.el_deg, seen.range_km, seen.range_rate_km_s):
        assert list(np.isnan(told)) == [True, False]
    assert np.isnan(track(broken, HERE, [posix_s(elements.epoch)]).el_deg).all()
    assert "eccentricity" in sgp4_complaint(1)


def test_an_empty_fleet_sees_nothing() -> None:
    assert len(Fleet([]).look(HERE, datetime(2026, 1, 1, tzinfo=UTC)).az_deg) == 0
