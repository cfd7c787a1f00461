"""Command lines at moments of a pass: real children, run from a virtual clock."""

from __future__ import annotations

import json
import math
import shlex
import subprocess
import sys
import threading
import time
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config.tracking_sections import HookSettings
from birdcage.pursuit.hooks import PassHooks
from birdcage.pursuit.pass_facts import PassFacts
from birdcage.sky.downlinks_read import load_downlinks

NOON = datetime(2026, 3, 20, 12, 0, 0, tzinfo=UTC)


def after(seconds):
    return NOON + timedelta(seconds=seconds)


FACTS = PassFacts(
    "NOAA 20", after(100.0), after(700.0), norad_id=43013, aos=after(60.0), tca=after(400.0), los=after(740.0),
    max_el_deg=61.234, freq_hz=7.812e9, site="Field",
)  # fmt: skip


def python(code):
    return f"{shlex.quote(sys.executable)} -c {shlex.quote(code)}"


def until(true, seconds=60.0):
    deadline = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.005)


def alive(pid):
    try:
        with Path(f"/proc/{pid}/stat").open() as stat:
            return stat.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


class Stage:
    """Hooks of a pass and what they said."""

    def __init__(self, grace_s=5.0, **settings):
        self.clock = VirtualClock(NOON)
        self.said = []
        self.hooks = PassHooks(HookSettings(**settings), self.said.append, self.clock, grace_s=grace_s)

    @property
    def texts(self):
        return [each.text for each in self.said]

    def run(self, seconds):
        goal = self.clock.monotonic() + seconds
        while self.clock.monotonic() < goal:
            self.clock.wait(None, min(self.hooks.step(), goal))

    def ended(self, times=1):
        until(lambda: sum("ended with" in text or "was ended by" in text for text in self.texts) >= times)

    def starts(self):
        """Return which ran, and how long after noon."""
        return [
            (each.event, round((each.utc - NOON).total_seconds()))
            for each in self.said
            if each.text.endswith("started.")
        ]


@pytest.fixture
def stage():
    stages = []

    def make(**more):
        stages.append(Stage(**more))
        return stages[-1]

    yield make
    for each in stages:
        each.hooks.close(10.0)


def test_each_runs_at_its_moment(stage):
    stage = stage(at_reach_start="true 1", at_tca="true 2", at_reach_end="true 3", pre_s=20.0, post_s=30.0)
    stage.hooks.plan(FACTS)
    stage.run(800.0)
    assert stage.starts() == [("reach_start", 80), ("tca", 400), ("reach_end", 730)]
    assert {each.name for each in stage.said} == {"NOAA 20"}
    assert math.isinf(stage.hooks.step())


def test_the_facts_in_the_environment_and_on_stdin(stage, tmp_path):
    out = tmp_path / "facts"
    code = (
        "import os, sys, json; told = {k: v for k, v in os.environ.items() if k.startswith('BIRDCAGE_')};"
        f"open({str(out)!r}, 'w').write(json.dumps([told, json.loads(sys.stdin.read())]))"
    )
    stage = stage(at_tca=python(code))
    (sent,) = load_downlinks().of(43013, "")
    stage.hooks.plan(replace(FACTS, site=None, downlink=sent))
    stage.run(500.0)
    stage.ended()
    environment, line = json.loads(out.read_text())
    assert environment == {
        "BIRDCAGE_EVENT": "tca", "BIRDCAGE_NAME": "NOAA 20", "BIRDCAGE_NORAD": "43013",
        "BIRDCAGE_AOS": "2026-03-20T12:01:00Z", "BIRDCAGE_LOS": "2026-03-20T12:12:20Z",
        "BIRDCAGE_REACH_START": "2026-03-20T12:01:40Z", "BIRDCAGE_REACH_END": "2026-03-20T12:11:40Z",
        "BIRDCAGE_DURATION_S": "600.0", "BIRDCAGE_MAX_EL": "61.23", "BIRDCAGE_FREQ_HZ": "7812000000",
        "BIRDCAGE_SITE": "", "BIRDCAGE_MODE": "HRD", "BIRDCAGE_POLARIZATION": "RHCP",
        "BIRDCAGE_SYMBOL_RATE": "15000000", "BIRDCAGE_PIPELINE": "npp_hrd", "BIRDCAGE_PIPELINE_LIVE": "0",
    }  # fmt: skip
    assert (line["event"], line["norad"], line["max_el"], line["site"]) == ("tca", 43013, 61.23, None)
    assert (line["symbol_rate"], line["pipeline"], line["pipeline_live"]) == (15000000, "npp_hrd", 0)


def test_what_is_not_known_of_the_signal_is_empty():
    told = FACTS.environment("tca")
    names = ("MODE", "POLARIZATION", "SYMBOL_RATE", "PIPELINE", "PIPELINE_LIVE")
    assert [told[f"BIRDCAGE_{name}"] for name in names] == [""] * 5


def test_each_variable_is_explained_in_the_docs():
    page = (Path(__file__).parents[2] / "docs" / "satdump.md").read_text(encoding="utf-8")
    assert [name for name in FACTS.environment("tca") if f"`{name}`" not in page] == []


def test_what_it_says_and_how_it_ended_are_told(stage):
    code = "import sys; print('recording\\x1b[31m', flush=True); print('no space', file=sys.stderr); sys.exit(3)"
    stage = stage(at_reach_start=python(code))
    stage.hooks.plan(FACTS)
    stage.run(101.0)
    stage.ended()
    assert stage.texts[1:3] == ["recording?[31m", "no space"]
    assert stage.texts[-1].endswith("ended with status 3.")
    assert {each.event for each in stage.said} == {"reach_start"}


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("/no/such/recorder --now", "not started, /no/such/recorder: No such file or directory."),
        ("'unbalanced", "not started, it cannot be read (No closing quotation)."),
        ("  ", "not started, it is empty."),
        ("/", "not started, /: Permission denied."),
    ],
)
def test_what_cannot_be_started_is_a_sentence(stage, command, told):
    stage = stage(at_reach_start=command, at_tca="true")
    stage.hooks.plan(FACTS)
    stage.run(500.0)
    assert stage.texts[0].endswith(told)
    assert stage.starts() == [("tca", 400)]  # and the pass goes on


def test_no_shell_takes_part(stage, tmp_path):
    stage = stage(at_reach_start=f"echo $HOME; touch {tmp_path}/no")
    stage.hooks.plan(FACTS)
    stage.run(101.0)
    stage.ended()
    assert stage.texts[1] == f"$HOME; touch {tmp_path}/no"
    assert not (tmp_path / "no").exists()


def test_nobody_waits_for_a_command(stage):
    stage = stage(at_reach_start=python("import time; time.sleep(60)"), grace_s=2.0)
    stage.hooks.plan(FACTS)
    began = time.monotonic()
    stage.run(101.0)
    assert time.monotonic() - began < 1.0
    assert stage.starts() == [("reach_start", 100)]
    assert stage.hooks.close(10.0)
    assert time.monotonic() - began < 2.0
    assert stage.texts[-1].endswith("was ended by signal 15.")


def test_a_command_that_does_not_read_stdin_and_says_a_lot(stage):
    stage = stage(at_reach_start=python("import os; os.close(0); [print('x' * 5000) for _ in range(300)]"))
    stage.hooks.plan(FACTS)
    stage.run(101.0)
    stage.ended()
    assert len(stage.said) == 1 + 200 + 1 + 1
    assert max(map(len, stage.texts)) <= 1000
    assert stage.texts[-2].endswith("prints more than 200 lines; the rest is dropped.")
    assert stage.texts[-1].endswith("status 0.")


FAMILY = """
import subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", {child!r}])
print("child", child.pid, flush=True)
{rest}
"""
STUBBORN = (
    "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print('deaf', flush=True); time.sleep(60)"
)
MEEK = "import time; time.sleep(60)"


def grandchild(stage):
    until(lambda: any(text.startswith("child") for text in stage.texts))
    return next(int(text.split()[1]) for text in stage.texts if text.startswith("child"))


@pytest.mark.skipif(sys.platform == "win32", reason="groups are a matter of POSIX")
class TestTheWholeFamily:
    def test_ends_at_the_deadline(self, stage):
        code = FAMILY.format(child=MEEK, rest="time.sleep(60)")
        stage = stage(at_reach_start=python(code), deadline_s=1.0, grace_s=5.0)
        stage.hooks.plan(FACTS)
        stage.run(101.0)
        pid = grandchild(stage)
        assert alive(pid)
        until(lambda: not alive(pid))
        stage.ended()
        assert any("is to end, 1 s are over" in text for text in stage.texts)
        assert stage.texts[-1].endswith("was ended by signal 15.")

    def test_is_killed_where_it_does_not_listen(self, stage):
        stage = stage(at_reach_start=python(STUBBORN), grace_s=0.2)
        stage.hooks.plan(FACTS)
        stage.run(101.0)
        until(lambda: "deaf" in stage.texts)
        assert stage.hooks.close(10.0)
        assert any("did not end within 0.2 s, and was killed" in text for text in stage.texts)
        assert stage.texts[-1].endswith("was ended by signal 9.")

    def test_a_grandchild_that_does_not_listen_is_killed_though_its_parent_went(self, stage):
        code = FAMILY.format(child=STUBBORN, rest="time.sleep(60)")
        stage = stage(at_reach_start=python(code), grace_s=0.2)
        stage.hooks.plan(FACTS)
        stage.run(101.0)
        pid = grandchild(stage)
        until(lambda: "deaf" in stage.texts)
        assert stage.hooks.close(10.0)
        until(lambda: not alive(pid))

    def test_what_stays_behind_is_told_and_ends_with_us(self, stage):
        stage = stage(at_reach_start=python(FAMILY.format(child=MEEK, rest="")), grace_s=2.0)
        stage.hooks.plan(FACTS)
        stage.run(101.0)
        pid = grandchild(stage)
        stage.ended()
        assert stage.texts[-1].endswith("ended with status 0, but a program that it started still runs.")
        assert alive(pid)
        assert stage.hooks.close(10.0)
        until(lambda: not alive(pid))

    def test_whoever_ends_first_leaves_nobody_behind(self, tmp_path):
        """A program that ends at once, and a command that does not listen: it is killed all the same, later."""
        code = f"""
import sys
from datetime import timedelta
from birdcage.base.clock import RealClock
from birdcage.base.config.tracking_sections import HookSettings
from birdcage.pursuit.hooks import PassHooks
from birdcage.pursuit.pass_facts import PassFacts
import queue
clock, lines = RealClock(), queue.Queue()
settings = HookSettings(at_reach_start={python(STUBBORN)!r})
hooks = PassHooks(settings, lambda line: lines.put(line.text), clock, grace_s=0.3)
hooks.plan(PassFacts("X", clock.utc(), clock.utc() + timedelta(seconds=60)))
hooks.step()
while lines.get(timeout=60) != "deaf":
    pass
print(hooks._runs[0]._group.child.pid)
assert not hooks.close()
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=90, check=True)
        pid = int(done.stdout)
        until(lambda: not alive(pid))

    def test_has_a_group_of_its_own(self, stage):
        stage = stage(
            at_reach_start=python("import os; print(os.getpgrp() == os.getpid(), os.getsid(0) == os.getpid())")
        )
        stage.hooks.plan(FACTS)
        stage.run(101.0)
        stage.ended()
        assert stage.texts[1] == "True True"


def test_a_pass_that_is_given_up_ends_what_it_began(stage):
    stage = stage(at_reach_start="true 1", at_reach_end="true 3")
    stage.hooks.plan(FACTS)
    stage.run(300.0)
    stage.hooks.plan(None)
    stage.run(1000.0)
    assert stage.starts() == [("reach_start", 100), ("reach_end", 300)]


def test_a_pass_that_is_given_up_before_runs_nothing(stage):
    stage = stage(at_reach_start="true 1", at_reach_end="true 3")
    stage.hooks.plan(FACTS)
    stage.run(50.0)
    stage.hooks.plan(None)
    stage.run(1000.0)
    assert stage.starts() == []


def test_the_same_pass_planned_anew_runs_nothing_twice(stage):
    stage = stage(at_reach_start="true 1", at_tca="true 2", at_reach_end="true 3")
    stage.hooks.plan(FACTS)
    stage.run(300.0)
    stage.hooks.plan(replace(FACTS, reach_end=after(650.0)))
    stage.run(1000.0)
    assert stage.starts() == [("reach_start", 100), ("tca", 400), ("reach_end", 650)]


def test_the_next_pass_of_the_same_satellite_is_another(stage):
    stage = stage(at_reach_start="true 1", at_reach_end="true 3")
    stage.hooks.plan(FACTS)
    stage.run(710.0)
    stage.hooks.plan(replace(FACTS, reach_start=after(6000.0), reach_end=after(6300.0), tca=None))
    stage.run(6000.0)
    assert stage.starts() == [("reach_start", 100), ("reach_end", 700), ("reach_start", 6000), ("reach_end", 6300)]


def test_a_pass_chosen_in_its_middle_starts_at_once_and_leaves_its_past_out(stage):
    stage = stage(at_reach_start="true 1", at_tca="true 2", at_reach_end="true 3")
    stage.run(500.0)
    stage.hooks.plan(FACTS)
    stage.run(300.0)
    assert stage.starts() == [("reach_start", 500), ("reach_end", 700)]


def test_a_pass_that_is_over_runs_nothing(stage):
    stage = stage(at_reach_start="true 1", at_tca="true 2", at_reach_end="true 3", post_s=100.0)
    stage.run(750.0)
    stage.hooks.plan(FACTS)
    stage.run(300.0)
    assert stage.starts() == []


def test_only_an_end(stage):
    stage = stage(at_reach_end="true 3")
    stage.hooks.plan(FACTS)
    stage.run(800.0)
    assert stage.starts() == [("reach_end", 700)]


def test_no_thread_is_left(stage):
    stage = stage(at_reach_start="true")
    stage.hooks.plan(FACTS)
    stage.run(101.0)
    stage.ended()
    assert stage.hooks.close(10.0)
    assert not [each for each in threading.enumerate() if each.name == "hook"]
