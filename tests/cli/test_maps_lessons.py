"""`birdcage maps`: the list, and what a map teaches."""

from __future__ import annotations

import pytest
from birdcage.base.config import load
from birdcage.base.config.edit import edit
from birdcage.base.paths import Paths
from birdcage.calibration.peaks_file import load_peaks, peaks_file
from birdcage.sim.settings import SimSettings
from birdcage.skymap.map_file import MapWriter, NewMap

from tests.skymap.arcs import WHOLE, simulated_arc
from tests.skymap.suns import around, simulated
from tests.skymap.test_horizon_lesson import KNOWN, TREES, counts


def keep(sky_map, key="k1", **about):
    """Write a map into the file of this machine, as a station does."""
    new = NewMap(
        key, sky_map.plan, sky_map.source, sky_map.unit, decibels=sky_map.decibels, demo=True,
        about={**sky_map.about, **about},
    )  # fmt: skip
    writer = MapWriter(Paths.default().signal_recordings, new)
    for index, each in enumerate(sky_map.samples):
        writer.add(each, {})
        if index % 200 == 0:
            writer.flush(30.0)
    writer.close(30.0)
    assert writer.problem == ""
    return writer.number


@pytest.fixture(autouse=True)
def _simulated():
    """These settings are of a simulated dish, so that they take what the maps here teach: they are DEMO."""
    edit(Paths.default().config_file, {"dish.port": "sim:g2"})


@pytest.fixture
def trees():
    return keep(counts(TREES), latitude_deg=39.1, longitude_deg=-95.7)


def mask():
    return [(point.az_deg, point.el_deg) for point in load(Paths.default().config_file).place.horizon]


def test_maps_are_listed(run, trees, as_json):
    said = run("maps")
    assert "6171 of 6171" in said.stdout
    assert "DEMO" in said.stdout
    (told,) = as_json(run("maps", "--json"))
    assert (told["number"], told["x_low_deg"], told["heard"]) == (trees, 120.0, 6171)


def test_without_a_map_the_list_says_so(run):
    assert "No map was made yet." in run("maps").stderr


def test_a_horizon_is_proposed_and_nothing_kept(run, trees, as_json):
    told = as_json(run("maps", "horizon", trees, "--json"))
    heights = {point["az_deg"]: point["el_deg"] for point in told["points"] if not point["clear"]}
    assert max(heights.values()) == pytest.approx(30.0, abs=1.0)
    assert told["demo"] is True
    assert "clear down to here" in run("maps", "horizon", trees).stdout
    assert mask() == []


def test_accepted_points_go_into_the_horizon_of_the_place(run, trees, as_json):
    edit(Paths.default().config_file, {"place.horizon": [[20.0, 9.0], [170.0, 3.0]]})
    points = as_json(run("maps", "horizon", trees, "--json"))["points"]
    inside = [point for point in points if 155.0 < point["az_deg"] < 195.0]
    said = run("maps", "horizon", trees, "--accept", ",".join(str(point["az_deg"]) for point in inside))
    assert said.exit_code == 0, said.stderr
    assert "Kept for this place" in said.stderr
    kept = mask()
    assert (20.0, 9.0) in kept
    assert not any(el == 3.0 for _az, el in kept)
    assert all((point["az_deg"], point["el_deg"]) in kept for point in inside)
    assert len(kept) == len(inside) + 3  # the old one, and one on each side
    assert run("maps", "horizon", trees, "--accept", "all").exit_code == 0
    assert len(mask()) >= len(points)


def test_a_wrong_choice_is_refused_and_keeps_nothing(run, trees):
    for typed in ("nothing", "12", "all,160", "nan", "inf"):
        said = run("maps", "horizon", trees, "--accept", typed)
        assert said.exit_code == 2, said.stdout
    assert mask() == []
    assert "There is no map 7." in run("maps", "horizon", 7).stderr


def test_a_map_without_trees_says_so(run):
    number = keep(counts(""), latitude_deg=39.1, longitude_deg=-95.7)
    said = run("maps", "horizon", number)
    assert said.exit_code == 1
    assert "No trees stand out" in said.stderr


def test_the_beam_of_the_settings_counts_for_a_map_that_tells_none(run):
    number = keep(counts(TREES), beam_az_deg=None)
    assert "No place is known" in run("maps", "horizon", number).stderr
    assert KNOWN["beam_az_deg"] == 6.4


@pytest.fixture
def sun():
    return keep(simulated(SimSettings, around(12.0, 12.0, 1.5)), "sun")


def test_the_beam_is_told_and_kept_only_when_asked(run, sun, as_json):
    told = as_json(run("maps", "beam", sun, "--json"))
    assert told["beam_az_deg"] == pytest.approx(5.7, rel=0.03)
    assert told["system_span_k"][0] < told["system_k"] < told["system_span_k"][1]
    assert told["demo"] is True
    feed = load(Paths.default().config_file).active_feed
    assert (feed.beam_az_deg, feed.system_k) == (None, 100.0)
    said = run("maps", "beam", sun)
    assert "DEMO" in said.stderr
    assert "For a quiet Sun of 8934 K at 12.45 GHz" in said.stdout
    said = run("maps", "beam", sun, "--keep")
    assert "Kept with the feed stock-ku: beam 5.8° x 5.7°, system temperature 78 K." in said.stderr
    feed = load(Paths.default().config_file).active_feed
    assert (feed.beam_az_deg, feed.beam_origin) == (round(told["beam_az_deg"], 2), "scan")
    assert feed.system_k == pytest.approx(told["system_k"])
    assert feed.freq_min_hz == 12.2e9


def test_the_beam_is_kept_for_the_middle_of_the_feeds_band(run, as_json):
    edit(Paths.default().config_file, {"feed.mine.freq_min_hz": 10.7e9, "feed.mine.freq_max_hz": 11.7e9})
    number = keep(simulated(SimSettings, around(12.0, 12.0, 1.5)), feed="mine")
    told = as_json(run("maps", "beam", number, "--json", "--keep"))
    kept = load(Paths.default().config_file).feeds["mine"]
    assert kept.beam_az_deg == pytest.approx(told["beam_az_deg"] * 12.45 / 11.2, abs=0.01)


def test_a_beam_of_an_unknown_feed_or_of_a_few_noisy_directions_is_not_kept(run):
    gone = keep(simulated(SimSettings, around(12.0, 12.0, 1.5)), "k2", feed="gone")
    said = run("maps", "beam", gone, "--keep")
    assert (said.exit_code, "the feed gone" in said.stderr) == (2, True)
    noisy = keep(simulated(SimSettings, around(12.0, 12.0, 2.0), noise_db=0.25), "k3")
    said = run("maps", "beam", noisy, "--keep")
    assert (said.exit_code, "at most 10 % is kept" in said.stderr) == (2, True)
    assert load(Paths.default().config_file).active_feed.beam_az_deg is None


def test_counts_need_two_known_levels(run):
    number = keep(counts(""))
    said = run("maps", "beam", number)
    assert said.exit_code == 1
    assert "counts are no power" in said.stderr


def test_north_and_tilt_are_proposed_and_handed_to_calibrate(run, as_json):
    number = keep(simulated_arc(7.0, 1.2, -1.6))
    told = as_json(run("maps", "north", number, "--within", 20, "--json"))
    assert told["az_offset_deg"] == pytest.approx(7.0, abs=0.2)
    assert (told["an_deg"], told["aw_deg"]) == (pytest.approx(1.2, abs=0.2), pytest.approx(1.6, abs=0.2))
    assert load_peaks(peaks_file(Paths.default())).entries == ()
    edit(Paths.default().config_file, {"place.latitude_deg": 39.1, "place.longitude_deg": -95.7})
    said = run("maps", "north", number, "--within", 20, "--calibrate")
    assert "North  azimuth offset +7." in said.stdout
    assert f"Kept {len(told['slots'])} peaks for the calibration, 1 to {len(told['slots'])}" in said.stderr
    peaks = load_peaks(peaks_file(Paths.default())).entries
    assert [(peak.found, round(peak.dish_az_deg, 3)) for peak in peaks] == [
        ("rssi", slot["dish_az_deg"]) for slot in told["slots"]
    ]
    assert run("calibrate", "fit").exit_code == 0


def test_a_map_that_does_not_tell_north_says_why_and_keeps_nothing(run):
    number = keep(simulated_arc(7.0, 1.2, -1.6, WHOLE), latitude_deg=None)
    assert "does not tell where it was made" in run("maps", "north", number).stderr
    sun_map = keep(simulated(SimSettings, around(12.0, 12.0, 3.0)), "k2")
    said = run("maps", "north", sun_map, "--calibrate")
    assert (said.exit_code, "around Sun" in said.stderr) == (1, True)
    assert load_peaks(peaks_file(Paths.default())).entries == ()


@pytest.mark.parametrize("port", [None, "/dev/ttyUSB0"])
def test_what_a_simulated_sky_teaches_stays_out_of_the_settings_of_another_dish(run, trees, sun, port, monkeypatch):
    file = Paths.default().config_file
    edit(file, {"dish.port": port})
    monkeypatch.setenv("BIRDCAGE_PORT", "sim:g2")
    before = file.read_bytes()
    arc = keep(simulated_arc(7.0, 1.2, -1.6), "k3")
    for asked in (("horizon", trees, "--accept", "all"), ("beam", sun, "--keep"),
                  ("north", arc, "--within", 20, "--calibrate")):  # fmt: skip
        said = run("maps", *asked)
        assert said.exit_code == 2
        assert "DEMO map: nothing is kept, as birdcage.toml has no simulated port." in said.stderr
        assert said.stdout.strip(), "what was found is told all the same"
    assert file.read_bytes() == before
    assert load_peaks(peaks_file(Paths.default())).entries == ()
