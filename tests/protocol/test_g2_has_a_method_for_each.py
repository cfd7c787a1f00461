"""Each command of the inventory that does no harm is sent by some feature or method: all are called."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from birdcage.console.session import Console
from birdcage.protocol.g2 import CarryoutG2Protocol
from birdcage.protocol.g2.features_receiver import RSSI_READS
from birdcage.rotator.verdict import Grade

BESIDE_THE_FEATURES = (
    lambda g: (g.get_position(), g.nvs.read(20), g.adc.monitor(1)),
    lambda g: (g.latlon.triangulate(199, 43, 214, 37), g.gpio.direction("B0"), g.gpio.read("B0")),
    lambda g: (g.motors.max_velocities(), g.motors.max_accelerations()),
    lambda g: (g.motors.elevation_to_steps(45), g.motors.steps_to_elevation(3120)),
    lambda g: (g.tuner.quick_lock_status(), g.tuner.diagnostics()),
)
NEEDS_AN_ARGUMENT = {
    "ee": "ee 0",
    "dir": "dir B0",
    "r": "r B0",
    "l": "l 1 2 3 4",
    "rssi": f"rssi {RSSI_READS}",
    "ela2s": "ela2s 45",
    "els2a": "els2a 900",
}
NOT_A_QUESTION = {"?", "help", "man", "q"}
ANSWERED_OTHERWISE = {("nvs", "e")}
"""`d <index>` tells more than `e <index>`."""


@pytest.fixture
def g2(simulated):
    return simulated("seed=1&az=-158&el=42")


@pytest.fixture
def sent(monkeypatch):
    """Return the lines that go out, each with its menu."""
    sent = []
    run, stream = Console.run, Console.stream

    def note_run(console, menu, command, **how):
        sent.append((menu, command))
        return run(console, menu, command, **how)

    def note_stream(console, command, *how):
        sent.append((console.place, command))
        return stream(console, command, *how)

    monkeypatch.setattr(Console, "run", note_run)
    monkeypatch.setattr(Console, "stream", note_stream)
    return sent


def questions(g2):
    """Return each way to read features, with the ids of its rows."""
    asked = {}
    for name, row in g2.feature_table._rows.items():
        if row.read is not None:  # else it can only be set
            asked.setdefault(row.read, set()).add(name)
    return asked


def test_each_harmless_command_is_sent_by_some_feature_or_method(g2, sent):
    for ask in questions(g2):
        ask(g2)
    for call in BESIDE_THE_FEATURES:
        call(g2)
    harmless = {
        (command.menu, command.name)
        for command in CarryoutG2Protocol.commands
        if command.menu != "root" and command.name not in NOT_A_QUESTION
        and Grade.HARMLESS in {
            g2.judge(line, command.menu, homed=True).grade
            for line in (command.name, NEEDS_AN_ARGUMENT.get(command.name, command.name))
        }
    }  # fmt: skip
    assert len(harmless) > 50
    assert harmless - {(menu, line.split()[0]) for menu, line in sent} == ANSWERED_OTHERWISE


def test_reading_features_sends_only_harmless_lines_of_one_menu_and_tells_each_of_them(g2, sent):
    known = g2.model.features
    for ask, names in questions(g2).items():
        sent.clear()
        told = ask(g2)
        assert names <= told.keys() <= known.keys()
        ((menu, lines),) = {(known[name].cost.menu, known[name].cost.lines) for name in names}
        assert len(sent) <= lines
        assert {where for where, _line in sent} == {menu}
        ((_prompt, line),) = {tuple(known[name].asked.split("> ")) for name in names}
        assert any(line.startswith(each) for _where, each in sent)
        grade = Grade.SETTING if any(known[name].read_hazard for name in names) else Grade.HARMLESS
        assert {g2.judge(line, menu, homed=False).grade for _menu, line in sent} == {grade}


def test_the_page_has_the_command_of_each_feature():
    page = (Path(__file__).parents[2] / "docs/reference/g2-commands.md").read_text(encoding="utf-8")
    table = page.split("## As features")[1].split("\n## ")[0]
    told = [
        name for names in re.findall(r"`: ((?:`[^`]+`(?:, )?)+)", table) for name in re.findall(r"`([^`]+)`", names)
    ]
    named = [name.replace("<axis>", axis) for name in told for axis in ("azimuth", "elevation")]
    assert set(named) == CarryoutG2Protocol.model.features.keys()
    assert len(told) == len(set(told))
