"""`birdcage craft` is off unless an address is set."""

from __future__ import annotations

from birdcage.cli import exits


def test_without_an_address_nobody_is_asked(run, monkeypatch):
    def ask(*_args, **_more):
        raise AssertionError("somebody was asked")

    monkeypatch.setattr("birdcage.sky.update.craft.Craft", ask)
    for words in (("search", "moon"), ("up",), ("passes", "iss")):
        result = run("craft", *words)
        assert result.exit_code == exits.USAGE
        assert "BIRDCAGE_CRAFT_URL" in result.stderr


def test_its_answers_are_shown_as_its_own(run, monkeypatch, as_json):
    from birdcage.sky.update.craft import Craft, CraftLook

    monkeypatch.setattr(
        Craft, "up", lambda _self, at: (CraftLook("Moon", "moon", "moon", 123.456, at + 1, None, None),)
    )
    env = {"BIRDCAGE_CRAFT_URL": "http://127.0.0.1:9"}
    shown = run("craft", "up", "--min-elevation", "20", env=env).stdout
    assert "Moon  moon" in shown
    assert "123.5" in shown
    assert "-" in shown
    (row,) = as_json(run("craft", "up", "--json", env=env))
    assert (row["azimuth_deg"], row["elevation_deg"], row["range_km"]) == (123.456, 1.0, None)


def test_a_service_that_is_not_there_is_a_sentence(run):
    result = run("craft", "up", env={"BIRDCAGE_CRAFT_URL": "http://127.0.0.1:9"})
    assert result.exit_code == exits.NOT_DONE
    assert "127.0.0.1:9" in result.stderr
    assert isinstance(result.exception, SystemExit)
