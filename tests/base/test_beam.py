"""The beam: of a reflector and a feed together, an ellipse, and where its widths come from."""

from __future__ import annotations

import pytest
from birdcage.base.beam import Beam, BeamOrigin, beam_of
from birdcage.base.config import STOCK_FEED, FeedProfile, load
from birdcage.base.geometry import beside, offset, separation
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from hypothesis import given
from hypothesis import strategies as st

HELIX = FeedProfile(freq_min_hz=1.67e9, freq_max_hz=1.71e9)


def test_each_dish_has_its_own_beam_with_the_one_stock_feed():
    travler, carryout = (beam_of(STOCK_FEED, model.reflector) for model in (TRAVLER, CARRYOUT_G2))
    assert travler.words == "2.0° x 2.9° from reflector and frequency"
    assert carryout.words == ("5.5° x 5.5° from reflector and frequency; 6.4° x 6.3° measured in counts: upper bound")
    assert (travler.az_deg, travler.el_deg) == pytest.approx((2.01, 2.885), abs=0.005)


def test_the_band_of_the_feed_counts_and_not_only_the_dish():
    beam = beam_of(HELIX, TRAVLER.reflector)
    assert (beam.az_deg, beam.el_deg) == pytest.approx((14.8, 21.3), abs=0.1)
    assert beam_of(HELIX, CARRYOUT_G2.reflector).bound_deg is None, "the scan was made in Ku band"


def test_nothing_known_is_no_beam():
    assert beam_of(FeedProfile(), TRAVLER.reflector) is None, "no band"
    assert beam_of(STOCK_FEED, None) is None, "no dish"


def test_a_beam_loses_by_its_own_width_each_way():
    beam = beam_of(STOCK_FEED, TRAVLER.reflector)
    assert beam.loss_db(beam.az_deg / 2, 0.0) == pytest.approx(3.0)
    assert beam.loss_db(0.0, beam.el_deg / 2) == pytest.approx(3.0)
    assert beam.loss_db(0.3, 0.4) == pytest.approx(12 * (0.3 / 2.011) ** 2 + 12 * (0.4 / 2.885) ** 2, rel=0.002)
    # Where only the size of the error is known, the narrower width counts.
    assert beam.most_loss_db(0.5) == pytest.approx(beam.loss_db(0.5, 0.0))
    assert beam.most_loss_db(0.5) > beam.loss_db(0.0, 0.5)
    assert beam.most_loss_db(beam.error_deg(0.1)) == pytest.approx(0.1)
    # About seven times what the one stock feed of 6.3 degrees made of it.
    assert beam.most_loss_db(0.1) / Beam(6.3, 6.3).most_loss_db(0.1) == pytest.approx(9.8, abs=0.1)
    assert beam.loss_db(0.1, 0.1) / Beam(6.3, 6.3).loss_db(0.1, 0.1) == pytest.approx(7.3, abs=0.1)


def test_a_measured_beam_goes_before_theory_and_one_in_counts_only_where_it_is_narrower():
    def own(origin, az_deg=3.1, el_deg=3.3):
        feed = FeedProfile(
            freq_min_hz=12.2e9, freq_max_hz=12.7e9, beam_az_deg=az_deg, beam_el_deg=el_deg, beam_origin=origin
        )
        return beam_of(feed, TRAVLER.reflector).words

    assert own("scan") == "3.1° x 3.3° measured by a scan"
    assert own("entered") == "3.1° x 3.3° entered by hand"
    assert own("counts") == ("2.0° x 2.9° from reflector and frequency; 3.1° x 3.3° measured in counts: upper bound")
    assert own("counts", 1.8, 2.7) == "1.8° x 2.7° measured in counts: upper bound"
    no_band = FeedProfile(beam_deg=6.3, beam_origin="counts")
    assert beam_of(no_band, TRAVLER.reflector).words == "6.3° x 6.3° measured in counts: upper bound"


def test_a_beam_grows_with_the_wavelength_within_an_octave():
    beam = Beam(2.0, 3.0, 12.0e9, BeamOrigin.THEORY, (4.0, 4.0))
    assert beam.at(10.0e9) == Beam(pytest.approx(2.4), pytest.approx(3.6), 10.0e9, BeamOrigin.THEORY, (4.8, 4.8))
    assert beam.at(1.7e9) is beam.at(None) is beam


def test_settings_of_before_with_a_single_width_still_read(tmp_path):
    path = tmp_path / "birdcage.toml"
    path.write_text('[feed.stock-ku]\nbeam_deg = 6.3\n[feed]\nactive = "helix"\n[feed.helix]\nbeam_deg = 12\n')
    settings = load(path, {})
    assert settings.problems == ()
    assert beam_of(settings.active_feed, CARRYOUT_G2.reflector).words == "12.0° x 12.0° entered by hand"
    assert beam_of(settings.feeds["stock-ku"], TRAVLER.reflector).words == "6.3° x 6.3° entered by hand"


def test_half_of_an_ellipse_is_refused(tmp_path):
    path = tmp_path / "birdcage.toml"
    path.write_text("[feed.stock-ku]\nbeam_az_deg = 2.0\n")
    (problem,) = load(path, {}).problems
    assert "beam_el_deg is missing" in problem.text


DIRECTIONS = st.tuples(st.floats(0.0, 359.9), st.floats(0.0, 89.0))


@given(DIRECTIONS, DIRECTIONS)
def test_an_offset_is_as_long_as_the_angle_between_and_leads_back(one, other):
    right, up = offset(*one, *other)
    assert (right**2 + up**2) ** 0.5 == pytest.approx(separation(*one, *other), abs=1e-6)
    assert separation(*beside(*one, right, up), *other) == pytest.approx(0.0, abs=1e-5)
