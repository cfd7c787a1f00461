"""That a dish waits for its motors is remembered of that dish, and of no other."""

from __future__ import annotations

import pytest
from birdcage.link.identity import dish_folder
from birdcage.rotator.facts import SecondMove
from birdcage.station.requests import Connect, Goto

from .conftest import Bench
from .test_waiting_dish import WAITS, busy_told, sent_since, stands_at


def at(tmp_path, address=WAITS, identity="usb:A"):
    bench = Bench(address, {"state_folder": tmp_path, "identify": lambda _port: identity}).connect()
    bench.watch("position")
    bench.step(2.0)
    return bench


def test_the_next_program_moves_one_axis_at_a_time_from_the_first_move_on(tmp_path):
    first = at(tmp_path)
    first.do(Goto(0, 30, "you"))
    first.session.close()
    second = at(tmp_path)
    assert second.state.dish.second_other is SecondMove.BLOCK
    since = second.clock.monotonic()
    second.station.submit(Goto(0, 30, "you"))
    second.step(1.0)
    assert len(sent_since(second, since)) == 1
    assert second.state.motion.stop_means == "end of move"
    second.step(8.0)
    assert stands_at(second, 0, 30)
    assert busy_told(second) == []


@pytest.mark.parametrize("identity", ["usb:B", None])
def test_another_dish_or_one_without_a_name_is_not_it(tmp_path, identity):
    at(tmp_path).do(Goto(0, 30, "you"))
    assert at(tmp_path, identity=identity).state.dish.second_other is SecondMove.UNKNOWN


def test_what_an_earlier_version_kept_is_taken_over_once_and_its_files_are_removed(tmp_path):
    folder = dish_folder(tmp_path, "usb:A")
    folder.mkdir(parents=True)
    (folder / "moves.json").write_text('{"firmware": "g2", "second_move": "block"}')
    (folder / "gear.json").write_text(
        '{"firmware": "g2", "facts": [{"axis": "azimuth", "kind": "overshoot up", "deg": 0.03, "origin": '
        '"learnt from readings at rest", "utc": "2026-11-22T00:00:00+00:00", "readings": 9}]}'
    )
    for _ in range(2):
        bench = at(tmp_path, "g2?seed=1&az=-180")
        assert bench.state.dish.second_other is SecondMove.BLOCK
        assert bench.state.dish.azimuth.mean_overshoot_up_deg == 0.03
        assert bench.state.own.facts["azimuth.mean_overshoot_up_deg"].readings == 9
        assert [each.name for each in folder.iterdir()] == ["facts.json"]
        bench.session.close()


@pytest.mark.parametrize("text", ["", "{", "[]", '{"firmware": "hal205", "second_move": "block"}', "[" * 2000])
@pytest.mark.parametrize("name", ["moves.json", "gear.json"])
def test_a_damaged_earlier_file_or_one_of_another_firmware_tells_nothing(tmp_path, text, name):
    folder = dish_folder(tmp_path, "usb:A")
    folder.mkdir(parents=True)
    (folder / name).write_text(text)
    bench = at(tmp_path, "g2?seed=1&az=-180")
    assert bench.state.dish.second_other is SecondMove.UNKNOWN
    assert bench.state.own.facts == {}


def test_what_cannot_be_written_is_learnt_all_the_same(tmp_path):
    (tmp_path / "dishes").write_text("in the way")
    bench = at(tmp_path)
    bench.do(Goto(0, 30, "you"))
    assert bench.state.dish.second_other is SecondMove.BLOCK


def test_it_is_forgotten_where_another_port_is_chosen(tmp_path):
    bench = Bench(WAITS, {"state_folder": tmp_path, "identify": lambda port: f"path:{port}"}).connect()
    bench.do(Goto(0, 30, "you"))
    bench.step(2.0)
    bench.do(Connect("sim:other", None))
    bench.step(3.0)
    assert bench.state.dish.second_other is SecondMove.UNKNOWN
    bench.do(Connect("sim:test", None))
    bench.step(3.0)
    assert bench.state.dish.second_other is SecondMove.BLOCK


def test_it_is_kept_while_the_adapter_is_out(tmp_path):
    bench = at(tmp_path, identity=None)
    bench.do(Goto(0, 30, "you"))
    bench.device.unplug()
    bench.step(3.0)
    bench.device.plug()
    bench.step(8.0)
    assert bench.state.dish.second_other is SecondMove.BLOCK
