"""`docs/recipes/record-with-satdump`: a hook of a pass that a simulated dish follows, with a stand-in for SatDump."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from birdcage.base.config import FeedProfile, Settings
from birdcage.base.config.feeds import FeedSettings
from birdcage.base.config.tracking_sections import HookSettings
from birdcage.pursuit.pass_facts import PassFacts
from birdcage.sky.downlinks_read import shipped
from birdcage.station.pursuit_state import Phase

from .conftest import SHORT
from .pass_events import wait_for

RECIPE = Path(__file__).parents[2] / "docs" / "recipes" / "record-with-satdump"
STATION = "DEMO LEO 2 station"
STAND_IN = f"""#!{sys.executable}
import os, pathlib, signal, sys, time
folder = pathlib.Path(os.environ["SATDUMP_FOLDER"])
def interrupted(*_):
    (folder / "ended").write_text("interrupted\\n")
    sys.exit(0)
# SatDump takes an interrupt even where it was started with interrupts ignored, which no shell can.
signal.signal(signal.SIGINT, interrupted)
(folder / "told.new").write_text("".join(f"{{each}}\\n" for each in sys.argv[1:]))
(folder / "told.new").rename(folder / "told")
while True:
    time.sleep(60)
"""
METOP = next(each for each in shipped() if each.satellite == "METOP-B" and each.pipeline == "metop_ahrpt")


@pytest.fixture
def satdump(tmp_path, monkeypatch):
    """A folder with a `satdump` that writes down what it is told, first on PATH, and where passes go."""
    program = tmp_path / "bin" / "satdump"
    program.parent.mkdir()
    program.write_text(STAND_IN)
    program.chmod(0o755)
    folder = tmp_path / "recorded"
    folder.mkdir()
    monkeypatch.setenv("PATH", f"{program.parent}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("SATDUMP_FOLDER", str(folder))
    return folder


def test_a_pass_is_recorded_from_reach_to_its_end_by_the_pipeline_of_its_downlink(make, satdump, tmp_path):
    line = f"env SATDUMP_SOURCE=airspy SATDUMP_RATE=6000000 SATDUMP_MORE='--bias --general_gain 18' {RECIPE}"
    feed = FeedProfile(freq_min_hz=1.67e9, freq_max_hz=1.71e9, polarization="circular")
    settings = Settings(
        motion=SHORT, feed=FeedSettings("helix"), feeds={"helix": feed},
        hooks=HookSettings(at_reach_start=line, at_reach_end=str(RECIPE)),
    )  # fmt: skip
    bench = make(settings=settings)
    bench.paths.downlinks_file.write_text(
        f'[[downlink]]\nsatellite = "{STATION}"\nfreq_mhz = 1701.3\nmode = "AHRPT"\npolarization = "RHCP"\n'
        'symbol_rate_baud = 2333333\npipeline = "metop_ahrpt"\nalive = true\n'
    )
    bench.desk.choose(STATION)
    bench.desk.follow()
    bench.do()
    told, ended = satdump / "told", satdump / "ended"
    bench.until(lambda: bench.phase() is Phase.READY)
    assert not told.exists(), "before it is in reach"
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.step(2.0)
    wait_for(told)
    words = told.read_text().splitlines()
    assert words[:2] == ["live", "metop_ahrpt"]
    folder = Path(words[2])
    assert folder.parent == satdump
    assert folder.is_dir()
    plan = bench.pursuit.plan
    assert folder.name == f"{plan.reach.intervals[0].start:%Y%m%dT%H%M%SZ}_DEMO_LEO_2_station"
    options = dict(zip(words[3::2], words[4::2], strict=False))
    assert options["--frequency"] == "1701300000"
    assert (options["--samplerate"], options["--source"]) == ("6000000", "airspy")
    assert words[-3:] == ["--bias", "--general_gain", "18"]
    assert int(options["--timeout"]) == pytest.approx(plan.reach.total_s + 60.0, abs=3.0)
    assert not ended.exists(), "while it is in reach"
    bench.until(lambda: bench.phase() in (None, Phase.OVER))
    bench.step(3.0)
    wait_for(ended)
    assert ended.read_text() == "interrupted\n"
    bench.desk.close()


NOON = datetime(2026, 11, 22, 12, tzinfo=UTC)
FACTS = PassFacts("METOP-B", NOON, NOON + timedelta(seconds=600.4), freq_hz=1701.3e6, downlink=METOP)


def run(facts, satdump, event="reach_start", **more):
    """Run it by itself, in the environment that a hook gets."""
    ends_at_once = satdump.parent / "bin" / "satdump"
    ends_at_once.write_text(STAND_IN[: STAND_IN.index("while")])
    return subprocess.run(
        [str(RECIPE)], env={**os.environ, **facts.environment(event), **more}, capture_output=True, text=True,
        timeout=30, check=False,
    )  # fmt: skip


def told(satdump):
    return (satdump / "told").read_text().splitlines()


def test_what_satdump_decodes_only_from_a_recording_is_recorded(satdump):
    dump = next(each for each in shipped() if each.pipeline == "fengyun3_g_ahrpt")
    facts = replace(FACTS, name="FENGYUN 3G", freq_hz=dump.center_hz, downlink=dump)
    assert run(facts, satdump, SATDUMP_RATE="12000000", SATDUMP_LO_HZ="6500000000").returncode == 0
    words = told(satdump)
    assert words[0] == "record"
    assert words[1] == str(satdump / "20261122T120000Z_FENGYUN_3G" / "fengyun3_g_ahrpt")
    assert "1290000000" in words, "behind the converter"


def test_satdump_2_is_called_by_its_own_words(satdump):
    assert run(FACTS, satdump, SATDUMP="satdump legacy", SATDUMP_RATE="6000000").returncode == 0
    assert told(satdump)[:3] == ["legacy", "live", "metop_ahrpt"]
    assert "660" in told(satdump), "the length of reach and a minute"


@pytest.mark.parametrize(
    ("facts", "status", "words"),
    [
        (replace(FACTS, downlink=None), 0, "no SatDump pipeline is known for what METOP-B sends"),
        (FACTS, 2, "2400000 samples a second are too few for 2333333 symbols"),
    ],
)
def test_what_cannot_be_recorded_is_said(satdump, facts, status, words):
    done = run(facts, satdump)
    assert (done.returncode, words in done.stdout) == (status, True), done
    assert not (satdump / "told").exists()


def test_a_name_from_outside_stays_within_the_folder(satdump):
    facts = replace(FACTS, name="../../$(touch x) METOP;B")
    assert run(facts, satdump, SATDUMP_RATE="6000000").returncode == 0
    assert Path(told(satdump)[2]).name == "20261122T120000Z_.._..___touch_x__METOP_B"
    assert Path(told(satdump)[2]).parent == satdump


def test_the_end_of_a_pass_that_was_not_recorded_ends_nothing(satdump):
    assert run(FACTS, satdump, "reach_end").stdout == ""
    with subprocess.Popen(["cat", "satdump"], stdin=subprocess.PIPE, stderr=subprocess.DEVNULL) as gone:
        gone.wait(10)
    with subprocess.Popen(["cat"], stdin=subprocess.PIPE) as other:
        for pid in (gone.pid, other.pid):
            (satdump / "running.pid").write_text(str(pid))
            assert run(FACTS, satdump, "reach_end").stdout == "SatDump had ended before.\n"
            assert not (satdump / "running.pid").exists()
        assert other.poll() is None, "what is not SatDump is left alone"
        other.communicate(b"")
