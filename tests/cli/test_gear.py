"""`birdcage gear`: what is known of a dish's play and overshoot."""

from __future__ import annotations


def test_play_that_is_set_is_kept_for_this_dish_and_shown_with_its_origin(run, as_json, pty_dish):
    assert "are unknown" in run("gear", port=pty_dish.path).stdout
    said = run("gear", "--play-az", "0.05", port=pty_dish.path)
    assert said.exit_code == 0, said.stderr
    assert "azimuth: play 0.050° (set by the user, " in said.stdout
    both = as_json(run("gear", "--play-el", "0.04", "--json", port=pty_dish.path))["gear"]
    assert (both["azimuth_play_deg"], both["elevation_play_deg"]) == (0.05, 0.04)
    assert both["elevation_play_origin"] == "set by the user"
    assert pty_dish.moves() == []
    status = as_json(run("status", "--quick", "--json", port=pty_dish.path))
    assert status["gear"]["azimuth_play_deg"] == 0.05
    assert "play 0.050° (set by the user, " in run("status", "--quick", port=pty_dish.path).stdout
    assert "are unknown" in run("gear", "--forget", port=pty_dish.path).stdout
    assert as_json(run("status", "--quick", "--json", port=pty_dish.path))["gear"] is None


def test_what_cannot_be_is_refused_and_keeps_nothing(run, pty_dish):
    refused = run("gear", "--play-az", "0.5", port=pty_dish.path)
    assert refused.exit_code != 0
    assert "type 0 to 0.15" in refused.stderr
    assert "--forget goes alone" in run("gear", "--forget", "--play-az", "0.05", port=pty_dish.path).stderr
    assert "are unknown" in run("gear", port=pty_dish.path).stdout


def test_a_dish_without_an_adapter_or_a_firmware_is_asked_for(run, pty_dish):
    assert "No adapter at" in run("gear", port="sim:g2").stderr
    unnamed = run("gear", "--play-az", "0.05", port=pty_dish.path, firmware="")
    assert "Name the firmware with --firmware" in unnamed.stderr


def test_a_play_that_cannot_be_kept_is_said_to_be_lost(run, pty_dish, tmp_path):
    (tmp_path / "state").write_text("in the way")
    said = run("gear", "--play-az", "0.05", port=pty_dish.path, env={"BIRDCAGE_HOME": str(tmp_path)})
    assert said.exit_code == 2
    assert "facts.json can't be written (Not a directory): nothing was kept." in said.stderr
