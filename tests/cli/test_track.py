"""`birdcage track` as a person and a script meet it: planned without a dish, followed with one."""

from __future__ import annotations

import json
import signal
import time
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer

PLACE = ("--lat", 50, "--lon", 10)
FIXED = ("az", 20, "el", 45)


def after(seconds):
    return (datetime.now(UTC) + timedelta(seconds=seconds)).isoformat()


def events(result):
    return [json.loads(line) for line in result.stdout.splitlines()]


def test_the_plan_is_printed_and_nothing_is_opened(run):
    result = run("track", *FIXED, *PLACE, port="/no/such/port")
    assert result.exit_code == 0, result.stderr
    assert "azimuth         20.000 °" in result.stdout
    assert "Leave " in result.stdout
    assert "--engage follows it" in result.stderr
    only = run("track", *FIXED, *PLACE, "--plan", port="/no/such/port")
    assert only.exit_code == 0
    assert only.stdout.startswith("az 20.00° el 45.00°")
    assert "Leave " in only.stdout
    assert "azimuth  " not in only.stdout


def test_the_plan_in_json_is_one_value(run, as_json):
    plan = as_json(run("track", *FIXED, *PLACE, "--plan", "--json"))
    assert plan["target"]["name"] == "az 20.00° el 45.00°"


@pytest.mark.parametrize(("words", "said"), [
    (("--plan", "--engage"), "--plan moves nothing"),
    (("--until", "reach"), "go with --engage"),
    (("--controller", "fast"), "go with --engage"),
    (("--engage", "--until", "noon"), "is not a time"),
    (("--engage", "--controller", "best"), "'best' is not one of"),
    (("--engage", "--speed", 20, "--port", "/dev/ttyUSB0"), "--speed is for a simulated dish"),
    (("--time-offset", 9999), "9999"),
    (("--nonsense",), "No such option"),
])  # fmt: skip
def test_what_does_not_go_together_is_a_usage_error(run, words, said):
    result = run("track", *FIXED, *PLACE, *words)
    assert result.exit_code == 2
    assert said in result.stderr


def test_without_a_place_or_a_dish_it_says_what_to_give(run):
    assert "--lat and --lon" in run("track", *FIXED).stderr
    no_dish = run("track", *FIXED, *PLACE, firmware="")
    assert no_dish.exit_code == 2
    assert "A plan needs to know the dish" in no_dish.stderr
    assert "No target is called" in run("track", "no", "such", "thing", *PLACE).stderr


def test_it_follows_until_the_time_and_tells_each_step(run):
    result = run("track", *FIXED, *PLACE, "--engage", "--until", after(9.0), "--json")
    assert result.exit_code == 0, result.stderr
    told = events(result)
    phases = [each["phase"] for each in told if each["event"] == "phase"]
    assert phases[-2:] == ["following", "over"]
    assert told[0]["event"] == "plan"
    samples = [each for each in told if each["event"] == "sample"]
    assert samples[-1]["error_deg"] < 0.1
    assert samples[-1]["reported_elevation_deg"] == pytest.approx(45.0, abs=0.1)
    assert told[-1]["event"] == "end"
    assert told[-1]["max_error_deg"] >= told[-1]["rms_error_deg"]
    assert "RMS" in result.stderr


def omm(elements):
    return {
        "OBJECT_NAME": elements.name, "NORAD_CAT_ID": elements.norad_id, "EPOCH": elements.epoch.isoformat()[:26],
        "MEAN_MOTION": elements.mean_motion_rev_day, "ECCENTRICITY": elements.eccentricity,
        "INCLINATION": elements.inclination_deg, "RA_OF_ASC_NODE": elements.raan_deg,
        "ARG_OF_PERICENTER": elements.argument_of_perigee_deg, "MEAN_ANOMALY": elements.mean_anomaly_deg,
        "BSTAR": 0, "MEAN_MOTION_DOT": 0, "MEAN_MOTION_DDOT": 0,
    }  # fmt: skip


def test_a_pass_is_followed_to_its_end_at_the_speed_of_a_simulated_dish(run, tmp_path):
    # It is highest in 17 minutes, ten seconds of a real clock, of which the dish takes five to come up.
    orbit = demo_orbits(datetime.now(UTC), Observer(50.0, 10.0))[3]
    (tmp_path / "demo.json").write_text(json.dumps([omm(orbit)]))
    (tmp_path / "high.toml").write_text("[motion]\nmin_elevation_deg = 45\n")
    result = run(
        "track", "LEO 4", *PLACE, "--engage", "--until", "reach", "--speed", 100, "--json",
        "--elements", tmp_path / "demo.json", "--config", tmp_path / "high.toml",
    )  # fmt: skip
    assert result.exit_code == 0, result.stderr
    # A tenth of a second that this machine is late counts as ten seconds of the pass.
    assert events(result)[-1]["rms_error_deg"] < 10.0
    phases = [each["phase"] for each in events(result) if each["event"] == "phase"]
    assert "following" in phases


def test_the_plan_of_a_travler_counts_in_its_own_beam_until_settings_say_another(run, as_json, tmp_path):
    (tmp_path / "demo.json").write_text(json.dumps([omm(demo_orbits(datetime.now(UTC), Observer(50.0, 10.0))[3])]))
    (tmp_path / "before.toml").write_text("[feed.stock-ku]\nbeam_deg = 6.3\n")

    def mean_db(*more):
        words = ("track", "LEO 4", *PLACE, "--plan", "--json", "--elements", tmp_path / "demo.json", *more)
        plan = as_json(run(*words, firmware="hal205"))
        return plan["forecast"]["mean_loss_db"], plan["forecast"]["rms_error_deg"]

    (narrow_db, error_deg), (wide_db, same_deg) = mean_db(), mean_db("--config", tmp_path / "before.toml")
    assert error_deg == pytest.approx(same_deg, rel=0.1)
    assert 12.0 * (error_deg / 2.885) ** 2 < narrow_db < 12.0 * (error_deg / 2.011) ** 2
    assert wide_db == pytest.approx(12.0 * (same_deg / 6.3) ** 2, abs=1e-4)


def test_a_dish_that_does_not_know_where_it_is_follows_nothing(run):
    result = run("track", *FIXED, *PLACE, "--engage", port="sim:g2?unhomed=1")
    assert (result.exit_code, result.stdout) == (4, "")
    assert "`birdcage home` homes it" in result.stderr


def test_what_cannot_be_reached_is_refused_and_nothing_is_sent(run, pty_dish):
    result = run("track", "az", 20, "el", 5, *PLACE, "--engage", port=pty_dish.path)
    assert (result.exit_code, result.stdout) == (4, "")
    assert result.stderr.strip()
    assert pty_dish.moves() == []


def test_ctrl_c_stops_it_first_and_says_where_the_dish_is(start, pty_dish):
    process = start(
        "track", *FIXED, *PLACE, "--engage", "--json", "--port", pty_dish.path, "--firmware", "g2",
    )  # fmt: skip
    pty_dish.wait_for(lambda truth: bool(pty_dish.moves()), 20.0)
    pressed = time.monotonic()
    process.send_signal(signal.SIGINT)
    out, error = process.communicate(timeout=60)
    assert process.returncode == 130, error
    assert time.monotonic() - pressed < 10.0
    assert "The dish was last seen at" in error
    assert json.loads(out.splitlines()[0])["event"] == "plan"
    assert not pty_dish.device.truth().moving
