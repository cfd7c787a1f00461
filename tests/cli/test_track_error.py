"""What error `birdcage track` promises: of dish and elements together, at every age of the elements."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.frozen import frozen
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import satrec

HERE = ("--lat", 50, "--lon", 10)
METOP = next(each for each in frozen() if each.norad_id == 38771)
ISS = next(each for each in frozen() if each.norad_id == 25544)


def omm(elements, days):
    epoch = datetime.now(UTC) - timedelta(days=days)
    return {
        "OBJECT_NAME": elements.name, "NORAD_CAT_ID": elements.norad_id, "EPOCH": epoch.isoformat()[:26],
        "MEAN_MOTION": elements.mean_motion_rev_day, "ECCENTRICITY": elements.eccentricity,
        "INCLINATION": elements.inclination_deg, "RA_OF_ASC_NODE": elements.raan_deg,
        "ARG_OF_PERICENTER": elements.argument_of_perigee_deg, "MEAN_ANOMALY": elements.mean_anomaly_deg,
        "BSTAR": elements.bstar, "MEAN_MOTION_DOT": elements.mean_motion_dot, "MEAN_MOTION_DDOT": 0,
    }  # fmt: skip


@pytest.fixture
def plan(run, tmp_path):
    """`birdcage track --plan` of a satellite by elements that old."""

    def plan(elements, days, *words):
        file = tmp_path / "aged.json"
        file.write_text(json.dumps([omm(elements, days)]))
        result = run("track", elements.norad_id, *HERE, "--plan", "--elements", file, *words)
        assert result.exit_code == 0, result.stderr
        return result.stdout

    return plan


def test_of_elements_3228_days_old_no_error_and_no_decibels_are_promised(plan):
    text = plan(METOP, 3228)
    assert "Error    unknown" in text
    assert "✗ useless elements, 3228 d old, figures end at 7 d" in text
    assert "`birdcage elements" in text
    assert " dB" not in text
    told = json.loads(plan(METOP, 3228, "--json"))
    assert told["forecast"]["rms_error_deg"] is told["forecast"]["mean_loss_db"] is None
    assert told["forecast"]["unknown_because"] == "figures end at 7 d"
    assert "birdcage elements update" in told["forecast"]["advice"]
    assert (told["elements"]["elements_grade"], told["elements"]["age_s"] // 86400) == ("useless", 3228)
    assert told["dish_forecast"]["rms_error_deg"] < 1.0


def test_of_three_days_the_number_is_that_of_the_elements_and_names_the_remedy(plan):
    text = plan(ISS, 3)
    median, p90 = map(float, re.search(r"Error {4}±([\d.]+)° \(90 %: ([\d.]+)°\)", text).groups())
    told = json.loads(plan(ISS, 3, "--json"))
    assert 0.4 < median < p90
    assert told["forecast"]["rms_error_deg"] == pytest.approx(median, rel=0.1)
    assert told["forecast"]["rms_error_deg"] ** 2 > told["dish_forecast"]["rms_error_deg"] ** 2 + 0.3**2
    assert told["forecast"]["rms_error_p90_deg"] == pytest.approx(p90, rel=0.1)
    assert re.search(r"[○◐✗] (usable|doubtful|useless) elements, 3(\.\d)? d old: `birdcage", text)
    assert "`birdcage elements update` gets newer ones" in " ".join(text.split())
    worst = max(row["expected_error_deg"] or 0.0 for row in told["path"])
    assert worst >= told["forecast"]["rms_error_deg"]


def test_fresh_elements_are_graded_and_need_no_remedy(plan):
    text = plan(METOP, 0.1)
    assert re.search(r"Error {4}±0\.\d+° \(90 %: 0\.\d+°\)", text)
    assert "● fresh elements" in text
    assert "birdcage elements update" not in text


def test_what_has_re_entered_by_its_own_elements_says_so_and_what_to_do(plan, run, tmp_path):
    text = " ".join(plan(ISS, 2000).split())
    assert "by its elements it re-entered about" in text
    assert "`birdcage elements update` shows whether it still flies" in text
    listed = run("passes", *HERE, "--elements", tmp_path / "aged.json", "--hours", 48)
    assert "✗ re-entered?" in listed.stdout
    assert "By their own elements these have re-entered, unless they were boosted: ISS (ZARYA)." in listed.stderr
    planned = run("autotrack", *HERE, "--elements", tmp_path / "aged.json")
    assert "By their own elements these have re-entered" in planned.stderr
    where = run("where", "25544", *HERE, "--elements", tmp_path / "aged.json").stdout
    assert "by its elements it re-entered about" in where
    assert "✗ re-entered?" in run("elements", "check", tmp_path / "aged.json").stdout


def laid_back(elements, days):
    """The same orbit by elements that much older: SGP4's own drift of node, perigee and anomaly taken back."""
    old = replace(elements, epoch=elements.epoch - timedelta(days=days))
    record = satrec(old)
    record.sgp4_tsince(days * 1440.0)
    node, perigee, anomaly = (math.degrees(each) for each in (record.Om, record.om, record.mm))
    turned = (old.argument_of_perigee_deg - perigee) + (old.mean_anomaly_deg - anomaly)
    return replace(
        old, raan_deg=(2.0 * old.raan_deg - node) % 360.0, mean_anomaly_deg=(old.mean_anomaly_deg + turned) % 360.0
    )  # fmt: skip


def test_engage_promises_no_more_than_the_plan_before_while_and_after_it_follows(run, tmp_path):
    # It is highest in 17 minutes, ten seconds of a real clock, of which the dish takes five to come up.
    orbit = laid_back(demo_orbits(datetime.now(UTC), Observer(50.0, 10.0))[3], 3228.0)
    told = {**omm(orbit, 0.0), "EPOCH": orbit.epoch.isoformat()[:26]}
    (tmp_path / "old.json").write_text(json.dumps([told]))
    (tmp_path / "high.toml").write_text("[motion]\nmin_elevation_deg = 45\n")
    result = run(
        "track", "LEO 4", *HERE, "--engage", "--until", "reach", "--speed", 100, "--json",
        "--elements", tmp_path / "old.json", "--config", tmp_path / "high.toml",
    )  # fmt: skip
    assert result.exit_code == 0, result.stderr
    assert (
        "Error to expect: unknown. ✗ useless elements, 3228 d old, figures end at 7 d: `birdcage elements update` gets "
        "newer ones.\n" in result.stderr
    )
    assert re.search(r"Error unknown. The dish alone: \d+\.\d+° RMS, \d+\.\d+° max\.", result.stderr)
    events = [json.loads(line) for line in result.stdout.splitlines()]
    (plan,) = [each for each in events if each["event"] == "plan"][:1]
    assert plan["forecast"]["unknown_because"] == "figures end at 7 d"
    samples = [each for each in events if each["event"] == "sample"]
    assert samples
    assert {each["expected_error_deg"] for each in samples} == {each["loss_db"] for each in samples} == {None}
    assert all(each["error_deg"] < 20.0 for each in samples)
    assert events[-1]["expected_rms_error_deg"] is events[-1]["expected_rms_error_p90_deg"] is None
