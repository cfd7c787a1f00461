"""Two known levels: decibels between them, marked beyond them, kept in a file, refused in words."""

from __future__ import annotations

import pytest
from birdcage.base.errors import ConfigError
from birdcage.signal.level_scale import (
    KnownLevel,
    checked_scale,
    find_scale,
    keep_scale,
    load_scales,
    remove_scale,
    why_no_scale,
)
from birdcage.signal.source import Scale, SignalFacts
from birdcage.signal.tuner import TUNER_FACTS

SKY, CARRIER = KnownLevel(401.0, 0.0), KnownLevel(451.0, 12.5)
SDR = SignalFacts("sdr", "sdr", "dB", Scale.LOG, 1.0, 2.0, None, None, 1, 10.0, None, of_dish=False, demo=False)


def made(one=SKY, other=CARRIER, feed="stock-ku"):
    return checked_scale("tuner", feed, one, other)


@pytest.mark.parametrize(("value", "db", "covered"), [
    (401.0, 0.0, True), (451.0, 12.5, True), (421.0, 5.0, True), (461.0, 15.0, False), (391.0, -2.5, False),
])  # fmt: skip
def test_a_straight_line_and_what_lies_beyond_it(value, db, covered):
    for scale in (made(), made(CARRIER, SKY)):
        assert scale.db(value) == pytest.approx(db)
        assert scale.covers(value) is covered


@pytest.mark.parametrize(("one", "other", "words"), [
    (KnownLevel(401.0, 0.0), KnownLevel(401.0, 3.0), "Both levels are 401"),
    (KnownLevel(401.0, 3.0), KnownLevel(445.0, 0.0), "The stronger level, 445, must have more than 3 dB. It has 0"),
    (KnownLevel(401.0, 3.0), KnownLevel(445.0, 3.0), "must have more than 3 dB"),
    (KnownLevel(401.0, 0.0), KnownLevel(445.0, 201.0), "from -200 to 200"),
    (KnownLevel(401.0, 0.0), KnownLevel(445.0, float("nan")), "from -200 to 200"),
    (KnownLevel(float("inf"), 0.0), KnownLevel(445.0, 3.0), "a number as the source tells it"),
    (KnownLevel(float("nan"), 0.0), KnownLevel(445.0, 3.0), "a number as the source tells it"),
])  # fmt: skip
def test_what_makes_no_scale_is_refused_in_words(one, other, words):
    with pytest.raises(ValueError, match=words):
        made(one, other)


def test_it_is_kept_by_source_and_feed_replaced_and_removed(tmp_path):
    path = tmp_path / "levels.toml"
    assert load_scales(path).entries == ()
    keep_scale(path, made())
    keep_scale(path, made(feed="horn"))
    changed = made(other=KnownLevel(461.0, 20.0))
    keep_scale(path, changed)
    found = load_scales(path)
    assert found.problems == ()
    assert find_scale(found.entries, "tuner", "stock-ku") == changed
    assert find_scale(found.entries, "tuner", "horn") == made(feed="horn")
    assert find_scale(found.entries, "rigctl", "horn") is None
    remove_scale(path, changed)
    assert load_scales(path).entries == (made(feed="horn"),)


@pytest.mark.parametrize(("row", "words"), [
    ('source = "tuner"\nfeed = "a"\nlow = 1.0\nlow_db = 0.0\nhigh = 1.0\nhigh_db = 3.0', "Both levels are 1"),
    ('source = "tuner"\nfeed = "a"\nlow = 1.0\nlow_db = 0.0\nhigh = "x"\nhigh_db = 3.0', "high must be a number"),
    ('source = "tuner"\nlow = 1.0\nlow_db = 0.0\nhigh = 2.0\nhigh_db = 3.0', "name their source and feed"),
])  # fmt: skip
def test_a_damaged_file_is_told_and_never_written(tmp_path, row, words):
    path = tmp_path / "levels.toml"
    text = f"[[levels]]\n{row}\n"
    path.write_text(text)
    found = load_scales(path)
    assert found.entries == ()
    assert words in found.problems[0]
    with pytest.raises(ConfigError, match="Nothing was written"):
        keep_scale(path, made())
    assert path.read_text() == text


def test_who_tells_decibels_or_power_needs_none():
    assert why_no_scale(TUNER_FACTS) == ""
    assert why_no_scale(SDR) == "The sdr tells decibels already."
