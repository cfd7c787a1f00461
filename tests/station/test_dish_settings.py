"""The settings that a dish keeps itself: read, changed in RAM, saved, and never without a copy, consent and a check."""

from __future__ import annotations

import pytest
from birdcage.rotator.own_settings import RowState
from birdcage.station.requests import ReadSettings, SaveSettings, WriteSettings

from .conftest import Bench

YOU = "you"


@pytest.fixture
def bench(tmp_path):
    options = {"backup_folder": tmp_path / "backups", "state_folder": tmp_path / "state", "identify": lambda port: port}
    return Bench(options=options).connect()


def memory(bench, index):
    nvram = bench.device.firmware.board.nvram
    return nvram.ram[index], nvram.flash[index]


def written_lines(bench):
    return [line for line in bench.lines() if line.startswith("e ") or line == "s"]


def write(bench, agreed=True, **rows):
    return bench.do(WriteSettings({int(key[1:]): value for key, value in rows.items()}, YOU, agreed))


def test_the_whole_table_is_read_with_current_saved_and_default(bench):
    table = bench.do(ReadSettings())
    assert table.printed[0].startswith("Num  Name")
    row = table.rows[38]
    assert (row.name, row.current, row.saved, row.default) == ("Sleep Mode Timer Secs", "420", "420", "420")
    assert table.unfinished is None
    assert written_lines(bench) == []


def test_a_write_goes_to_ram_and_not_to_flash(bench):
    done = write(bench, r27="90")
    assert memory(bench, 27) == (90, 120)
    assert (done.table.rows[27].current, done.table.rows[27].saved) == ("90", "120")
    assert written_lines(bench) == ["e 27 90"]


def test_a_save_keeps_it_over_a_power_cycle(bench):
    write(bench, r27="90", r22="150")
    table = bench.do(SaveSettings(YOU, agreed=True))
    assert table.unsaved == ()
    bench.device.power_cycle(2.0)
    bench.step(20)
    assert memory(bench, 27) == (90, 90)
    assert bench.do(ReadSettings()).unfinished is None, "it is settled"


def test_a_power_cycle_takes_back_what_was_not_saved(bench):
    write(bench, r27="90")
    bench.device.power_cycle(2.0)
    bench.step(20)
    left = bench.do(ReadSettings()).unfinished
    assert [(row.index, row.state) for row in left.rows] == [(27, RowState.UNTOUCHED)]
    assert "as before" in " ".join(left.sentences)
    assert bench.do(ReadSettings()).unfinished is None
