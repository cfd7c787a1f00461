"""`hooks.on_event`: what the owner's command is told, and that nothing waits for it."""

from __future__ import annotations

import json
import shlex
import sys
import time
from pathlib import Path

import pytest
from birdcage.station.event_hooks import SUBJECT, EventHooks
from birdcage.station.requests import AcknowledgeFault, Release
from birdcage.station.state import LinkPhase

NOTE = (
    "import os, sys, json;"
    "line = json.dumps([os.environ['BIRDCAGE_EVENT'], os.environ['BIRDCAGE_SENTENCE'], json.loads(sys.stdin.read())]);"
    "open(sys.argv[1], 'a').write(line + chr(10))"
)


def until(true, seconds=30.0):
    deadline = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.01)


def command(code, *arguments):
    return shlex.join([sys.executable, "-c", code, *map(str, arguments)])


@pytest.fixture
def listen(bench):
    made = []

    def listening(line, deadline_s=60.0):
        made.append(EventHooks(bench.station, line, deadline_s))
        return made[-1]

    yield listening
    for each in made:
        each.close(5.0)


def told(file: Path):
    return [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []


def test_stop_and_release_are_told_with_sentence_and_event(bench, listen, tmp_path):
    out = tmp_path / "told"
    listen(command(NOTE, out))
    bench.station.stop("anna")
    bench.step(2.0)
    until(lambda: len(told(out)) == 1)
    bench.do(Release("anna"))
    until(lambda: len(told(out)) == 2)
    (held, sentence, event), (released, _, _) = sorted(told(out))
    assert (held, released) == ("held", "released")
    assert "anna" in sentence
    assert event["type"] == "HeldChanged"
    assert event["held"]["by"] == "anna"


def test_a_link_that_is_lost_and_found_is_told_once_each(bench, listen, tmp_path):
    out = tmp_path / "told"
    listen(command(NOTE, out))
    bench.device.unplug()
    bench.step(10.0)
    assert bench.state.link.state is LinkPhase.LOST
    bench.device.plug()
    bench.step(10.0)
    assert bench.state.link.state is LinkPhase.UP
    until(lambda: len(told(out)) == 2)
    assert sorted(each[0] for each in told(out)) == ["link_back", "link_lost"]


def test_a_restart_is_told_as_a_fault(bench, listen, tmp_path):
    out = tmp_path / "told"
    listen(command(NOTE, out))
    bench.device.reboot()
    bench.step(5.0)
    until(lambda: any(each[0] == "fault" for each in told(out)))
    bench.do(AcknowledgeFault("anna"))


def test_a_command_that_fails_is_a_warning_until_one_works(bench, listen, tmp_path):
    out = tmp_path / "fails"
    out.write_text("1")
    listen(command("import sys; sys.exit(int(open(sys.argv[1]).read()))", out))
    bench.station.stop("anna")
    bench.step(1.0)
    until(lambda: "status 1" in bench.state.warnings.get(SUBJECT, ""))
    out.write_text("0")
    bench.do(Release("anna"))
    until(lambda: SUBJECT not in bench.state.warnings)


def test_one_that_cannot_be_started_is_a_warning(bench, listen):
    listen("/nowhere/at/all")
    bench.station.stop("anna")
    bench.step(1.0)
    until(lambda: "could not be started" in bench.state.warnings.get(SUBJECT, ""))


def test_one_that_hangs_keeps_no_other_waiting(bench, listen, tmp_path):
    out = tmp_path / "told"
    hang = f"import time, os; {NOTE}; time.sleep(60 if os.environ['BIRDCAGE_EVENT'] == 'held' else 0)"
    hooks = listen(command(hang, out))
    bench.station.stop("anna")
    bench.step(1.0)
    bench.do(Release("anna"))
    until(lambda: sorted(each[0] for each in told(out)) == ["held", "released"])
    begun = time.monotonic()
    hooks.close(5.0)
    assert time.monotonic() - begun < 5.0


def test_a_held_that_only_names_who_waits_is_not_told_again(bench, listen, tmp_path):
    from birdcage.station.requests import Goto

    out = tmp_path / "told"
    listen(command(NOTE, out))
    bench.station.stop("anna")
    bench.step(1.0)
    for _ in range(3):
        future = bench.station.submit(Goto(10.0, 40.0, "client"))
        bench.step(0.5)
        assert future.exception(0) is not None
    bench.do(Release("anna"))
    until(lambda: len(told(out)) == 2)
    assert sorted(each[0] for each in told(out)) == ["held", "released"]
