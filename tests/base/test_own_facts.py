"""`[dish.facts]` of birdcage.toml."""

from __future__ import annotations

import pytest
from birdcage.base.config import edit, load
from birdcage.base.errors import ConfigError

GOOD = """
[dish]
firmware = "g2"

[dish.facts]
second_same = "block"
azimuth.speed_deg_s = 30
elevation.min_deg = 20.5

[dish.facts.cable]
max_deg = 10
"""


def read(tmp_path, text, environ=None):
    path = tmp_path / "birdcage.toml"
    path.write_text(text)
    return load(path, environ or {})


def test_facts_are_read_by_flat_names_however_the_file_nests_them(tmp_path):
    settings = read(tmp_path, GOOD, {"BIRDCAGE_DISH_FACTS_ELEVATION_PLAY_DEG": "0.05"})
    assert settings.problems == ()
    assert settings.own_facts == {
        "second_same": "block", "azimuth.speed_deg_s": 30.0, "elevation.min_deg": 20.5, "elevation.play_deg": 0.05,
        "cable.max_deg": 10.0,
    }  # fmt: skip
    assert settings.sources["dish.facts.azimuth.speed_deg_s"] == "file"
    assert settings.dish.firmware == "g2"


@pytest.mark.parametrize(
    ("text", "line", "sentence"),
    [
        ("[dish.facts]\nhoming = 3\n", 2, "dish.facts.homing is no setting; did you mean homing_s?"),
        ("[dish.facts.azimut]\nmin_deg = 3\n", 1, "dish.facts.azimut is no setting; did you mean azimuth?"),
        ("[dish.facts]\nazimuth.min = 3\n", 2, "dish.facts.azimuth.min is no setting; did you mean min_deg?"),
        ("[dish.fact]\nhoming_s = 3\n", 1, "dish.fact is no setting; did you mean facts?"),
        ("[dish]\nfacts = 3\n", 2, "dish.facts is a value, where a section [dish.facts] belongs."),
        ("[dish.facts]\ncable = 3\n", 2, "dish.facts.cable is a value, where a section [dish.facts.cable] belongs."),
        ("[dish.facts]\nazimuth.speed_deg_s = 0\n", 2, "dish.facts.azimuth.speed_deg_s is 0, less than 0.01 deg/s."),
        ("[dish.facts]\nazimuth.play_deg = 0.5\n", 2, "dish.facts.azimuth.play_deg is 0.5, more than 0.15 deg."),
        (
            '[dish.facts]\nsecond_same = "blocks"\n', 2,
            "dish.facts.second_same is 'blocks', not one of retarget, queue, block, unknown; did you mean block?",
        ),
        (
            "[dish.facts.elevation]\nmin_deg = 50\nmax_deg = 40\n", 2,
            "dish.facts.elevation.min_deg is 50, which is not below max_deg (40).",
        ),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named_with_its_line_and_nothing_moves(tmp_path, text, line, sentence):
    settings = read(tmp_path, text)
    (problem,) = settings.problems
    assert (problem.line, problem.sentence) == (line, sentence)
    assert settings.motion_problem is not None
    assert settings.own_facts == {}


def test_a_fact_can_be_written_as_any_setting(tmp_path):
    path = tmp_path / "birdcage.toml"
    edit(path, {"dish.facts.azimuth.speed_deg_s": 30.0})
    assert load(path, {}).own_facts == {"azimuth.speed_deg_s": 30.0}
    with pytest.raises(ConfigError, match=r"no setting dish\.facts\.azimuth\.speed"):
        edit(path, {"dish.facts.azimuth.speed": 30.0})
