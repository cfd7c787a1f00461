"""`birdcage facts`: every fact of a dish with its unit and its origin; and [dish.facts] in `birdcage config`."""

from __future__ import annotations

import pytest


@pytest.fixture
def said_by_owner(tmp_path):
    path = tmp_path / "birdcage.toml"

    def write(text):
        path.write_text(f'[dish]\nfirmware = "g2"\n[dish.facts]\n{text}\n')
        return ("--config", str(path))

    return write


def row(text, name):
    (found,) = [line.split() for line in text.splitlines() if line.split()[0] == name]
    return found[1:]


def test_each_fact_has_its_value_its_unit_and_who_says_so(run, pty_dish, said_by_owner):
    run("gear", "--play-az", "0.05", port=pty_dish.path)
    said = run("facts", *said_by_owner("elevation.speed_deg_s = 30"), port=pty_dish.path)
    assert said.exit_code == 0, said.stderr
    assert row(said.stdout, "elevation.max_deg") == ["65", "deg", "documented"]
    assert row(said.stdout, "elevation.speed_deg_s") == ["30", "deg/s", "user"]
    assert row(said.stdout, "azimuth.overshoot_deg") == ["0.06", "deg", "measured"]
    assert row(said.stdout, "second_same") == ["unknown", "inferred"]
    assert row(said.stdout, "azimuth.play_deg")[:3] == ["0.05", "deg", "user"]
    assert row(said.stdout, "elevation.play_deg") == ["-", "deg", "-"]
    assert pty_dish.moves() == []


def test_as_json_it_has_what_is_known_of_a_learnt_fact_too(run, as_json, pty_dish):
    run("gear", "--play-el", "0.04", port=pty_dish.path)
    told = as_json(run("facts", "--json", port=pty_dish.path))
    assert told["firmware"] == "g2"
    assert told["facts"]["boot_s"] == {"value": 180.0, "unit": "s", "origin": "inferred"}
    play = told["facts"]["elevation.play_deg"]
    assert (play["value"], play["origin"], play["readings"]) == (0.04, "user", 0)
    assert play["since"].startswith("20")
    told = as_json(run("facts", "--forget", "--json", port=pty_dish.path))
    assert told["facts"]["elevation.play_deg"] == {"value": None, "unit": "deg", "origin": None}


def test_facts_of_a_kind_of_dish_need_no_adapter_and_no_port(run, as_json):
    told = as_json(run("facts", "--json", port="sim:g2", firmware="hal205"))
    assert told["facts"]["second_same"] == {"value": "queue", "unit": None, "origin": "documented"}
    assert "No adapter at sim:g2" in run("facts", "--forget", port="sim:g2").stderr
    assert "Name the firmware" in run("facts", port="sim:g2", firmware="").stderr


def test_config_shows_and_checks_what_the_owner_says(run, as_json, said_by_owner):
    shown = as_json(run("config", "show", "--json", *said_by_owner("azimuth.speed_deg_s = 30")))
    assert shown["dish.facts.azimuth.speed_deg_s"] == {"value": 30.0, "source": "file"}
    assert shown["dish.facts.second_same"] == {"value": None, "source": "default"}
    checked = run("config", "check", *said_by_owner("elevation.max_deg = 90"), firmware="g2")
    assert checked.exit_code != 0
    assert "dish.facts.elevation.max_deg is 90, 25 deg beyond the Carryout G2's own limit of 65 deg" in checked.stderr
    assert "Nothing moves until that is fixed." in checked.stderr


def test_ready_says_that_such_a_fact_must_be_mended(run, said_by_owner):
    said = run("ready", *said_by_owner("elevation.max_deg = 90"))
    (line,) = [line for line in said.stdout.splitlines() if "dish.facts.elevation.max_deg is 90" in line]
    assert "✗" in line
    assert said.exit_code == 1
