"""The settings that a dish keeps itself: read, changed in RAM, saved, and never without a copy, consent and a check."""

from __future__ import annotations

import json

import pytest
from birdcage.base.errors import (
    BirdcageError,
    CommandRefused,
    ConfirmationNeeded,
    Held,
    LeaseDenied,
    NoReply,
    OutOfRange,
)
from birdcage.rotator.own_settings import RowState
from birdcage.rotator.settings_file import read_settings_text
from birdcage.station.attach_messages import result_shapes
from birdcage.station.requests import (
    AcquireLease,
    Goto,
    ReadSettings,
    SaveSettings,
    SetSearch,
    Stop,
    WriteSettings,
)
from birdcage.station.settings_backup import SettingsBackup

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


def test_a_dangerous_row_and_one_that_no_source_tells_of_need_consent(tmp_path):
    bench = Bench("g2?seed=1&nvs_rows=all", options={"backup_folder": tmp_path}).connect()
    for index, words in ((83, "every angle wrong"), (7, "Undocumented row"), (20, "homing")):
        with pytest.raises(ConfirmationNeeded, match=words):
            bench.do(WriteSettings({index: "9" if index != 20 else "off"}, YOU))
    assert written_lines(bench) == []
    assert list(tmp_path.iterdir()) == []
    bench.do(WriteSettings({27: "90"}, YOU))  # one that only shapes the TV search
    bench.do(WriteSettings({7: "5"}, YOU, agreed=True))
    assert memory(bench, 7)[0] == 5


def test_a_save_needs_consent_and_names_what_it_changes(bench):
    write(bench, r27="90")
    with pytest.raises(ConfirmationNeeded, match=r"row 27 120 -> 90.*next power cycle"):
        bench.do(SaveSettings(YOU))
    assert "s" not in bench.lines()


def test_the_table_is_backed_up_before_the_first_write_of_a_run_and_once(bench, tmp_path):
    before = bench.do(ReadSettings()).printed
    first, second = write(bench, r27="90"), write(bench, r27="91")
    (file,) = (tmp_path / "backups").iterdir()
    assert first.backup == second.backup == str(file)
    kept = read_settings_text(file.read_bytes(), "it")
    assert kept.printed == before
    assert (kept.firmware, kept.machine, kept.demo) == ("g2", "Carryout G2", True)


def test_without_a_place_for_the_backup_nothing_is_written():
    bench = Bench().connect()
    with pytest.raises(BirdcageError, match="No folder for a backup"):
        write(bench, r27="90")
    assert written_lines(bench) == []


def test_a_backup_that_cannot_be_written_keeps_the_dish_as_it_is(tmp_path):
    folder = tmp_path / "backups"
    folder.write_text("a file")
    bench = Bench(options={"backup_folder": folder}).connect()
    with pytest.raises(BirdcageError, match="nothing was changed"):
        write(bench, r27="90")
    assert written_lines(bench) == []


def test_nothing_is_sent_for_what_the_dish_has_already(bench, tmp_path):
    done = write(bench, r101="18", r20="on", r0="7")
    assert done.backup is None
    assert written_lines(bench) == []
    bench.do(SaveSettings(YOU, agreed=True))
    assert "s" not in bench.lines(), "there is nothing to save"
    assert not (tmp_path / "backups").exists()


def test_switches_go_out_as_digits_and_hexadecimal_as_it_is_printed(bench):
    write(bench, r20="off", r0="0x1F", r26="-3", r101="20")
    assert written_lines(bench) == ["e 20 0", "e 0 0x0000001F", "e 26 -3", "e 101 20.00"]
    assert [memory(bench, index)[0] for index in (20, 0, 26, 101)] == [0, 31, -3, 20]


def test_a_dish_that_takes_hexadecimal_otherwise_is_found_out_and_nothing_is_saved(tmp_path):
    bench = Bench("g2?seed=1&nvs_hex=decimal", options={"backup_folder": tmp_path}).connect()
    with pytest.raises(CommandRefused, match=r"set row 0 to 0x00000000.*power cycle takes it back"):
        write(bench, r0="0x1F")
    (row,) = bench.do(ReadSettings()).unfinished.rows
    assert row.state is RowState.OTHER
    assert memory(bench, 0) == (0, 7)


@pytest.mark.parametrize(
    ("index", "value", "words"),
    [(101, "91", "beyond its limit of 90"), (101, "abc", "Give a number"), (101, "nan", "Give a number"),
     (20, "2", "on or off"), (27, "1.5", "whole number"), (101, "18.005", "2 decimals"),
     (0, "0x123456789", "number"), (0, "-1", "does not fit"), (27, "90\r\ns", "whole number"),
     (27, "", "whole number"), (27, "９０", "whole number")],
)  # fmt: skip
def test_a_value_that_does_not_fit_is_refused_before_anything_is_sent(bench, index, value, words):
    with pytest.raises(OutOfRange, match=words):
        bench.do(WriteSettings({index: value}, YOU, agreed=True))
    assert written_lines(bench) == []


def test_a_hole_is_no_row(bench):
    with pytest.raises(CommandRefused, match="no row 7") as raised:
        write(bench, r7="1")
    assert raised.value.reason == "no_row"


def test_nothing_is_read_or_written_while_the_dish_moves(bench):
    bench.watch("position")
    bench.step(3)
    bench.station.submit(Goto(180.0, 45.0, YOU))
    bench.step(0.5)
    for request in (ReadSettings(), WriteSettings({27: "90"}, YOU, agreed=True), SaveSettings(YOU, agreed=True)):
        with pytest.raises(BirdcageError) as raised:
            bench.do(request, 1.0)
        assert raised.value.reason == "moving"
    assert written_lines(bench) == []


def test_a_held_dish_is_not_written_to(bench):
    bench.do(Stop("you"))
    bench.step(8)
    for request in (WriteSettings({27: "90"}, YOU, agreed=True), SaveSettings(YOU, agreed=True)):
        with pytest.raises(Held):
            bench.do(request)
    assert written_lines(bench) == []


def test_who_has_no_control_writes_nothing(bench):
    bench.do(AcquireLease("anna"))
    with pytest.raises(LeaseDenied):
        write(bench, r27="90")
    assert written_lines(bench) == []


def test_rows_without_a_known_name_and_lines_of_another_form_survive_untouched(tmp_path):
    bench = Bench("g2?seed=1&nvs_rows=all", options={"backup_folder": tmp_path}).connect()
    before = bench.do(ReadSettings())
    assert len(before.printed) == 2 + 150
    assert len(before.rows) == 147
    write(bench, r27="90")
    bench.do(SaveSettings(YOU, agreed=True))
    after = bench.do(ReadSettings())
    changed = [(a, b) for a, b in zip(before.printed, after.printed, strict=True) if a != b]
    assert len(changed) == 1
    assert changed[0][0].startswith(" 27) Circle RPM")
    assert [line for line in after.printed if "ODU 4711 A" in line]


def test_a_row_that_changes_unasked_is_told(bench):
    edit = bench.device.firmware.board.nvram.write

    def write_two(index, text):
        edit(index, text)
        edit(22, "7")

    bench.device.firmware.board.nvram.write = write_two
    with pytest.raises(CommandRefused, match="Row 22 is changed too"):
        write(bench, r27="90")


def test_a_save_that_does_not_reach_flash_is_not_believed(bench):
    write(bench, r27="90")
    bench.device.firmware.board.nvram.save = lambda: None
    with pytest.raises(CommandRefused, match="row 27 120 -> 90"):
        bench.do(SaveSettings(YOU, agreed=True))
    assert [row.state for row in bench.do(ReadSettings()).unfinished.rows] == [RowState.IN_RAM]


def test_to_put_a_value_back_by_hand_leaves_nothing_open(bench):
    write(bench, r27="90")
    assert [row.state for row in write(bench, r27="120").table.unfinished.rows] == [RowState.UNTOUCHED]
    assert bench.do(ReadSettings()).unfinished is None


def test_a_note_that_cannot_be_read_is_told_and_nothing_is_written(bench, tmp_path):
    write(bench, r27="90")
    (note,) = (tmp_path / "state").rglob("settings-write.json")
    note.write_text("{")
    left = bench.do(ReadSettings()).unfinished
    assert f"{note} tells of an earlier write" in left.sentences[0]
    for request in (WriteSettings({27: "95"}, YOU, agreed=True), SaveSettings(YOU, agreed=True)):
        with pytest.raises(BirdcageError, match="Until you rename it, no setting is written or saved"):
            bench.do(request)
    assert written_lines(bench) == ["e 27 90"]
    assert note.read_text() == "{", "reading has not dropped it"
    note.rename(note.with_suffix(".old"))
    assert bench.do(ReadSettings()).unfinished is None
    bench.do(SaveSettings(YOU, agreed=True))
    assert memory(bench, 27) == (90, 90)


def test_a_table_of_150_rows_takes_one_line(tmp_path):
    bench = Bench("g2?seed=1&nvs_rows=all&pace_baud=115200", options={"backup_folder": tmp_path}).connect()
    before, begun = len(bench.lines()), bench.clock.monotonic()
    bench.do(ReadSettings())
    lines = bench.lines()[before:]
    assert lines.count("d") == 1
    assert len([line for line in lines if line.strip()]) <= 6, lines
    assert bench.clock.monotonic() - begun < 2.0


def test_a_machine_without_settings_says_so(tmp_path):
    rotator = Bench(options={"backup_folder": tmp_path}).connect()
    rotator.station._antenna.rotator._rotator.own_settings = None
    with pytest.raises(CommandRefused) as raised:
        rotator.do(ReadSettings())
    assert raised.value.reason == "unsupported"


@pytest.mark.parametrize(
    ("firmware", "row", "old", "new"), [("hal205", 127, "15.00", "10"), ("carryout", 102, "73.00", "80")]
)
def test_dishes_that_print_one_value_are_written_and_saved_too(tmp_path, firmware, row, old, new):
    bench = Bench(f"{firmware}?seed=1", firmware=firmware, options={"backup_folder": tmp_path})
    bench.connect(60.0)
    table = bench.do(ReadSettings(), 60.0)
    assert (table.rows[row].current, table.rows[row].saved, table.rows[row].default) == (old, None, None)
    with pytest.raises(ConfirmationNeeded):
        bench.do(WriteSettings({row: new}, YOU), 60.0)
    done = bench.do(WriteSettings({row: new}, YOU, agreed=True), 60.0)
    assert done.table.rows[row].current == f"{new}.00"
    with pytest.raises(ConfirmationNeeded, match="does not tell what flash holds"):
        bench.do(SaveSettings(YOU), 60.0)
    table = bench.do(SaveSettings(YOU, agreed=True), 60.0)
    assert table.unfinished is None
    memory = bench.device.board.memory
    assert memory.flash[row] == memory.ram[row] == float(new)


def test_a_table_that_reads_differently_twice_is_no_backup(bench, tmp_path):
    nvram, dumps = bench.device.firmware.board.nvram, []
    render = nvram.render

    def damaged(index, value):
        if index == 133:
            dumps.append(index)
        return "8.00" if index == 133 and len(dumps) == 4 else render(index, value)

    nvram.render = damaged
    with pytest.raises(NoReply, match="Two readings of the settings differ"):
        write(bench, r27="90")
    assert written_lines(bench) == []
    assert not (tmp_path / "backups").exists()


@pytest.mark.parametrize("shown", [0, 2], ids=["nor where it is read back", "in the table alone"])
def test_a_row_that_is_not_shown_after_the_write_is_said_to_be_unread(bench, shown):
    nvram, left = bench.device.firmware.board.nvram, [shown]
    render = nvram.render

    def damaged(index, value):
        if index == 27 and value == 90:
            left[0] -= 1
            return render(index, value) if left[0] >= 0 else "9x 9"
        return render(index, value)

    nvram.render = damaged
    with pytest.raises(NoReply) as raised:
        write(bench, r27="90")
    assert str(raised.value) == (
        "Row 27 is not readable after the write. Row 27 was 120 and was to be 90. Nothing was saved: a power cycle "
        "takes the write back."
    )
    assert raised.value.reason == "garbage"
    assert memory(bench, 27) == (90, 120)
    bench.step(10)
    assert "Row 27 is not shown any more" in " ".join(bench.do(ReadSettings()).unfinished.sentences)


def test_the_table_goes_to_attached_programs_and_back():
    bench = Bench().connect()
    table = bench.do(ReadSettings())
    shape = result_shapes()[ReadSettings]
    assert shape.take(json.loads(json.dumps(shape.tell(table, "it"))), "it") == table


def test_no_backup_replaces_another_of_the_same_second(bench, tmp_path):
    keeper = SettingsBackup(bench.station._store, bench.station._antenna, tmp_path / "backups")
    first, second = keeper.keep(["one"]), keeper.keep(["two"])
    assert [read_settings_text(each.read_bytes(), "it").printed for each in (first, second)] == [("one",), ("two",)]


def test_a_note_of_another_firmware_is_none_of_this_dish(bench, tmp_path):
    write(bench, r27="90")
    (note,) = (tmp_path / "state").rglob("settings-write.json")
    note.write_text(note.read_text().replace('"firmware": "g2"', '"firmware": "hal205"'))
    assert bench.do(ReadSettings()).unfinished is None


def test_the_switch_of_the_tv_search_saves_no_other_change_along(bench):
    write(bench, r102="70")
    with pytest.raises(CommandRefused, match=r"Row 102 .* \(65\.00 to 70\.00\) and not saved"):
        bench.do(SetSearch(YOU, disabled=False))
    assert memory(bench, 102) == (70, 65)
    assert memory(bench, 20) == (1, 1)
    bench.do(SaveSettings(YOU, agreed=True))
    bench.do(SetSearch(YOU, disabled=False))
    assert memory(bench, 20) == (0, 0)
