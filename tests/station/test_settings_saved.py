"""What a save keeps is what was shown, what a survey tells is read anew, and each save is backed up anew."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from birdcage.base.errors import ConfirmationNeeded
from birdcage.rotator.settings_file import read_settings_text
from birdcage.station.json_form import request_from_json, to_json
from birdcage.station.requests import Connect, ReadSettings, SaveSettings, SetSearch, WriteSettings

from .conftest import Bench

YOU = "you"


@pytest.fixture
def bench(tmp_path):
    options = {"backup_folder": tmp_path / "backups", "state_folder": tmp_path / "state", "identify": lambda port: port}
    return Bench(options=options).connect()


def memory(bench, index):
    nvram = bench.device.firmware.board.nvram
    return nvram.ram[index], nvram.flash[index]


def write(bench, **rows):
    return bench.do(WriteSettings({int(key[1:]): value for key, value in rows.items()}, YOU, agreed=True))


def test_what_was_not_shown_is_not_saved(bench):
    write(bench, r27="90")
    shown = bench.do(ReadSettings()).to_save
    assert shown == {27: "90"}
    write(bench, r22="7")
    with pytest.raises(ConfirmationNeeded, match=r"row 22 is 7 and was not shown\. Look again\. Nothing was saved"):
        bench.do(SaveSettings(YOU, agreed=True, shown=shown))
    write(bench, r22="200", r27="95")
    with pytest.raises(ConfirmationNeeded, match=r"row 27 was 90 and is 95 now\."):
        bench.do(SaveSettings(YOU, agreed=True, shown=shown))
    write(bench, r27="120")
    with pytest.raises(ConfirmationNeeded, match="row 27 was 90 and has nothing to save now"):
        bench.do(SaveSettings(YOU, agreed=True, shown=shown))
    assert "s" not in bench.lines()
    write(bench, r27="90")
    request = request_from_json(json.loads(json.dumps(to_json(SaveSettings(YOU, agreed=True, shown=shown)))))
    bench.do(request)
    assert memory(bench, 27) == (90, 90)


def test_what_a_survey_tells_is_read_anew_after_a_write_and_a_save(bench):
    bench.step(5)
    assert (bench.state.readings["floor"].value, bench.state.el_min_deg) == (18.0, 18.0)
    write(bench, r101="20", r20="off")
    bench.step(1)
    assert (bench.state.readings["floor"].value, bench.state.el_min_deg) == (20.0, 20.0)
    tv_search = bench.state.readings["tv_search"].value
    bench.do(SaveSettings(YOU, agreed=True))
    bench.step(1)
    assert bench.state.readings["tv_search"].value is not tv_search
    surveys = bench.lines().count("d 101")
    write(bench, r27="90")
    bench.step(1)
    assert bench.lines().count("d 101") == surveys, "no row that it tells"


def test_after_a_save_the_next_write_is_backed_up_anew(bench, tmp_path):
    write(bench, r27="90")
    bench.do(SaveSettings(YOU, agreed=True))
    saved = bench.do(ReadSettings()).printed
    second = write(bench, r27="91").backup
    assert len(list((tmp_path / "backups").iterdir())) == 2
    assert read_settings_text(Path(second).read_bytes(), "it").printed == saved


def test_the_switch_of_the_tv_search_is_a_save_too(bench, tmp_path):
    bench.do(SetSearch(YOU, disabled=False))
    saved = bench.do(ReadSettings()).printed
    backup = write(bench, r27="90").backup
    assert read_settings_text(Path(backup).read_bytes(), "it").printed == saved
    assert len(list((tmp_path / "backups").iterdir())) == 2


def test_another_dish_at_the_same_port_is_backed_up_too(bench, tmp_path):
    write(bench, r27="90")
    bench.device.unplug()
    bench.step(3)
    bench.device.plug()
    bench.step(20)
    write(bench, r27="91")
    assert len(list((tmp_path / "backups").iterdir())) == 2


def test_another_dish_at_another_port_is_backed_up_too(tmp_path):
    options = {"backup_folder": tmp_path}
    bench = Bench(options=options).connect()
    write(bench, r27="90")
    bench.do(Connect("sim:other"))
    bench.step(5)
    write(bench, r27="95")
    assert len(list(tmp_path.iterdir())) == 2
