"""What Sun, Moon and planets do to a meter."""

from __future__ import annotations

import math
from datetime import UTC, datetime

import pytest
from birdcage.base.beam import Beam, beam_of
from birdcage.base.config import FeedProfile
from birdcage.base.config.feeds import STOCK_FEED
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.sky.ephemeris.bodies import BODIES
from birdcage.sky.observer import Observer
from birdcage.sky.rise import Ear, body_rise_db, expected_rise_db, quiet_sun_k, rise_words
from birdcage.sky.targets import Resolver

HERE, NOW = Observer(52.0, 4.4), datetime(2026, 11, 21, 12, tzinfo=UTC)
STOCK = Ear.of(STOCK_FEED, beam_of(STOCK_FEED, CARRYOUT_G2.reflector))
ON_TRAVLER = Ear.of(STOCK_FEED, beam_of(STOCK_FEED, TRAVLER.reflector))
MOON_KM, SUN_KM = 384_400.0, 149_597_870.7


def rise(text, ear=STOCK):
    target = Resolver().resolve(text).target
    return expected_rise_db(target, target.look(HERE, NOW), ear)


def test_on_a_twelve_inch_dish_the_moon_is_a_twentieth_of_a_decibel():
    assert rise_words(rise("moon")) in {"0.05 dB", "0.06 dB"}
    narrower = Ear(Beam(5.5, 5.5), 12.45e9, 100.0)
    assert body_rise_db(BODIES["moon"], MOON_KM, narrower) == pytest.approx(0.058, abs=0.005)


def test_the_sun_is_plain_and_the_planets_are_not_there():
    assert 1.0 < rise("sun") < 2.5
    assert rise("sun", ON_TRAVLER) == pytest.approx(6.0, abs=0.3), "the same feed in a narrower beam"
    for planet in ("venus", "jupiter", "mars", "neptune"):
        assert 0.0 < rise(planet) < 0.001
        assert rise_words(rise(planet)) == "under 0.01 dB"


def test_against_measured_sun_noise():
    # 90 cm dish at 11 GHz, 0.65 dB noise figure, flux 153: 7 dB (G4DDK, June 2014). 90 cm: 2.1 degrees.
    assert body_rise_db(BODIES["sun"], SUN_KM, Ear(Beam(2.1, 2.1), 11e9, 90.0)) == pytest.approx(7.0, abs=1.0)


def test_the_rise_follows_beam_and_noise_as_it_must():
    moon = BODIES["moon"]
    # A beam far narrower than the Moon sees nothing else.
    assert body_rise_db(moon, MOON_KM, Ear(Beam(0.01, 0.01), 11e9, 100.0)) == pytest.approx(
        10 * math.log10(3.2), abs=1e-6
    )
    # A far wider one: the ratio of the areas; half the width is four times as much.
    wide, half = (body_rise_db(moon, MOON_KM, Ear(Beam(beam, beam), 11e9, 100.0)) for beam in (20.0, 10.0))
    assert half / wide == pytest.approx(4.0, rel=0.01)
    assert body_rise_db(moon, MOON_KM, Ear(Beam(20.0, 20.0), 11e9, 50.0)) / wide == pytest.approx(2.0, rel=0.01)


def test_the_sun_is_brighter_at_lower_frequencies_and_unknown_beyond_the_table():
    brightness = [quiet_sun_k(ghz * 1e9) for ghz in (0.3, 1.0, 1.7, 3.0, 11.7, 30.0)]
    assert brightness == sorted(brightness, reverse=True)
    assert quiet_sun_k(2e9) == pytest.approx(9e4)
    assert quiet_sun_k(0.01e9) is None
    assert quiet_sun_k(200e9) is None
    assert body_rise_db(BODIES["sun"], SUN_KM, Ear(Beam(6.0, 6.0), 200e9, 100.0)) is None


@pytest.mark.parametrize("text", ["28.2E", "ra=5h34m,dec=+22d", "gal 0,0", "az 180 el 45"])
def test_what_nobody_knows_is_not_told(text):
    assert rise(text) is None
    assert rise_words(None) == "-"


@pytest.mark.parametrize("feed", [FeedProfile(), FeedProfile(beam_deg=6.0), FeedProfile(freq_min_hz=1e9)])
def test_a_feed_without_beam_or_band_promises_nothing(feed):
    assert Ear.of(feed, beam_of(feed, None)) is None
    assert rise("sun", None) is None


def test_the_band_is_taken_in_its_middle_and_the_noise_from_the_settings():
    feed = FeedProfile(beam_deg=20.0, freq_min_hz=1.6e9, freq_max_hz=1.8e9, system_k=70.0)
    beam = beam_of(feed, CARRYOUT_G2.reflector)
    assert Ear.of(feed, beam) == Ear(Beam(20.0, 20.0, 1.7e9), 1.7e9, 70.0)
    assert Ear.of(FeedProfile(freq_max_hz=1.7e9), beam) == Ear(beam, 1.7e9, 100.0)


def test_words():
    assert rise_words(2.04) == "2.0 dB"
    assert rise_words(0.047) == "0.05 dB"
