"""`-v`, `-vv` and `--log`: what was decided, what changed, what passed on the wire."""

from __future__ import annotations

import pytest


def test_v_shows_decisions_and_changes_with_their_times(run):
    result = run("-v", "move", "--az", 100, "--el", 40)
    assert result.exit_code == 0
    for words in ("link up", "asked: Goto az_deg=100.0 el_deg=40.0", "moves it to AZ 100.00 EL 40.00",
                  "move arrived", "activity: idle"):  # fmt: skip
        assert words in result.stderr
    assert "> a 0 100" not in result.stderr
    assert result.stdout.startswith("AZ: ")


@pytest.mark.parametrize("words", [("-vv", "pos"), ("pos", "-v", "-v")], ids=" ".join)
def test_vv_shows_every_exchange(run, words):
    result = run(*words)
    assert "wire     > a\\r" in result.stderr
    assert "Angle[0] = 0.00" in result.stderr


def test_a_refusal_is_told_with_its_reason(run):
    result = run("-v", "move", "--az", 100, "--el", 80)
    assert "not done: Goto az_deg=100.0 el_deg=80.0" in result.stderr


def test_log_writes_all_to_a_file_and_nothing_to_stderr(run, tmp_path):
    result = run("pos", "--log", tmp_path / "a.log")
    assert (result.exit_code, result.stderr) == (0, "")
    text = (tmp_path / "a.log").read_text()
    assert "> a\\r" in text
    assert "link up" in text


def test_a_log_that_cannot_be_written_is_wrong_use(run, tmp_path):
    result = run("pos", "--log", tmp_path)
    assert result.exit_code == 2
    assert "--log" in result.stderr


def test_nothing_is_said_without(run):
    assert run("pos").stderr == ""
