"""What `birdcage ready` finds out about SDR++: by questions alone, and with leave by recording for a moment."""

from __future__ import annotations

import json

import pytest
from birdcage.radio import probe

from tests.radio.sdrpp import OneAtATime, SdrPlusPlus

BOX = "tick Recording under Rigctl Server in SDR++"


@pytest.fixture
def checked(run, tmp_path, monkeypatch):
    """Run `ready` beside SDR++; return its checks by name, and SDR++."""
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    monkeypatch.setattr(probe, "TRIAL_S", 0.01)
    started = []

    def check(*words, settings="", armed=False):
        there = OneAtATime(SdrPlusPlus(armed=armed))
        started.append(there)
        (tmp_path / "birdcage.toml").write_text(f'[radio]\nrigctld = "{there.address}"\n{settings}')
        done = run("ready", "--json", *words)
        return {each["name"]: each for each in json.loads(done.stdout)["checks"]}, there

    yield check
    for each in started:
        each.close()


def test_it_is_asked_and_left_as_it_is(checked):
    found, there = checked(armed=True)
    assert there.heard == ["f", "l STRENGTH", "M ?"]
    assert there.sdr.recordings == 0
    assert "SDR++, which serves one program at a time" in found["radio"]["words"]
    assert found["recording"]["state"] == "look"
    assert "SDR++ answers 0 to it with Recording switched off, too" in found["recording"]["words"]
    assert found["recording"]["remedy"] == f"{BOX}, then birdcage ready --try-recording"


@pytest.mark.parametrize("armed", [False, True])
def test_with_leave_it_records_for_a_moment_and_only_a_file_proves_it(checked, armed):
    found, there = checked("--try-recording", armed=armed)
    assert there.heard[-2:] == ["AOS", "LOS"]
    assert there.sdr.recordings == int(armed)
    assert found["recording"]["state"] == "look"
    assert "answered with 0, as SDR++ does with Recording switched off, too" in found["recording"]["words"]
    assert found["recording"]["remedy"] == f"look for a new file of 2 s; if there is none, {BOX}"


def test_a_level_that_is_wanted_and_not_given_is_told(checked):
    found, _ = checked(settings="strength = true\n")
    assert "advertises one and answers RPRT 1" in found["radio level"]["words"]
    assert "radio level" not in checked()[0]


def test_a_receiver_that_is_not_to_record_is_never_told_to(checked):
    found, there = checked("--try-recording", settings="record = false\n", armed=True)
    assert "recording" not in found
    assert there.sdr.recordings == 0


def test_hamlib_says_that_it_does_not_record(checked, monkeypatch):
    monkeypatch.setattr(SdrPlusPlus, "__call__", lambda _sdr, line: b"7\n" if line == "f" else b"RPRT -18\n")
    found, there = checked("--try-recording")
    assert "RPRT -18: this receiver does not record" in found["recording"]["words"]
    assert there.heard[-1] == "AOS"
