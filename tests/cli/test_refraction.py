"""Every command that prints azimuth and elevation says in help, text and JSON whether refraction is in them."""

from __future__ import annotations

import pytest

AT = ("--at", "2026-03-20T12:00:00Z")
START = ("--start", "2026-11-21T00:00:00Z")
HERE = ("--lat", 51.5, "--lon", -0.1)
TLE = """ISS (ZARYA)
1 25544U 98067A   26325.50000000  .00016717  00000-0  10270-3 0  9000
2 25544  51.6416 247.4627 0006703 130.5360 325.0288 15.72125391    16
"""
SKY = {
    "where": ("where", "28.2E", *HERE, *AT),
    "sky": ("sky", *HERE, *AT),
    "passes": ("passes", *HERE, *START, "--elements", "{tle}"),
    "autotrack": ("autotrack", *HERE, *START, "--elements", "{tle}"),
    "track --plan": ("track", "28.2E", "--plan", *HERE),
}
SAID = {
    "where": "refraction not in these angles: tracking points 0.039° higher (radio)",
    "sky": "Elevations are without refraction.",
    "passes": "Times and elevations are without refraction.",
    "autotrack": "BEST is without refraction.",
    "track --plan": "el includes refraction, as radio waves are bent",
}


@pytest.fixture
def told(run, tmp_path):
    (tmp_path / "birdcage.toml").write_text("")
    (tmp_path / "iss.tle").write_text(TLE)

    def told(name, *more, settings=""):
        (tmp_path / "birdcage.toml").write_text(settings)
        words = [str(word).format(tle=tmp_path / "iss.tle") for word in SKY[name]]
        result = run(*words, *more, port=None, env={"BIRDCAGE_HOME": str(tmp_path)})
        assert result.exit_code == 0, result.output
        return result

    return told


@pytest.mark.parametrize("name", SKY)
def test_the_text_says_it(told, name):
    result = told(name)
    assert SAID[name] in result.stdout + result.stderr


@pytest.mark.parametrize("name", SKY)
def test_the_json_says_it(told, as_json, name):
    found = as_json(told(name, "--json"))
    rows = found if isinstance(found, list) else [found]
    assert rows
    assert {row["refraction"] for row in rows} == {"radio" if name == "track --plan" else "none"}


@pytest.mark.parametrize(("kind", "words"), [("optical", "as light is bent"), ("none", "el is without refraction")])
def test_a_plan_names_the_refraction_that_is_set(told, as_json, kind, words):
    settings = f'[tracking]\nrefraction = "{kind}"\n'
    assert words in told("track --plan", settings=settings).stdout
    assert as_json(told("track --plan", "--json", settings=settings))["refraction"] == kind


@pytest.mark.parametrize(
    "command",
    ["where", "sky", "passes", "autotrack", "track", "pos", "move", "log", "craft", "calibrate next", "calibrate list"],
)
def test_the_help_says_it(run, command):
    assert "refraction" in run(*command.split(), "--help").stdout


def test_a_fixed_direction_is_where_the_beam_points(run, as_json, tmp_path):
    plan = as_json(run("track", "az=180,el=20", "--plan", "--json", *HERE, env={"BIRDCAGE_HOME": str(tmp_path)}))
    assert plan["refraction"] == "none"
    assert {row["true_el_deg"] for row in plan["path"]} == {20.0}
