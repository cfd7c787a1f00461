"""Names that amateurs type, in every command that takes one: the same reader, the same sentences."""

from __future__ import annotations

import re
from datetime import UTC, datetime

import pytest
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.elements import ElementSet

HERE = "[place]\nlatitude_deg = 39.1\nlongitude_deg = -95.7\n"
AT = ("--at", "2026-11-21T18:00:00Z")


def orbit(name, norad_id, mean_motion=15.5):
    epoch = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
    return ElementSet(name, norad_id, epoch, 51.6, 10.0, 0.001, 20.0, 30.0, mean_motion)


LIST = (
    orbit("ISS (ZARYA)", 25544), orbit("ISS (NAUKA)", 49044), orbit("METEOR-M2 3", 57166),
    orbit("RADFXSAT (FOX-1B)", 43017), orbit("FUNCUBE-1 (AO-73)", 39444), orbit("NOAA 19", 33591),
)  # fmt: skip
SILENT = "NOAA 19 has been silent since 2025-08-13"
ABSENT = "AO-7 (7530) is not among your 6 satellites. `birdcage elements update`"


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    (tmp_path / "birdcage.toml").write_text(HERE)
    with Catalogue(Paths.in_folder(tmp_path).catalogue) as catalogue:
        catalogue.add(LIST)
    return Paths.in_folder(tmp_path)


def said(result):
    return " ".join(f"{result.stdout} {result.stderr}".split())


WHERE, PASSES, FAVOURITE = ("where", *AT), ("passes", "--start", "2026-11-21T18:00:00Z"), ("elements", "favourite")
PEAK = ("calibrate", "add", "--dish-az", "180", "--dish-el", "40", *AT)


@pytest.mark.parametrize(
    ("words", "typed", "told"),
    [
        (WHERE, "iss", "ISS (ZARYA) (25544)"),
        (WHERE, "ao-91", "RADFXSAT (FOX-1B) (43017)"),
        (WHERE, "METEOR-M N2-3", "METEOR-M2 3 (57166)"),
        (WHERE, "noaa 19", SILENT),
        (WHERE, "28.2 east", "28.2°E Astra 28 is"),
        (WHERE, "E28.2", "never rises here."),
        (WHERE, "dish 119", "119°W EchoStar 14"),
        (WHERE, "polaris", "Polaris"),
        (WHERE, "cas a", "Cas A"),
        (WHERE, "180,45", "az 180.00° el 45.00°"),
        (("track", "--plan"), "s 40", "az 180.00° el 40.00°"),
        (("track", "--plan"), "w110", "110°W EchoStar 10"),
        (PASSES, "iss", "ISS (ZARYA)"),
        (PASSES, "AO-91", "RADFXSAT (FOX-1B)"),
        (PASSES, "noaa 19", SILENT),
        ((*PASSES, "--name"), "ao-91", "RADFXSAT (FOX-1B)"),
        ((*PASSES, "--name"), "noaa 19", SILENT),
        (("if", "--lo", "9750M"), "qo-100", "IF 739.75 MHz"),
        (("if", "--lo", "1G"), "METEOR-M N2-3", "RF 137.9 MHz"),
        (("if", "--lo", "1G"), "noaa 18", "NOAA 18 has been silent since 2025-06-06"),
        (("downlinks", "--all"), "meteor-m n2-3", "METEOR-M2 3 137.9"),
        (("downlinks", "--all"), "25544", "ISS 145.8"),
        (("downlinks", "--all"), "dish 61", "EchoStar 16"),
        (FAVOURITE, "fox-1b", "* 43017 RADFXSAT (FOX-1B)"),
        (FAVOURITE, "noaa 19", SILENT),
        (("elements", "offset"), "ao-91", "RADFXSAT (FOX-1B): no time offset."),
        (("elements", "search"), "ao-91", "43017 RADFXSAT (FOX-1B)"),
        (PEAK, "dish 119", "119°W EchoStar 14 at 214.35°"),
        (PEAK, "cyg a", "Cyg A at"),
    ],
)
def test_what_is_meant(run, words, typed, told):
    result = run(*words, *((typed,) if words[0] == "elements" or words[-1] == "--name" else typed.split()))
    assert result.exit_code == 0, result.stderr
    assert told in said(result)


@pytest.mark.parametrize("typed", ["ao-7", "polairs", "isss", "E 40", "noaa 18"])
@pytest.mark.parametrize(
    "words", [WHERE, ("track", "--plan"), PASSES, ("move",), FAVOURITE, ("elements", "remove"), PEAK],
    ids=["where", "track", "passes", "move", "favourite", "remove", "calibrate"],
)  # fmt: skip
def test_every_command_says_the_same_of_what_it_does_not_find(run, words, typed):
    told = {
        "ao-7": ABSENT,
        "polairs": "No target is called 'polairs'. Did you mean Polaris?",
        "isss": "No target is called 'isss'. Did you mean ISS",
        "E 40": "type az 90 el 40, or 40E.",
        "noaa 18": "NOAA 18 has been silent since 2025-06-06 (source: NOAA, scijinks.gov). It is not among your 6",
    }[typed]
    result = run(*words, *((typed,) if words[0] == "elements" else typed.split()))
    assert result.exit_code != 0
    assert told in said(result)


def test_move_goes_where_a_target_stands(run, pty_dish):
    result = run("move", "dish", "119", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert "119°W EchoStar 14: AZ 214.35°" in result.stderr
    assert "° now, radio refraction included." in result.stderr
    assert "Skew" not in result.stderr, "it is circular"
    assert pty_dish.device.truth().az_deg % 360.0 == pytest.approx(214.35, abs=0.1)


def test_move_tells_the_skew_of_a_linear_slot(run, pty_dish):
    result = run("move", "95W", port=pty_dish.path)
    assert re.search(r"Skew [-+]\d\.\d° geometry, slot's own unknown, clockwise from behind the dish\.", result.stderr)


@pytest.mark.parametrize(
    ("typed", "told"),
    [
        ("28.2E", "never rises here. Nothing moves. `birdcage track 28.2E` shows what is to come."),
        ("canopus", "below the horizon"),
    ],
)
def test_move_refuses_what_is_below_the_horizon(run, typed, told):
    result = run("move", typed, port="/no/such/port")
    assert (result.exit_code, result.stdout) == (4, "")
    assert told in said(result)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ((), "Give --az and --el, or name a target"),
        (("moon", "--az", 3), "not both"),
        (("--az", 3), "Give --az and --el"),
    ],
)
def test_move_takes_a_target_or_both_angles(run, words, told):
    result = run("move", *words)
    assert result.exit_code == 2
    assert told in said(result)


def test_autotrack_leaves_out_what_is_silent_and_says_so(run, home, as_json):
    with Catalogue(home.catalogue) as catalogue:
        catalogue.set_favourite(33591)
        catalogue.set_favourite(25544)
    told = as_json(run("autotrack", "--start", "2026-11-21T18:00:00Z", "--json"))
    kept = {row["name"]: row["kept"] for row in told["passes"]}
    whys = {row["why"] for row in told["passes"] if row["name"] == "NOAA 19"}
    assert kept["ISS (ZARYA)"] is True
    assert whys == {"silent since 2025-08-13"}
