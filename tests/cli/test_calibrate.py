"""`birdcage calibrate`: objects, peaks, fit, sets, by hand and led."""

from __future__ import annotations

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.calibration.peaks_file import load_peaks, peaks_file
from birdcage.cli.calibrate_words import residual_plot
from birdcage.sky.observer import Observer
from birdcage.sky.targets import Resolver

AT = "2026-03-20T20:30:00Z"
STANDS = Alignment(25.0, -0.4, 0.2, 0.9, -0.6)
OBJECTS = ("61.5W", "72.7W", "91W", "101W", "110W", "119W", "sun")


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    (tmp_path / "birdcage.toml").write_text("[place]\nlatitude_deg = 39.1\nlongitude_deg = -95.7\n")
    return Paths.in_folder(tmp_path)


@pytest.fixture
def calibrate(run, home):
    def calibrate(*words, **more):
        return run("calibrate", *words, **more)

    return calibrate


@pytest.fixture
def peaked(calibrate):
    """Peaks on seven objects, as a dish that stands so would read them."""
    from datetime import datetime

    from birdcage.calibration.candidates import expected

    for name in OBJECTS:
        where = expected(Resolver().resolve(name).target, Observer(39.1, -95.7), datetime.fromisoformat(AT))
        az, el = STANDS.to_dish(*where)
        done = calibrate("add", name, "--dish-az", f"{az:.3f}", "--dish-el", f"{el:.3f}", "--at", AT)
        assert done.exit_code == 0, done.stderr
    return calibrate


def test_next_names_what_is_up_and_in_reach(calibrate, as_json):
    told = as_json(calibrate("next", "--at", AT, "--json"))
    assert told[0]["error_then_deg"] <= told[-1]["error_then_deg"] < told[0]["error_now_deg"]
    assert all(18.0 <= each["elevation_deg"] <= 65.0 for each in told)
    lines = calibrate("next", "--at", AT)
    assert lines.stdout.startswith("OBJECT")
    assert f"Best: {told[0]['target']} at " in lines.stderr


def test_without_a_place_nothing_is_named(run, tmp_path):
    result = run("calibrate", "next", env={"BIRDCAGE_HOME": str(tmp_path)})
    assert result.exit_code == 2
    assert "No place is set" in result.stderr


def test_what_is_peaked_on_is_left_out(peaked, as_json):
    names = [each["target"] for each in as_json(peaked("next", "--at", AT, "--json", "--all"))]
    assert names
    assert not {"Sun", "101°W SES 1"} & set(names)


def test_the_fit_tells_how_the_dish_stands(peaked, as_json, home):
    told = as_json(peaked("fit", "--json"))
    assert told["terms_deg"]["az_offset_deg"] == pytest.approx(25.0, abs=0.4)
    assert told["terms_deg"]["an_deg"] == pytest.approx(0.9, abs=0.15)
    assert told["rms_deg"] < 0.05 < 10.0 < told["rms_before_deg"]
    assert len(told["residuals"]) == 7
    assert 0.0 < told["sky_error_deg"] < 0.5
    shown = peaked("fit", "--save", "Roof").stdout
    assert "axis leans north" in shown
    assert "leaving each out" in shown
    listed = as_json(peaked("list", "--json"))
    assert [each["name"] for each in listed["sets"]] == ["Roof"]
    assert not listed["sets"][0]["in_force"]
    applied = peaked("apply", "roof")
    assert "In force: Roof: az +24." in applied.stderr
    assert "tilt 1." in applied.stderr
    settings = load(home.config_file, {})
    assert settings.alignment.active == "Roof"
    assert as_json(peaked("list", "--json"))["sets"][0]["in_force"]
    assert as_json(peaked("fit", "--json"))["rms_before_deg"] < 0.05
    assert peaked("list").stdout.splitlines()[-1].startswith("*  Roof")


def test_fewer_terms_can_be_asked_for(peaked, as_json):
    assert as_json(peaked("fit", "--terms", 2, "--json"))["fitted"] == ["az_offset_deg", "el_offset_deg"]
    assert peaked("fit", "--terms", 3).exit_code == 2


def test_peaks_are_forgotten_by_number_or_all(peaked, home):
    assert "2 forgotten, 5 left" in peaked("remove", 1, 3).stderr
    assert [each.number for each in load_peaks(peaks_file(home)).entries] == [2, 4, 5, 6, 7]
    assert peaked("remove", 1).exit_code == 1
    assert peaked("remove").exit_code == peaked("remove", 2, "--all").exit_code == 2
    peaked("remove", "--all")
    result = peaked("fit")
    assert result.exit_code == 1
    assert "No peaks yet" in result.stderr


def test_a_set_is_forgotten_and_its_terms_stay(peaked, home):
    peaked("fit", "--save", "Roof")
    peaked("apply", "Roof")
    assert peaked("remove", "--set", "roof").exit_code == 0
    assert load(home.config_file, {}).alignment.an_deg == pytest.approx(0.9, abs=0.15)
    assert "or its saved set is gone" in peaked("list").stderr
    assert peaked("apply", "Roof").exit_code == 2


def test_the_dish_itself_is_asked_where_it_is(calibrate, as_json, pty_dish):
    told = as_json(calibrate("add", "sun", "--json", port=pty_dish.path))
    assert (told["dish_az_deg"], told["dish_el_deg"]) == (0.0, 45.0)
    assert told["target"] == "Sun"
    assert pty_dish.moves() == []


@pytest.mark.parametrize("words", [
    ("sun", "--dish-az", 10), ("sun", "--at", AT), ("nothing-called-so", "--dish-az", 1, "--dish-el", 2), (),
    ("sun", "--dish-az", 10, "--dish-el", 20, "--sigma", 0),
])  # fmt: skip
def test_what_is_no_peak_is_a_usage_error(calibrate, home, words):
    assert calibrate("add", *words).exit_code == 2
    assert load_peaks(peaks_file(home)).entries == ()


def test_an_unhomed_dish_gives_no_peak(calibrate, home):
    result = calibrate("add", "sun", port="sim:g2?unhomed=1")
    assert result.exit_code == 4
    assert "the peak is not taken" in result.stderr
    assert load_peaks(peaks_file(home)).entries == ()


def test_the_plot_shows_each_peak_where_its_object_lay():
    lines = residual_plot([(1, 0.1, 0.0), (2, -0.05, 0.1), (3, 0.0, -0.1)])
    assert lines[0].lstrip().startswith("up 0.1°")
    assert lines[5].endswith("1")
    assert "2" in lines[0]
    assert lines[0].index("2") < lines[5].index("+")
    assert lines[10].strip() == "3"
    assert lines[-1].split() == ["left", "0.1°", "right", "0.1°"]
    assert max(map(len, lines)) < 80
