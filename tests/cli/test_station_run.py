"""A station without a face, for the length of a command."""

from __future__ import annotations

import json
import signal

import pytest
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.cli.dish import open_dish
from birdcage.cli.exits import EndedBySignal
from birdcage.cli.options import Wanted
from birdcage.cli.station_run import run_station
from birdcage.station.requests import Goto
from birdcage.station.state import LinkPhase


def wanted(port: str) -> Wanted:
    return Wanted(port, True, "g2", True, None, load(None), Paths.default())


def test_it_runs_until_a_signal_and_stops_what_moves_first(pty_dish, capsys):
    asked = []

    def look():
        if not asked and dish.state.position is not None:
            asked.append(dish.station.submit(Goto(200.0, 45.0, "somebody")))
        if asked and pty_dish.device.truth().moving:
            dish.on_signal(signal.SIGTERM)

    with pytest.raises(EndedBySignal) as ended, open_dish(wanted(pty_dish.path), moves=True) as dish:
        run_station(dish, each_time=look)
    said = capsys.readouterr()
    assert "link up" in said.err
    assert "control: somebody, before free" in said.err
    assert said.out == ""
    assert ended.value.number == signal.SIGTERM
    assert "The dish was last seen at" in ended.value.__notes__[-1]
    assert not pty_dish.device.truth().moving
    assert abs(pty_dish.device.truth().az_deg - 200.0) > 10.0


def test_a_dish_that_is_not_there_ends_nothing_and_is_found_when_it_comes(pty_dish, capsys, tmp_path):
    port = tmp_path / "dish"
    seen = set()

    def look():
        phase = dish.state.link.state
        if phase is LinkPhase.LOST and not port.exists():
            port.symlink_to(pty_dish.path)
        seen.add(phase)
        if phase is LinkPhase.UP:
            dish.on_signal(signal.SIGINT)

    with pytest.raises(EndedBySignal), open_dish(wanted(str(port)), moves=True) as dish:
        run_station(dish, as_json=True, each_time=look)
    said = capsys.readouterr()
    events = [json.loads(line) for line in said.out.splitlines()]
    links = [event["link"]["state"] for event in events if event["type"] == "LinkChanged"]
    assert links[0] in ("opening", "lost")
    assert "up" in links
    assert {LinkPhase.LOST, LinkPhase.UP} <= seen
