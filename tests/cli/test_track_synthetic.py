"""`birdcage track --synthetic`: a pass without elements, network or place, flown by whatever is at the port."""

from __future__ import annotations

import json
from datetime import UTC, datetime, timedelta

import pytest
from installed_toys import installed


def test_the_plan_of_it_needs_nothing_but_the_kind_of_dish(run):
    result = run("track", "--synthetic", "--max-el", 45, "--minutes", 9, port="/no/such/port")
    assert result.exit_code == 0, result.stderr
    assert "DEMO pass to 45 deg in 9 min" in result.stdout
    assert "45.0° high" in result.stdout
    assert "9 min 00 s" in result.stdout
    assert "--engage follows it" in result.stderr


def test_it_is_flown_with_its_forecast_and_told_to_its_end(run):
    result = run("track", "--synthetic", "--engage", "--minutes", 8, "--max-el", 50, "--speed", 40, "--json",
                 port="sim:g2?seed=1")  # fmt: skip
    assert result.exit_code == 0, result.stderr
    told = [json.loads(line) for line in result.stdout.splitlines()]
    plan = next(each for each in told if each["event"] == "plan")
    assert plan["target"]["name"] == "DEMO pass to 50 deg in 8 min"
    phases = [each["phase"] for each in told if each["event"] == "phase"]
    assert "following" in phases
    assert phases[-1] == "over"
    assert "Expected error" in result.stderr or "Error" in result.stderr


def test_a_dish_that_tells_no_position_goes_to_the_start_first_and_flies_it(run):
    flown = run("track", "--synthetic", "--engage", "--minutes", 8, "--max-el", 50, "--speed", 60, "--rises-in", 120,
                "--json", port="sim:pathway-x1?seed=1", firmware="pathway-x1")  # fmt: skip
    assert flown.exit_code == 0, flown.stderr
    assert "does not tell where it points. It first goes to azimuth" in flown.stderr
    told = [json.loads(line) for line in flown.stdout.splitlines()]
    plan = next(each for each in told if each["event"] == "plan")
    place = plan["preposition"]
    assert f"azimuth {place['true_az_deg']:.1f}°" in flown.stderr
    phases = [each["phase"] for each in told if each["event"] == "phase"]
    assert "following" in phases
    assert phases[-1] == "over"


def test_a_rotator_that_was_told_where_it_points_flies_it(run, tmp_path):
    """The other kind of machine, on a port of its own: told, sent to the start, and in control while it waits."""
    pytest.importorskip("termios", reason="a pseudo terminal is needed")
    with installed(tmp_path):
        from birdcage_toys import starter_twin

        starter = starter_twin.StarterOnPty()
        try:
            given = {"port": starter.path, "firmware": "starter"}
            untold = run("track", "--synthetic", "--engage", **given)
            assert untold.exit_code != 0
            assert "`birdcage sync AZ EL`" in untold.stderr
            assert run("sync", 200, **given).exit_code == 0
            until = (datetime.now(UTC) + timedelta(seconds=22)).isoformat()
            flown = run("track", "--synthetic", "--engage", "--rises-in", 11, "--until", until, **given)
            assert flown.exit_code == 0, flown.stderr
            assert "following: On the target" in flown.stderr
            assert starter.twin.points_az_deg == pytest.approx(264.0, abs=4.0), "where the pass rises"
        finally:
            starter.close()


@pytest.mark.parametrize(("words", "said"), [
    (("iss", "--synthetic"), "leave out TARGET"), (("--max-el", 30), "go with --synthetic"), ((), "Name a TARGET"),
    (("--synthetic", "--minutes", 2), "does not last 2.0 min. Give"), (("--synthetic", "--max-el", 95), "95"),
])  # fmt: skip
def test_what_does_not_go_together_is_said(run, words, said):
    result = run("track", *words)
    assert result.exit_code != 0
    assert said in result.stderr
