"""`[elements]`: where elements come from."""

from __future__ import annotations

import pytest
from birdcage.base.config import ElementsSettings, load


def read(tmp_path, text, environ=None):
    path = tmp_path / "birdcage.toml"
    path.write_text(text)
    return load(path, environ or {})


def test_nothing_is_set_and_no_server_named(tmp_path):
    assert read(tmp_path, "").elements == ElementsSettings(None, None, 60.0, None)
    assert ElementsSettings().group_names == ()


def test_groups_mirror_and_craft_are_read(tmp_path):
    text = '[elements]\ngroups = "weather, geo  my-birds"\nmirror_url = "http://nas.local:8000/{group}.json"\n'
    settings = read(tmp_path, text, {"BIRDCAGE_CRAFT_URL": "https://example.org"})
    assert settings.problems == ()
    assert settings.elements.group_names == ("weather", "geo", "my-birds")
    assert settings.elements.mirror_url == "http://nas.local:8000/{group}.json"
    assert settings.elements.craft_url == "https://example.org"


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ('mirror_url = "http://nas/elements.json"', "{group} is missing"),
        ('mirror_url = "nas/{group}"', "not an http or https address"),
        ('craft_url = "ftp://example.org"', "not an http or https address"),
        ('craft_url = "http://[bad"', "not an http or https address"),
        ("deadline_s = 0.1", "less than 1"),
        ('mirror = "http://nas/{group}"', "did you mean mirror_url?"),
    ],
)
def test_what_cannot_be_meant_is_named_with_its_line_and_never_stops_the_dish(tmp_path, line, words):
    settings = read(tmp_path, f"[elements]\n{line}\n")
    (problem,) = settings.problems
    assert (problem.line, problem.limits_motion) == (2, False)
    assert words in problem.text
    assert settings.elements == ElementsSettings()
