"""Range, Doppler, Sun and clock of the chosen pass."""

import re
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path as File

import pytest
import sky_stand_in
from birdcage.base.beam import Beam
from birdcage.base.config import FeedProfile
from birdcage.base.geometry import separation
from birdcage.sky.sun_crossing import SunApproach
from birdcage_tui.feeds.sky_hearing import hearing_of, tuning_of
from birdcage_tui.passes.figures import signal_lines, sun_lines
from birdcage_tui.shown.sky_picture import DopplerFrequency
from stage import read, run
from stand_in import text_of

THEN = datetime(2026, 11, 22, tzinfo=UTC)


def on_page(test, size):
    return run(test, "idle", size, key="f7", sky=sky_stand_in.make())


async def pressed(app, pilot, *keys):
    for key in keys:
        await pilot.press(key)
        await pilot.pause()
    app.paint()
    await pilot.pause()
    return text_of(app)


@pytest.mark.parametrize(("size", "keys"), [((80, 24), ("v", "v")), ((120, 36), ("v",)), ((160, 48), ("v",))], ids=str)
def test_range_doppler_sun_and_clock_stand_behind_a_key(size, keys):
    async def look(app, pilot):
        return await pressed(app, pilot, *keys)

    text = on_page(look, size)
    assert "Figures  Doppler at 137.9 MHz, its LRPT" in text
    assert re.search(r"AOS +11:56:00 +341\.0° +2891 km +\+2\.91 kHz", text), text
    assert re.search(r"TCA +12:03:00 +\S+° +820 km +\+0\.00 kHz", text)
    assert re.search(r"now +12:00:00 +\S+° +1444 km", text)
    assert re.search(r"1 s of clock error costs 0\.\d+°", text)
    assert "Sun-lit, Sun 31° off at 11:58" in text
    assert "LRPT, RHCP, 72 kbaud  SatDump meteor_m2-x_lrpt " in text
    assert "on 2026-10-16" in text


def test_a_large_screen_has_the_figures_beside_the_path():
    text = on_page(read, (160, 48))
    for event, range_km in (("AOS", 2891), ("TCA", 820), ("LOS", 2891)):
        assert re.search(rf"{event}  \S+ +\S+° +{range_km} km", text), text
    assert re.search(r"Doppler \+2\.91 to -2\.91 kHz", text), text
    for words in ("at 137.9 MHz", "Sun 31° off at 11:58"):
        assert words in text


def test_the_largest_screen_has_range_and_doppler_behind_each_event_and_says_no_word_twice():
    rows = tuple(
        replace(
            row,
            tuned=lambda: DopplerFrequency(12.22e9, "its carrier", ("carrier", "on the air")),
            hears="12220 MHz carrier",
        )
        for row in sky_stand_in.rows()
    )
    text = run(read, "idle", (240, 70), key="f7", sky=sky_stand_in.make(rows=rows))
    assert re.search(r"AOS  11:56:00  341\.0°  2891 km +\+25\d\.\d kHz", text), text
    assert re.search(r"LOS  12:10:00  158\.0°  2891 km +-25\d\.\d kHz", text)
    assert "Doppler at 12220 MHz " in text
    assert text.count("carrier") == 1
    assert "on the air" in text


def test_the_list_of_the_largest_screen_has_times_and_places_of_rise_and_set():
    text = run(read, "idle", (240, 70), key="f7", sky=sky_stand_in.make())
    assert re.search(r"METEOR-M2 4 .*◍ ceiling +11:56 341° 12:10 158°", text), text
    assert re.search(r"NOAA 20 \(JPSS-1\) .*● +12:03  22° 12:16 201°", text)


def test_without_a_downlink_doppler_is_told_per_100_mhz():
    async def look(app, pilot):
        return await pressed(app, pilot, "v", "down", "down")

    assert "Doppler at 100 MHz, no downlink known" in on_page(look, (120, 36))


def test_the_sun_in_the_beam_is_a_warning():
    row = sky_stand_in.changed(sky_stand_in.rows()[0], sun=SunApproach(sky_stand_in.utc(sky_stand_in.NOON), 3.0))
    assert sun_lines(row, Beam(6.3, 6.3))[-1] == ("warn", "▲ Sun in the beam 12:00:00")
    assert sun_lines(row, Beam(2.0, 2.9))[-1] == ("text", "Sun 3° off at 12:00")
    night = sky_stand_in.changed(row, sun=None, sunlit_share=0.4)
    assert sun_lines(night, Beam(6.3, 6.3)) == [("text", "Sun-lit 40% of it, Sun down")]


def test_range_between_samples_is_that_of_a_smooth_path():
    path = sky_stand_in.rows()[0].path
    for at_s in (path.t_s[0], path.t_s[40] + 3.1, path.t_s[60] + 1.0, path.t_s[-1]):
        share = (at_s - path.t_s[0]) / 840.0 - 0.5
        range_km = (820.0**2 + (6.6 * 840.0 * share) ** 2) ** 0.5
        found = path.distance(at_s)
        assert found[0] == pytest.approx(range_km, abs=0.01)
        assert found[1] == pytest.approx(6.6**2 * 840.0 * share / range_km, abs=0.005)
    assert path.distance(path.t_s[0] - 1.0) is None
    assert replace(path, range_km=(), rate_km_s=()).distance(path.t_s[5]) is None, "unknown is no number"


def test_the_fastest_part_of_a_pass_is_found():
    path = sky_stand_in.rows()[0].path
    slow = separation(path.az_deg[0], path.el_deg[0], path.az_deg[1], path.el_deg[1]) / 7.0
    assert path.fastest_deg_s() > 2 * slow


def test_doppler_is_told_where_the_satellite_sends_else_for_the_feed():
    none = File("does not exist")
    ku = FeedProfile(freq_min_hz=10.7e9, freq_max_hz=12.7e9)
    meteor = tuning_of(ku, none, THEN)(59051, "METEOR-M2 4")
    assert meteor.hz != 11.7e9
    assert meteor.what.startswith("its ")
    unknown = tuning_of(ku, none, THEN)(1, "NOBODY KNOWS IT")
    assert (unknown.hz, unknown.what) == (11.7e9, "middle of feed")
    assert tuning_of(FeedProfile(), none, THEN)(1, "NOBODY KNOWS IT") is None
    vhf = tuning_of(FeedProfile(freq_min_hz=136e6, freq_max_hz=138e6), none, THEN)(59051, "METEOR-M2 4")
    assert 136e6 < vhf.hz < 138e6, "of several the one that this feed hears"
    assert vhf.signal == ("LRPT, RHCP, 72 kbaud", "SatDump meteor_m2-x_lrpt", "on 2026-10-16")


def test_a_doubtful_downlink_is_marked_and_says_how_old_what_is_known_of_it_is():
    dish = FeedProfile(freq_min_hz=12.2e9, freq_max_hz=12.7e9, polarization="circular")
    assert hearing_of(dish, File("does not exist"), THEN)(0, "EchoStar 10") == "12442.5 MHz DISH ?"
    bell = tuning_of(dish, File("does not exist"), THEN)(0, "EchoStar 10")
    assert bell.signal == ("DISH, circular", "doubtful: 2019-09-25, 7 y")
    row = replace(sky_stand_in.rows()[0], tuned=lambda: bell)
    assert signal_lines(row)[-1] == ("warn", "doubtful: 2019-09-25, 7 y")
