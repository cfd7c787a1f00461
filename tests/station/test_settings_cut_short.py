"""A write or a save of the dish's settings that ends after any byte: what is said then is what its memory holds."""

from __future__ import annotations

import itertools

import pytest
from birdcage.base.errors import BirdcageError
from birdcage.rotator.own_settings import RowState
from birdcage.station.requests import ReadSettings, SaveSettings, WriteSettings

from .conftest import Bench

NEW = {27: "95", 101: "19.5", 0: "0xF"}
HOW = ("unplugged", "killed", "mute")
DISHES = itertools.count()
"""Each has an id of its own, under which a second program finds it."""


def bench_of(tmp_path, name, firmware="g2", clock=None):
    more = {} if clock is None else {"clock": clock}
    options = {"backup_folder": tmp_path / "backups", "state_folder": tmp_path / "state", "identify": lambda port: port}
    return Bench(f"{firmware}?seed=1&id={name}", options=options, firmware=firmware, **more).connect(30.0)


def memory(bench):
    store = getattr(bench.device.board, "nvram", None) or bench.device.board.memory
    return dict(store.ram), dict(store.flash)


def cut_after(bench, count, how):
    """Let so many more bytes reach the dish; then the cable is out, or nothing comes back."""
    left, write = [count], bench.sim.write

    def writing(data):
        for at in range(len(data)):
            if left[0] == 0:
                if how == "mute":
                    bench.device.wire.to_host.silent = bench.device.wire.to_dish.silent = True
                else:
                    bench.device.unplug()
            left[0] -= 1
            write(data[at : at + 1])

    bench.sim.write = writing


def written_by(bench, request):
    before = len(bench.written)
    try:
        bench.do(request, 60.0)
    except BirdcageError:
        return None
    return len(bench.written) - before


def read_again(bench, tmp_path, how, name):
    """Return a program that reads the table after the accident: the same one, or a new one."""
    bench.device.wire.to_host.silent = bench.device.wire.to_dish.silent = False
    bench.device.plug()
    if how == "killed":
        return bench_of(tmp_path, name, bench.firmware, bench.clock)
    bench.step(40.0)
    return bench


def check_said(table, before, now, wanted):
    """What is said of each row is what the memory holds, and no row that has changed goes unsaid."""
    said = {row.index: row.state for row in table.unfinished.rows} if table.unfinished is not None else {}
    for index in {*before[0]}:
        old, ram, flash = before[0][index], now[0][index], now[1][index]
        if index not in said:
            assert (ram, flash) == (old, old), f"row {index} has changed, and nothing says so"
            continue
        is_new = ram == wanted[index]
        if (ram, flash) == (old, old):
            truth = RowState.UNTOUCHED
        elif is_new and flash in (old, wanted[index]):
            truth = RowState.IN_RAM if flash == old else RowState.SAVED
        else:
            truth = RowState.OTHER
        assert said[index] is truth, f"row {index}: RAM {ram}, flash {flash}, was {old}"


def accident(tmp_path, count, how, request):
    name = f"cut-{next(DISHES)}"
    bench = bench_of(tmp_path, name)
    before = memory(bench)
    if isinstance(request, SaveSettings):
        bench.do(WriteSettings(NEW, "you", agreed=True))
    cut_after(bench, count, how)
    done = written_by(bench, request)
    after = read_again(bench, tmp_path, how, name)
    table = after.do(ReadSettings(), 60.0)
    if done is None:
        check_said(table, before, memory(after), {27: 95, 101: 19.5, 0: 15})
    return after, table, done, before


def lengths(tmp_path):
    bench = bench_of(tmp_path, f"cut-{next(DISHES)}")
    return written_by(bench, WriteSettings(NEW, "you", agreed=True)), written_by(
        bench, SaveSettings("you", agreed=True)
    )


@pytest.mark.parametrize("how", HOW)
@pytest.mark.parametrize("part", range(4))
def test_a_write_cut_after_any_byte_says_where_each_row_stands(tmp_path, how, part):
    seen, longest = set(), lengths(tmp_path)[0]
    for count in range(part, longest, 4):
        after, table, _done, before = accident(tmp_path, count, how, WriteSettings(NEW, "you", agreed=True))
        if table.unfinished is not None:
            seen |= {row.state for row in table.unfinished.rows}
        after.device.power_cycle(2.0)
        after.step(60.0)
        assert memory(after) == before, "a power cycle takes all of it back"
        left = after.do(ReadSettings(), 60.0).unfinished
        assert left is None or {row.state for row in left.rows} == {RowState.UNTOUCHED}
        assert after.do(ReadSettings(), 60.0).unfinished is None, "it is said once more, and over"
    assert {RowState.UNTOUCHED, RowState.IN_RAM} <= seen


@pytest.mark.parametrize("how", HOW)
def test_a_save_cut_after_any_byte_says_whether_flash_has_it(tmp_path, how):
    seen, longest = set(), lengths(tmp_path)[1]
    for count in range(longest):
        after, table, done, before = accident(tmp_path, count, how, SaveSettings("you", agreed=True))
        if done is not None:
            continue
        states = {row.state for row in table.unfinished.rows}
        assert len(states) == 1, "flash is written as a whole"
        seen |= states
        after.device.power_cycle(2.0)
        after.step(60.0)
        if states == {RowState.SAVED}:
            assert memory(after)[1][27] == 95
        else:
            assert states == {RowState.IN_RAM}
            assert memory(after) == before
    assert seen == {RowState.IN_RAM, RowState.SAVED}


def test_a_save_of_what_another_program_changed_is_told_when_it_is_cut_short(tmp_path):
    """A Trav'ler does not tell what flash holds, and there is no note of the row: that a save had begun is all."""
    told = 0
    for count in range(0, 200, 3):
        name = f"cut-{next(DISHES)}"
        bench = bench_of(tmp_path / name, name, "hal205")
        bench.device.board.memory.ram[127] = 10.0
        cut_after(bench, count, "unplugged")
        if written_by(bench, SaveSettings("you", agreed=True)) is not None:
            break
        after = read_again(bench, tmp_path / name, "unplugged", name)
        left, again = after.do(ReadSettings(), 60.0).unfinished, after.do(ReadSettings(), 60.0).unfinished
        assert left == again
        assert left is not None or memory(after)[1][127] == 15.0
        if left is None:
            continue
        told += 1
        assert "A save was interrupted" in left.sentences[0]
        after.do(WriteSettings({127: "12"}, "you", agreed=True), 60.0)
        assert [row.state for row in after.do(ReadSettings(), 60.0).unfinished.rows] == [RowState.UNTOLD]
    assert told


def test_half_a_number_that_arrived_is_told_as_neither_old_nor_new(tmp_path):
    """The dish keeps what was typed, and the next program's Enter makes it a line: `e 27 9` of `e 27 95`."""
    states, longest = {}, lengths(tmp_path)[0]
    for count in range(longest):
        _after, table, _done, _before = accident(
            tmp_path, count, "killed", WriteSettings({27: "95"}, "you", agreed=True)
        )
        for row in table.unfinished.rows if table.unfinished is not None else ():
            states.setdefault(row.state, table.unfinished.sentences)
    assert "Row 27 holds 9 in RAM. It was 120 and was to be 95. Flash has 120 as before" in " ".join(
        states[RowState.OTHER]
    )


@pytest.mark.parametrize("how", ["unplugged", "killed"])
def test_a_dish_that_does_not_tell_what_flash_holds_says_so_after_a_broken_save(tmp_path, how):
    said = set()
    for count in range(200):
        name = f"cut-{next(DISHES)}"
        bench = bench_of(tmp_path, name, "hal205")
        bench.do(WriteSettings({127: "10"}, "you", agreed=True))
        cut_after(bench, count, how)
        if written_by(bench, SaveSettings("you", agreed=True)) is not None:
            break
        after = read_again(bench, tmp_path, how, name)
        left = after.do(ReadSettings(), 60.0).unfinished
        (row,) = left.rows
        ram, flash = memory(after)
        assert ram[127] == 10.0
        assert row.state in (RowState.IN_RAM, RowState.UNTOLD)
        if row.state is RowState.IN_RAM:
            assert flash[127] == 15.0
        else:
            assert "does not tell what flash holds" in " ".join(left.sentences)
        said.add(row.state)
        after.do(SaveSettings("you", agreed=True), 60.0)
        assert memory(after)[1][127] == 10.0, "to save once more settles it"
        assert after.do(ReadSettings(), 60.0).unfinished is None
    assert RowState.UNTOLD in said
