"""A motor along an arc on the command line: where it can't point, what it misses, and where nothing points at all."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.clock import RealClock
from installed_toys import installed

PLACED = "[place]\nlatitude_deg = 48.0\nlongitude_deg = 11.0\n"
LACKS = "The Swing has no azimuth and elevation. Its arc depends on where it stands: set your location"


@pytest.fixture
def swing(tmp_path, monkeypatch, run):
    """Run `birdcage` on one that is quick, at a place or nowhere."""
    (tmp_path / "toys").mkdir()
    with installed(tmp_path / "toys"):
        from birdcage_toys import swing, swing_twin

        (hour,) = swing.FACTS.axes
        quick = replace(hour, speed_deg_s=2000.0, acceleration_deg_s2=20000.0)
        monkeypatch.setattr(swing.Swing, "facts", replace(swing.FACTS, axes=(quick,)))
        twin = swing_twin.SwingTwin(RealClock(), speed_deg_s=2000.0)

        def on_swing(*words, placed=True):
            home = tmp_path / ("placed" if placed else "nowhere")
            home.mkdir(exist_ok=True)
            (home / "birdcage.toml").write_text(PLACED if placed else "")
            return run(*words, port=twin.address, firmware="swing", env={"BIRDCAGE_HOME": str(home)})

        on_swing.twin = twin
        yield on_swing


def test_a_small_miss_is_gone_to_and_told(swing, as_json):
    result = swing("move", "--az", 200, "--el", 33.4)
    assert result.exit_code == 0, result.stderr
    assert result.stdout.startswith("AZ: 199.8")
    assert "That is the nearest it reaches: 0.4" in result.stderr
    assert "At rest the dish does not tell." in result.stderr
    assert swing.twin.truth().az_deg == pytest.approx(199.87, abs=0.1)
    assert as_json(swing("move", "--az", 200, "--el", 33.4, "--json"))["miss_deg"] == pytest.approx(0.48, abs=0.02)


def test_a_large_miss_is_refused_with_the_nearest_unless_that_is_asked_for(swing):
    result = swing("move", "--az", 180, "--el", 60)
    assert result.exit_code != 0
    assert "misses this direction by 25.13°, more than the 1.00° allowed. Nothing was sent." in result.stderr
    assert "The nearest that it reaches is azimuth 180.00°, elevation 34.87°." in result.stderr
    assert not swing.twin.taken()
    assert swing("move", "--az", 180, "--el", 60, "--clamp").exit_code == 0
    assert swing.twin.truth().el_deg == pytest.approx(34.87, abs=0.1)


def test_gpredict_gets_no_file_for_what_follows_nothing(swing):
    result = swing("serve", "--print-gpredict")
    assert (result.exit_code, result.stdout) == (4, "")
    assert "The Swing has no azimuth and elevation." in result.stderr


def test_a_pass_is_refused_by_what_it_is(swing):
    result = swing("track", "19.2E", "--engage")
    assert result.exit_code != 0
    assert "The Swing turns one axis along an arc, so it follows no pass." in result.stdout + result.stderr
    assert not swing.twin.taken()


def test_without_a_place_every_command_says_what_it_lacks(swing, as_json):
    for words in (("pos",), ("move", "--az", "180", "--el", "34")):
        result = swing(*words, placed=False)
        assert result.exit_code != 0
        assert LACKS in " ".join(result.stderr.split())
    status = as_json(swing("status", "--json", placed=False))
    assert (status["azimuth_deg"], status["elevation_deg"], status["position_lost"]) == (None, None, "no_direction")
    assert status["motion_refused_because"].startswith(LACKS)
    assert status["connected"] is True
    assert not swing.twin.taken()
