"""`birdcage nvs`: from a backup through write, save, power cycle and restore back to the same table, byte for byte."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from birdcage.base.errors import NoReply
from birdcage.base.paths import Paths
from birdcage.cli.exits import EndedBySignal
from birdcage.cli.settings_desk import said_when_cut_short
from pty_dish import PtyDish

ALL = "seed=1&nvs_rows=all"


@pytest.fixture
def pty_dish(request):
    """A dish on a pty that boots quickly."""
    dish = PtyDish(getattr(request, "param", "seed=1"), "g2", 10.0)
    yield dish
    dish.close()


@pytest.fixture
def nvs(run, pty_dish):
    """Call `birdcage nvs` on the simulated dish."""
    return lambda *words, **more: run("nvs", *words, port=pty_dish.path, **more)


def table_of(text):
    return text.partition("# table:\n")[2]


def power_cycle(run, dish):
    dish.device.power_cycle(1.0)
    assert run("init", port=dish.path).exit_code == 0


def sent(dish):
    return [line for line in dish.lines() if line.startswith("e ") or line == "s"]


@pytest.mark.parametrize("pty_dish", [ALL], indirect=True)
def test_write_save_power_cycle_restore_power_cycle_is_the_backup_byte_for_byte(run, nvs, pty_dish, tmp_path):
    before = tmp_path / "before.txt"
    assert nvs("dump", before).exit_code == 0
    done = nvs("set", 27, 90, 101, "19.5", 7, "0xAB", 112, "on", "--yes")
    assert done.exit_code == 0, done.stderr
    assert "Row 101 Minimum Elevation Angle: 18.00 -> 19.50 deg" in done.stderr
    (backup,) = Paths.default().backups.iterdir()
    assert f"Backup: {backup}" in done.stderr
    assert "birdcage nvs save" in done.stderr
    assert table_of(backup.read_text()) == table_of(before.read_text())
    saved = nvs("save", "--yes")
    assert saved.exit_code == 0, saved.stderr
    assert "Row 27 Circle RPM: 120 -> 90 in flash" in saved.stderr
    assert "power cycle" in saved.stderr
    power_cycle(run, pty_dish)
    changed = table_of(nvs("dump").stdout)
    assert changed != table_of(before.read_text())
    assert " 27) Circle RPM                          90          90         120\n" in changed
    differs = nvs("diff", before)
    assert [line.split()[0] for line in differs.stdout.splitlines()] == ["row", "7", "27", "101", "112"]
    restored = nvs("restore", backup, "--yes")
    assert restored.exit_code == 0, restored.stderr
    assert "byte for byte" in restored.stderr
    power_cycle(run, pty_dish)
    assert table_of(nvs("dump").stdout) == table_of(before.read_text())
    assert nvs("diff", before).stdout == ""
    again = nvs("restore", before, "--yes")
    assert "Nothing was written" in again.stderr
    assert "ODU 4711 A" in before.read_text(), "lines of no known form are kept as they are"


def test_the_dump_says_whose_it_is_and_that_it_is_made_up(nvs):
    lines = nvs("dump").stdout.splitlines()
    assert lines[:3] == ["# birdcage settings", "# machine: Carryout G2", "# firmware: g2"]
    assert lines[3].startswith("# read: 20")
    assert lines[4:6] == ["# table:", "Num  Name                         Current      Saved      Default"]
    told = json.loads(nvs("dump", "--json").stdout)
    assert told["rows"][-1]["row"] == 133
    row = next(each for each in told["rows"] if each["row"] == 83)
    assert (row["current"], row["unit"]) == ("40000", "steps/turn")
    assert "every angle wrong" in row["danger"]


def test_a_simulated_dish_of_this_process_is_called_demo(run):
    assert "# DEMO\n" in run("nvs", "dump", port="sim:g2").stdout


def test_a_dump_replaces_no_file(nvs, tmp_path):
    (tmp_path / "a.txt").write_text("mine")
    done = nvs("dump", tmp_path / "a.txt")
    assert done.exit_code == 1
    assert "exists" in done.stderr
    assert (tmp_path / "a.txt").read_text() == "mine"


def test_rows_are_told_with_what_is_known_of_them(nvs):
    done = nvs("get", 38, 101)
    assert "Sleep Mode Timer Secs" in done.stdout
    assert "Row 101: The mechanics end at about 20°." in done.stdout
    missing = nvs("get", 38, 7)
    assert missing.exit_code == 1
    assert "no row 7" in missing.stderr


def test_without_a_yes_and_a_terminal_nothing_is_written(nvs, pty_dish):
    done = nvs("set", 101, 10)
    assert done.exit_code == 2
    assert "--yes" in done.stderr
    assert "end stops" in done.stderr, "the danger is told before the question"
    assert sent(pty_dish) == []


@pytest.mark.parametrize(
    ("words", "says"),
    [((101,), "ROW VALUE"), (("x", 1), "no number of a row"), ((101, 1, 101, 2), "twice"), ((7, 1), "no row 7"),
     ((101, "low"), "Give a number"), ((20, 3), "on or off"), (("--nosuch", 1), "No such option")],
)  # fmt: skip
def test_what_makes_no_change_is_refused_and_nothing_is_sent(nvs, pty_dish, words, says):
    done = nvs("set", *words, "--yes")
    assert done.exit_code != 0
    assert says in done.stderr
    assert sent(pty_dish) == []


def test_what_is_in_ram_only_is_told_by_the_next_command(run, nvs, pty_dish):
    nvs("set", 27, 90, "--yes")
    told = nvs("get", 27)
    assert "Row 27 is changed in RAM only. `birdcage nvs save` keeps that, a power cycle takes it back." in told.stderr
    power_cycle(run, pty_dish)
    assert "Row 27 is as before" in nvs("get", 27).stderr
    assert "Row 27" not in nvs("get", 27).stderr


def test_a_program_that_has_the_port_does_it(run, owner, pty_dish):
    done = run("nvs", "set", 27, 90, "--yes", port=pty_dish.path)
    assert done.exit_code == 0, done.stderr
    assert "90" in done.stdout
    assert run("nvs", "save", "--yes", port=pty_dish.path).exit_code == 0
    told = json.loads(run("nvs", "get", 27, "--json", port=pty_dish.path).stdout)
    assert (told["rows"]["27"]["current"], told["rows"]["27"]["saved"]) == ("90", "90")
    assert told["unfinished"] is None


GOOD = " 27) Circle RPM                         90          90         120\n"
HEAD = "# birdcage settings\n# machine: Carryout G2\n# firmware: {}\n# read: 2026-01-01T00:00:00Z\n# table:\n"


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "it is empty"),
        (b"\xff\xfe\x00", "not text in UTF-8"),
        (f"{GOOD}\x1b[2J\n".encode(), "control characters"),
        (GOOD.encode() + b"\x00", "control characters"),
        (b"x" * 300_000, "larger than"),
        (b"no table at all\n", "holds no setting"),
        ((HEAD.format("hal205") + GOOD).encode(), "is of firmware hal205"),
        ((GOOD + GOOD).encode(), "has row 27 2 times"),
        (GOOD.replace(" 27)", "  9)").encode(), "row 9 (Circle RPM), which this dish does not show"),
        (GOOD.replace("Circle RPM ", "Circle Rpm ").encode(), "is called 'Circle RPM' on this dish"),
        (GOOD.replace(" 90 ", " x; ").encode(), "holds no setting"),
        (GOOD.replace("         90          90         120", "         s           s           s").encode(), "whole"),
        (GOOD.replace(" 27) Circle RPM             ", "101) Minimum Elevation Angle")
         .replace("90          90         120", "  99.00       99.00       18.00").encode(), "beyond its limit of 90"),
    ],
)  # fmt: skip
def test_a_file_that_is_no_backup_of_this_dish_is_refused_and_nothing_is_sent(nvs, pty_dish, tmp_path, data, says):
    file = tmp_path / "bad.txt"
    file.write_bytes(data)
    done = nvs("restore", file, "--yes")
    assert done.exit_code != 0, done.stdout
    assert says in done.stderr
    assert "\x1b" not in done.stderr
    assert sent(pty_dish) == []
    assert not Paths.default().backups.exists()


def test_a_folder_or_no_file_is_refused(nvs, tmp_path):
    for file in (tmp_path, tmp_path / "nosuch.txt"):
        assert "can't be read" in nvs("restore", file, "--yes").stderr


def test_a_change_in_ram_that_the_file_says_nothing_of_is_not_saved_along(nvs, pty_dish, tmp_path):
    file = tmp_path / "part.txt"
    file.write_text(GOOD)
    nvs("set", 22, 7, "--yes")
    done = nvs("restore", file, "--yes")
    assert "Row 22 was changed in RAM (200 to 7)" in done.stderr
    assert sent(pty_dish) == ["e 22 7"]


def test_a_change_in_ram_of_a_row_in_the_file_is_put_back_before_the_save(nvs, pty_dish, tmp_path):
    before = tmp_path / "before.txt"
    nvs("dump", before)
    nvs("set", 22, 7, "--yes")
    assert nvs("restore", before, "--yes").exit_code == 0
    nvram = pty_dish.device.board.nvram
    assert nvram.flash[22] == nvram.ram[22] == 200


def test_two_files_are_compared_without_a_dish(run, tmp_path):
    one, two = tmp_path / "a.txt", tmp_path / "b.txt"
    one.write_text(HEAD.format("g2") + GOOD + "142) Serial   ODU 1 A\n")
    two.write_text(HEAD.format("g2") + GOOD.replace(" 90 ", " 95 ") + "142) Serial   ODU 2 A\n")
    done = run("nvs", "diff", one, two, port="/dev/no-such-port")
    assert done.exit_code == 0, done.stderr
    assert done.stdout.splitlines()[1].split() == ["27", "Circle", "RPM", "90", "95"]
    assert "ODU 2 A" in done.stdout
    told = json.loads(run("nvs", "diff", one, two, "--json", port="/dev/no-such-port").stdout)
    assert told["differences"] == [{"row": 27, "name": "Circle RPM", "a": "90", "b": "95"}]
    two.write_text(HEAD.format("hal205") + GOOD)
    assert "mean different things" in run("nvs", "diff", one, two).stderr


def test_a_trav_ler_says_that_flash_is_not_told(run, pty_travler):
    def nvs(*words):
        return run("nvs", *words, port=pty_travler.path, firmware="hal205")

    assert nvs("set", 127, 10, "--yes").exit_code == 0
    done = nvs("save", "--yes")
    assert done.exit_code == 0, done.stderr
    assert "does not tell what flash holds" in done.stderr
    memory = pty_travler.device.board.memory
    assert memory.flash[127] == 10.0


def test_after_a_kill_in_the_middle_the_next_command_says_where_each_row_stands(start, nvs, pty_dish):
    rows = (16, 17, 18, 22, 23, 24, 25, 27, 28, 32, 33, 35, 36, 37, 41)
    pairs = [each for row in rows for each in (row, 9)]
    process = start("nvs", "set", *pairs, "--yes", "--port", pty_dish.path, "--firmware", "g2")
    pty_dish.wait_for(lambda _truth: len(sent(pty_dish)) >= 3)
    process.kill()
    process.wait()
    told = json.loads(nvs("get", 16, "--json").stdout)["unfinished"]
    nvram = pty_dish.device.board.nvram
    changed = {row for row in rows if nvram.ram[row] != nvram.flash[row]}
    assert 0 < len(changed) < len(rows)
    assert {each["row"] for each in told["rows"]} == set(rows)
    assert {each["row"] for each in told["rows"] if each["state"] == "in RAM only"} == changed
    assert {each["row"] for each in told["rows"] if each["state"] == "untouched"} == {*rows} - changed
    assert table_of(Path(told["backup"]).read_text()).count("\n") > 40
    done = nvs("restore", told["backup"], "--yes")
    assert done.exit_code == 0, done.stderr
    assert "byte for byte" in done.stderr
    assert nvram.ram == nvram.flash
    assert json.loads(nvs("get", 16, "--json").stdout)["unfinished"] is None


def test_a_dump_of_a_simulated_dish_is_not_restored_into_this_one(run, nvs, pty_dish, tmp_path):
    file = tmp_path / "demo.txt"
    assert run("nvs", "dump", file, port="sim:g2").exit_code == 0
    done = nvs("restore", file, "--yes")
    assert f"{file} is of a simulated dish. Nothing was sent." in done.stderr
    assert sent(pty_dish) == []
    assert run("nvs", "restore", file, "--yes", port="sim:g2").exit_code == 0


def test_a_restore_says_what_only_its_save_changes_and_saves_nothing_else(nvs, pty_dish, tmp_path, monkeypatch):
    before = tmp_path / "before.txt"
    nvs("dump", before)
    nvs("set", 27, 90, 22, 7, "--yes")
    nvs("save", "--yes")
    nvs("set", 27, 120, "--yes")
    nvram = pty_dish.device.board.nvram

    def agree(_question, _yes):
        nvram.ram[41] = 9  # by another program, while the person reads

    monkeypatch.setattr("birdcage.cli.settings_words.agree", agree)
    done = nvs("restore", before)
    assert "Row 27 Circle RPM: 90 -> 120 in flash" in done.stderr
    assert "Row 22" in done.stderr
    assert "row 41 is" in done.stderr
    assert "was not shown" in done.stderr
    assert "s" not in sent(pty_dish)[-1:]
    assert nvram.flash[27] == 90


def test_a_save_keeps_only_what_was_shown(nvs, pty_dish, monkeypatch):
    nvs("set", 27, 90, "--yes")
    nvram = pty_dish.device.board.nvram
    monkeypatch.setattr("birdcage.cli.settings_words.agree", lambda _question, _yes: nvram.ram.update({22: 7}))
    done = nvs("save")
    assert done.exit_code != 0
    assert "row 22 is 7 and was not shown" in done.stderr
    assert nvram.flash[27] == 120


def test_a_restore_saves_where_flash_alone_differs(nvs, pty_dish, tmp_path):
    before = tmp_path / "before.txt"
    nvs("dump", before)
    nvs("set", 27, 90, "--yes")
    nvs("save", "--yes")
    nvs("set", 27, 120, "--yes")
    done = nvs("restore", before, "--yes")
    assert "byte for byte" in done.stderr
    assert pty_dish.device.board.nvram.flash[27] == 120


@pytest.mark.parametrize("ended", [KeyboardInterrupt, EndedBySignal(15), NoReply("Silence.")], ids=str)
def test_what_cuts_a_write_short_says_how_to_see_each_row(ended):
    with pytest.raises((EndedBySignal, NoReply)) as raised, said_when_cut_short():
        raise ended
    assert raised.value.__notes__ == ["`birdcage nvs dump` shows what became of each row."]
